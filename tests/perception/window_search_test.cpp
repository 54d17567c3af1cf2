#include "perception/window_search.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <random>
#include <string>

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include "perception/outliers.hpp"
#include "tests/perception/rendered_scene.hpp"

namespace floornav {
namespace {

/// Points on the rays of their pixels.
struct Image {
  Pinhole camera{131.25F, 131.25F, 79.5F, 59.5F, 160, 120};
  std::vector<float> x, y, z;
  std::vector<std::int32_t> pixel;

  void add(int row, int column, float depth) {
    const Eigen::Vector3f ray = camera.ray(static_cast<float>(column), static_cast<float>(row));
    x.push_back(ray.x() * depth);
    y.push_back(ray.y() * depth);
    z.push_back(depth);
    pixel.push_back(row * camera.width + column);
  }
  /// depth(row, column): 0 for no point.
  void fill(const std::function<float(int, int)>& depth) {
    for (int row = 0; row < camera.height; ++row)
      for (int column = 0; column < camera.width; ++column)
        if (const float d = depth(row, column); d > 0.0F) add(row, column, d);
  }
  [[nodiscard]] ImagePoints points() const { return {{x, y, z}, pixel, camera}; }
};

std::vector<std::uint32_t> bits_of(const std::vector<float>& values) {
  std::vector<std::uint32_t> bits;
  for (const float value : values) bits.push_back(std::bit_cast<std::uint32_t>(value));
  return bits;
}

/// Compares each point with each other one.
std::vector<float> brute_force(const Image& image, int neighbors) {
  std::vector<float> means;
  for (std::size_t i = 0; i < image.x.size(); ++i) {
    std::vector<float> squared;
    for (std::size_t j = 0; j < image.x.size(); ++j) {
      const float dx = image.x[i] - image.x[j], dy = image.y[i] - image.y[j], dz = image.z[i] - image.z[j];
      if (i != j) squared.push_back((dx * dx + dy * dy) + dz * dz);
    }
    const auto end = squared.begin() + neighbors;
    std::partial_sort(squared.begin(), end, squared.end());
    float sum = 0.0F;
    for (auto s = squared.begin(); s != end; ++s) sum += std::sqrt(*s);
    means.push_back(sum / static_cast<float>(neighbors));
  }
  return means;
}

std::vector<float> by_tree(const Image& image, int neighbors) {
  std::vector<float> means(image.x.size());
  Serial serial;
  mean_neighbor_distances(image.points().points, neighbors, serial, means);
  return means;
}

std::vector<float> by_window(const Image& image, int neighbors) {
  std::vector<float> means(image.x.size());
  Serial serial;
  WindowSearch search;
  EXPECT_TRUE(search.mean_distances(image.points(), neighbors, serial, means));
  return means;
}

void expect_as_tree(const Image& image, int neighbors) {
  EXPECT_EQ(bits_of(by_window(image, neighbors)), bits_of(by_tree(image, neighbors)))
      << image.x.size() << " points, K = " << neighbors;
}

Image rendered(unsigned seed) {
  RenderedScene scene;
  scene.camera = {131.25F, 131.25F, 79.5F, 59.5F, 160, 120};
  scene.baseline_m = 0.3F;
  scene.mount(0.9, 25.0, 3.0);
  scene.seed = seed;
  scene.missing_share = 0.05 * (seed % 3);
  scene.boxes.push_back({{1.2, 0.1, 0.0}, {1.5, 0.4, 0.15}});
  scene.boxes.push_back({{2.0, -0.6, 0.0}, {2.5, -0.2, 0.6}});
  const DepthFrame frame = scene.render();
  Image image;
  std::mt19937 random(seed);
  image.fill([&](int row, int column) {
    const std::uint16_t count = frame.pixels[static_cast<std::size_t>(row * frame.camera.width + column)];
    const bool flies = random() % 100 == 0;
    return static_cast<float>(count) * frame.scale * (flies ? 0.7F : 1.0F);
  });
  return image;
}

class WindowSearchOfScene : public testing::TestWithParam<unsigned> {};

TEST_P(WindowSearchOfScene, GivesTheBitsOfTheTree) {
  const Image image = rendered(GetParam());
  ASSERT_GT(image.x.size(), 10'000U);
  for (const int neighbors : {1, 7, 8, 9, 20, 33, 64}) expect_as_tree(image, neighbors);
}

INSTANTIATE_TEST_SUITE_P(Seeds, WindowSearchOfScene, testing::Range(0U, 6U));

TEST(WindowSearch, GivesTheBitsOfComparingEachPointWithEachOther) {
  const Image whole = rendered(7);
  Image part;  // a ragged one
  for (std::size_t i = 0; i < whole.pixel.size(); ++i) {
    const int row = whole.pixel[i] / 160, column = whole.pixel[i] % 160;
    if (row > 60 && row < 90 && column > row - 20 && column < 100) part.add(row, column, whole.z[i]);
  }
  ASSERT_GT(part.x.size(), 1000U);
  for (const int neighbors : {1, 8, 20})
    EXPECT_EQ(bits_of(by_window(part, neighbors)), bits_of(brute_force(part, neighbors)));
}

/// Each instruction set that this machine has, the portable kernel among them.
TEST(WindowSearch, EveryKernelGivesTheSameBits) {
  const Image image = rendered(3);
  for (const int neighbors : {8, 20}) {
    const auto expected = bits_of(by_tree(image, neighbors));
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
      hwy::SetSupportedTargetsForTest(target);
      hwy::GetChosenTarget().Update(hwy::SupportedTargets());
      EXPECT_EQ(bits_of(by_window(image, neighbors)), expected) << hwy::TargetName(target);
    }
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }
}

TEST(WindowSearch, SearchesFartherWherePointsAreFew) {
  Image sparse;
  std::mt19937 random(5);
  std::uniform_real_distribution<float> depth(0.4F, 6.0F);
  sparse.fill([&](int, int) { return random() % 40 == 0 ? depth(random) : 0.0F; });
  for (const int neighbors : {1, 8, 20, 64}) expect_as_tree(sparse, neighbors);
  Image noise;
  noise.fill([&](int, int) { return depth(random); });
  for (const int neighbors : {1, 8, 20}) expect_as_tree(noise, neighbors);
}

TEST(WindowSearch, LeavesWhatIsTooFarApartToTheTree) {
  Image image;
  image.camera = {525.0F, 525.0F, 319.5F, 239.5F, 640, 480};
  std::mt19937 random(6);
  std::uniform_real_distribution<float> depth(0.4F, 9.0F);
  image.fill([&](int, int) { return random() % 50 == 0 ? depth(random) : 0.0F; });
  std::vector<float> means(image.x.size());
  Serial serial;
  WindowSearch search;
  ASSERT_TRUE(search.mean_distances(image.points(), 8, serial, means));
  EXPECT_GT(search.left_to_tree(), 0U);
  EXPECT_EQ(bits_of(means), bits_of(by_tree(image, 8)));
}

TEST(WindowSearch, SingleRowsColumnsAndTilesOfEverySizeAreExact) {
  for (const auto& [rows, columns] :
       {std::pair{1, 160}, {120, 1}, {2, 3}, {3, 3}, {5, 17}, {17, 5}, {40, 31}}) {
    Image image;
    image.fill([&, rows = rows, columns = columns](int row, int column) {
      return row >= 50 - rows / 2 && row < 50 - rows / 2 + rows && column < columns
                 ? 1.0F + 0.01F * static_cast<float>((row * 7 + column * 3) % 5)
                 : 0.0F;
    });
    for (const int neighbors : {1, 5, 8})
      if (image.x.size() > static_cast<std::size_t>(neighbors)) expect_as_tree(image, neighbors);
  }
}

TEST(WindowSearch, EqualDepthsAreExact) {
  for (const float depth : {0.3F, 1.0F, 5.0F}) {
    Image image;
    image.fill([&](int, int) { return depth; });
    for (const int neighbors : {4, 8, 20}) expect_as_tree(image, neighbors);
  }
}

TEST(WindowSearch, RefusesWhatTheImageDoesNotOrder) {
  Serial serial;
  WindowSearch search;
  std::vector<float> means(200);
  const auto refuses = [&](const Image& image, int neighbors) {
    return !search.mean_distances(image.points(), neighbors, serial, means);
  };
  Image image;
  image.fill([](int row, int column) { return row < 10 && column < 20 ? 1.0F : 0.0F; });
  ASSERT_EQ(image.x.size(), 200U);
  EXPECT_FALSE(refuses(image, 8));
  Image off_ray = image;
  off_ray.x[77] += 1e-4F;
  EXPECT_TRUE(refuses(off_ray, 8));
  Image twice = image;
  twice.pixel[78] = twice.pixel[77];
  EXPECT_TRUE(refuses(twice, 8));
  Image behind = image;
  behind.z[5] = -1.0F;
  EXPECT_TRUE(refuses(behind, 8));
  Image no_number = image;
  no_number.y[5] = std::nanf("");
  EXPECT_TRUE(refuses(no_number, 8));
  Image few;
  for (int column = 0; column < 8; ++column) few.add(3, column, 1.0F);
  EXPECT_TRUE(refuses(few, 8));
}

/// All points in one place lie on no rays: nanoflann decides.
TEST(WindowSearch, IdenticalPointsAreDecidedAsByNanoflann) {
  const std::size_t count = 50'000;
  const std::vector<float> x(count, 0.1F), y(count, 0.2F), z(count, 1.0F);
  std::vector<std::int32_t> pixel(count);
  for (std::size_t i = 0; i < count; ++i) pixel[i] = static_cast<std::int32_t>(i);
  const ImagePoints cloud{{x, y, z}, pixel, Pinhole{}};
  Serial serial;
  std::vector<std::uint8_t> by_nanoflann(count, 7), by_auto(count, 8), in_window(count, 9);
  OutlierRemover({8, 1.0, "nanoflann"}).remove(cloud, serial, by_nanoflann);
  OutlierRemover({8, 1.0, "auto"}).remove(cloud, serial, by_auto);
  OutlierRemover({8, 1.0, "window"}).remove(cloud, serial, in_window);
  EXPECT_EQ(by_auto, by_nanoflann);
  EXPECT_EQ(in_window, by_nanoflann);
}

/// The same remover on one cloud after the other, large and small, as sections follow each other.
TEST(WindowSearch, KeepsNothingOfTheCloudBefore) {
  OutlierRemover window({8, 1.0, "window"}), nanoflann({8, 1.0, "nanoflann"});
  Serial serial;
  std::int64_t removed = 0;
  for (const int rows : {90, 3, 0, 120, 1, 40}) {
    const Image whole = rendered(static_cast<unsigned>(rows));
    Image part;
    for (std::size_t i = 0; i < whole.pixel.size(); ++i)
      if (whole.pixel[i] / 160 < rows) part.add(whole.pixel[i] / 160, whole.pixel[i] % 160, whole.z[i]);
    std::vector<std::uint8_t> a(part.x.size(), 7), b(part.x.size(), 8);
    removed += window.remove(part.points(), serial, a);
    nanoflann.remove(part.points(), serial, b);
    EXPECT_EQ(a, b) << rows << " rows";
  }
  EXPECT_GT(removed, 100);
}

}  // namespace
}  // namespace floornav
