#include "drivers/bumblebee/stereo_matcher.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "runtime/process/thread_pool.hpp"

namespace floornav {
namespace {

/// A texture that has a value at every place: waves of random direction, length and phase.
class Texture {
 public:
  explicit Texture(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> direction(0, std::numbers::pi);
    std::uniform_real_distribution<double> length_px(5, 40);
    std::uniform_real_distribution<double> phase(0, 2 * std::numbers::pi);
    for (Wave& wave : waves_) {
      const double k = 2 * std::numbers::pi / length_px(random);
      const double angle = direction(random);
      wave = {k * std::cos(angle), k * std::sin(angle), phase(random)};
    }
  }
  [[nodiscard]] double at(double x, double y) const {
    double sum = 0;
    for (const Wave& wave : waves_) sum += std::sin(wave.kx * x + wave.ky * y + wave.phase);
    return 128 + 14 * sum;
  }

 private:
  struct Wave {
    double kx = 0;
    double ky = 0;
    double phase = 0;
  };
  std::array<Wave, 30> waves_;
};

/// Disparity of a plane: linear in the pixel's place, as any plane's is.
struct SlantedPlane {
  double at_center, along_x, along_y;
  [[nodiscard]] double at(int x, int y) const {
    return at_center + along_x * (x - 320) + along_y * (y - 240);
  }
};

struct Pair {
  cv::Mat left = cv::Mat(480, 640, CV_8UC1);
  cv::Mat right = cv::Mat(480, 640, CV_8UC1);
};

/// The texture belongs to the right image; the left one shows it shifted by the surface's disparity.
template <class Surface>
Pair render(const Surface& plane, unsigned seed, double noise) {
  const Texture texture(seed);
  std::mt19937 random(seed + 1000);
  std::normal_distribution<double> grain(0, noise);
  Pair pair;
  for (int y = 0; y < 480; ++y) {
    for (int x = 0; x < 640; ++x) {
      pair.right.at<std::uint8_t>(y, x) = cv::saturate_cast<std::uint8_t>(texture.at(x, y) + grain(random));
      const double brighter = 6;  // the eyes' exposures differ
      pair.left.at<std::uint8_t>(y, x) =
          cv::saturate_cast<std::uint8_t>(texture.at(x - plane.at(x, y), y) + brighter + grain(random));
    }
  }
  return pair;
}

struct Errors {
  double valid = 0;       ///< share
  double bad = 0;         ///< share of the valid ones, wrong by more than 1 px
  double rms_px = 0;      ///< of those not bad
  double locking_px = 0;  ///< largest mean error over disparities of equal fraction
  double normalised = 0;  ///< rms of error / told sigma
};

Errors errors_of(const DisparityImage& image, const SlantedPlane& plane) {
  Errors errors;
  std::array<double, 8> sum_by_fraction{};
  std::array<int, 8> count_by_fraction{};
  double squares = 0;
  double normalised = 0;
  int seen = 0;
  int valid = 0;
  int bad = 0;
  for (int y = 20; y < 460; ++y) {
    for (int x = 100; x < 620; ++x) {
      ++seen;
      const auto i = static_cast<std::size_t>(y * 640 + x);
      if (image.pixels[i] == 0) continue;
      ++valid;
      const double truth = plane.at(x, y);
      const double error = static_cast<double>(image.pixels[i] * DisparityImage::kUnit_px) - truth;
      if (std::abs(error) > 1) {
        ++bad;
        continue;
      }
      const auto fraction = static_cast<std::size_t>(8 * (truth - std::floor(truth)));
      sum_by_fraction[fraction] += error;
      ++count_by_fraction[fraction];
      squares += error * error;
      normalised +=
          std::pow(error / static_cast<double>(image.uncertainty[i] * DisparityImage::kSigmaUnit_px), 2);
    }
  }
  errors.valid = static_cast<double>(valid) / seen;
  errors.bad = static_cast<double>(bad) / std::max(valid, 1);
  errors.rms_px = std::sqrt(squares / std::max(valid - bad, 1));
  errors.normalised = std::sqrt(normalised / std::max(valid - bad, 1));
  for (std::size_t i = 0; i < sum_by_fraction.size(); ++i)
    if (count_by_fraction[i] > 0)
      errors.locking_px = std::max(errors.locking_px, std::abs(sum_by_fraction[i] / count_by_fraction[i]));
  return errors;
}

struct Case {
  const char* matcher;
  unsigned seed;
};

std::ostream& operator<<(std::ostream& out, const Case& c) {
  return out << c.matcher << " " << c.seed;
}

class SlantedFloor : public testing::TestWithParam<Case> {};

TEST_P(SlantedFloor, IsMatchedDenselyAndWithoutPixelLocking) {
  const SlantedPlane plane{30, 0.01, 0.06};
  const Pair pair = render(plane, GetParam().seed, 2.0);
  StereoSettings settings;
  settings.matcher = GetParam().matcher;
  settings.nearest_m = 0.8;
  Pinhole camera;
  camera.fx = 500;
  StereoMatcher matcher(settings, camera, search_everywhere(camera, 0.12, settings.nearest_m));
  DisparityImage image;
  Serial serial;
  matcher.match(pair.left, pair.right, serial, image);
  const Errors errors = errors_of(image, plane);
  RecordProperty("rms_px", std::to_string(errors.rms_px));
  std::printf("%s: %.1f %% valid, %.2f %% bad, rms %.3f px, locking %.3f px, error / sigma %.2f\n",
              GetParam().matcher, 100 * errors.valid, 100 * errors.bad, errors.rms_px, errors.locking_px,
              errors.normalised);
  EXPECT_GE(errors.valid, 0.95);
  EXPECT_LE(errors.bad, 0.005);
  EXPECT_LE(errors.rms_px, 0.10);
  EXPECT_LE(errors.locking_px, 0.05);
  EXPECT_GT(errors.normalised, 0.3);
  EXPECT_LT(errors.normalised, 1.3);
}

INSTANTIATE_TEST_SUITE_P(Matchers, SlantedFloor,
                         testing::Values(Case{"half", 1}, Case{"half", 2}, Case{"half", 3},
                                         Case{"quarter", 1}, Case{"quarter", 2}, Case{"sgbm", 1},
                                         Case{"block", 1}));

class Threads : public testing::TestWithParam<const char*> {};

TEST_P(Threads, MakeNoDifferenceToAnyByte) {
  const Pair pair = render(SlantedPlane{30, 0.01, 0.06}, 7, 2.0);
  StereoSettings settings;
  settings.matcher = GetParam();
  Pinhole camera;
  camera.fx = 500;
  const auto matched = [&](Parallel& parallel) {
    StereoMatcher matcher(settings, camera, search_everywhere(camera, 0.12, 0.8));
    DisparityImage image;
    matcher.match(pair.left, pair.right, parallel, image);
    return image;
  };
  Serial serial;
  const DisparityImage alone = matched(serial);
  ASSERT_GT(std::count_if(alone.pixels.begin(), alone.pixels.end(), [](auto p) { return p > 0; }), 100'000);
  for (const int threads : {1, 2, 3}) {
    ThreadPool pool(threads);
    const DisparityImage shared = matched(pool);
    EXPECT_EQ(shared.pixels, alone.pixels) << threads << " threads";
    EXPECT_EQ(shared.uncertainty, alone.uncertainty) << threads << " threads";
  }
}

/// A box that is looked down upon: floor, its side, its level top of twelve rows, floor far behind. A row has
/// one disparity, so that nothing is hidden from one eye.
struct Box {
  static constexpr int kBack = 200, kFront = 212, kFoot = 260;
  static constexpr double kSide_px = 40;
  [[nodiscard]] static double at(int /*x*/, int y) {
    if (y < kBack) return 22 + 0.05 * (y - kBack);
    if (y < kFront) return kSide_px + 0.5 * (y - kFront);
    return y < kFoot ? kSide_px : kSide_px + 0.15 * (y - kFoot);
  }
};

class BoxTop : public testing::TestWithParam<unsigned> {};

TEST_P(BoxTop, IsNeitherItsSideNorHigherThanItIs) {
  const Pair pair = render(Box{}, GetParam(), 2.0);
  StereoSettings settings;
  settings.nearest_m = 0.8;
  Pinhole camera;
  camera.fx = 500;
  StereoMatcher matcher(settings, camera, search_everywhere(camera, 0.12, settings.nearest_m));
  DisparityImage image;
  Serial serial;
  matcher.match(pair.left, pair.right, serial, image);
  int top = 0, wrong = 0, above = 0;
  for (int y = Box::kBack - 12; y < Box::kFront; ++y)
    for (int x = 100; x < 620; ++x) {
      const double found = image.pixels[static_cast<std::size_t>(y * 640 + x)] * DisparityImage::kUnit_px;
      if (found == 0) continue;
      if (y >= Box::kBack) ++top;
      if (y >= Box::kBack && std::abs(found - Box::at(x, y)) > 0.5) ++wrong;
      if (y < Box::kBack && found > 30) ++above;
    }
  EXPECT_GT(top, 520 * 12 / 4);
  EXPECT_LT(wrong, top / 50);
  EXPECT_LT(above, 520 / 20);
}

INSTANTIATE_TEST_SUITE_P(Seeds, BoxTop, testing::Values(1U, 2U, 3U));

INSTANTIATE_TEST_SUITE_P(Matchers, Threads, testing::Values("quarter", "block"));

TEST(StereoMatcher, FindsNothingWhereNothingCanBeMatched) {
  StereoMatcher matcher({}, Pinhole{}, search_everywhere(Pinhole{}, 0.12, 0.6));
  const cv::Mat plain(480, 640, CV_8UC1, cv::Scalar(100));
  DisparityImage image;
  Serial serial;
  matcher.match(plain, plain, serial, image);
  EXPECT_EQ(std::count(image.pixels.begin(), image.pixels.end(), 0), 640 * 480);
}

TEST(StereoMatcher, RefusesARangeThatTheImageCannotHold) {
  EXPECT_THROW(StereoMatcher({}, Pinhole{}, search_everywhere(Pinhole{}, 0.24, 0.1)), std::runtime_error);
}

}  // namespace
}  // namespace floornav
