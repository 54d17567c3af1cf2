#include "tools/bench/stereo_scenes.hpp"

#include <array>
#include <cmath>

#include "drivers/bumblebee/eye_images.hpp"
#include "tools/simulator/portable_math.hpp"
#include "tools/simulator/random.hpp"
#include "tools/simulator/sensor_spec.hpp"

namespace floornav {
namespace {

constexpr double kNear_m = 3.0;

Shapes random_shapes(std::uint64_t seed) {
  constexpr int kThings = 7;
  constexpr double kWall_m = 4.6;
  RandomStream random(seed);
  Shapes shapes;
  shapes.blocks.push_back({{{kWall_m + 0.1, 0}, {1, 0}, {0.1, 10}}, 0, 2.5, {0, 0}});
  for (int i = 0; i < kThings; ++i) {
    const Eigen::Vector2d place(random.uniform(1.3, 4.2), random.uniform(-1.5, 1.5));
    const double height_m = random.uniform(0.05, 0.6);
    const double half_m = random.uniform(0.05, 0.25);
    const SinCos turn = sin_cos_deg(random.uniform(0, 90));
    if (i % 3 == 0)
      shapes.cylinders.push_back({place, half_m, 0, height_m});
    else
      shapes.blocks.push_back({{place, {turn.cos, turn.sin}, {half_m, 0.6 * half_m}}, 0, height_m, {0, 0}});
  }
  return shapes;
}

cv::Mat grey_of(const cv::Mat& raw, const std::string& bayer) {
  if (bayer.empty()) return raw.clone();
  EyeImages eyes({raw.cols, raw.rows, 1, bayer});
  return eyes.split({raw.data, raw.total()}).front().clone();
}

/// What the left eye sees lies at `disparity`; whether the right one, which sees `right`, sees it too.
cv::Mat1b seen_by_both(const cv::Mat1f& disparity, const cv::Mat1f& right) {
  constexpr float kSame_px = 1.0F;
  cv::Mat1b seen(disparity.size(), 0);
  for (int y = 0; y < seen.rows; ++y)
    for (int x = 0; x < seen.cols; ++x) {
      const float d = disparity(y, x);
      const auto there = static_cast<int>(std::lround(static_cast<float>(x) - d));
      seen(y, x) = d > 0 && there >= 0 && std::fabs(right(y, there) - d) < kSame_px ? 1 : 0;
    }
  return seen;
}

cv::Mat1b near_floor_of(const StereoRig& rig, const Pose& T_world_left, const cv::Mat1f& disparity) {
  const cv::Mat1f bare = rig.true_disparity(Shapes{}, T_world_left);
  const Pinhole& camera = rig.spec().ideal;
  const auto focal_baseline = static_cast<float>(static_cast<double>(camera.fx) * rig.spec().baseline_m());
  cv::Mat1b floor(disparity.size(), 0);
  for (int y = 0; y < floor.rows; ++y)
    for (int x = 0; x < floor.cols; ++x) {
      const float d = disparity(y, x);
      if (d <= 0 || d != bare(y, x)) continue;
      const Eigen::Vector3f p = focal_baseline / d * camera.ray(static_cast<float>(x), static_cast<float>(y));
      const Eigen::Vector3d place = T_world_left * p.cast<double>();
      floor(y, x) = (place - T_world_left.translation()).head<2>().norm() < kNear_m ? 1 : 0;
    }
  return floor;
}

}  // namespace

std::vector<StereoScene> stereo_scenes(StereoRig& rig, int count, std::uint64_t seed) {
  const Pose T_world_left = mounted(0.0, 0.0, 0.72, 20.0);
  const Pose T_world_right = T_world_left * Eigen::Translation3d(rig.spec().baseline_m(), 0, 0);
  std::vector<StereoScene> scenes;
  for (int i = 0; i < count; ++i) {
    const Shapes shapes = random_shapes(random_key({seed, static_cast<std::uint64_t>(i)}));
    const std::vector<cv::Mat>& raw = rig.see(shapes, T_world_left, i);
    StereoScene scene;
    scene.raw_right = grey_of(raw.front(), rig.spec().bayer);
    scene.raw_left = grey_of(raw.back(), rig.spec().bayer);
    scene.disparity = rig.true_disparity(shapes, T_world_left);
    scene.seen_by_both = seen_by_both(scene.disparity, rig.true_disparity(shapes, T_world_right));
    scene.near_floor = near_floor_of(rig, T_world_left, scene.disparity);
    scenes.push_back(std::move(scene));
  }
  return scenes;
}

void StereoQuality::add(const StereoScene& scene, const cv::Mat1f& found, cv::Range rows) {
  for (int y = rows.start; y < rows.end; ++y)
    for (int x = 0; x < found.cols; ++x) {
      if (scene.seen_by_both(y, x) == 0) continue;
      const bool has = found(y, x) > 0;
      if (scene.near_floor(y, x) != 0) {
        ++floor;
        floor_valid += has ? 1 : 0;
      }
      if (!has) continue;
      ++valid;
      const double error = static_cast<double>(found(y, x) - scene.disparity(y, x));
      if (std::fabs(error) > 1)
        ++bad;
      else
        squares_px2 += error * error;
    }
}

double locking_px(const StereoScene& scene, const cv::Mat1f& found) {
  std::array<double, 8> sums{};
  std::array<int, 8> counts{};
  for (int y = 0; y < found.rows; ++y)
    for (int x = 0; x < found.cols; ++x) {
      const float truth = scene.disparity(y, x);
      const float error = found(y, x) - truth;
      if (found(y, x) <= 0 || scene.near_floor(y, x) == 0 || std::fabs(error) > 1) continue;
      const auto fraction = static_cast<std::size_t>(8 * (truth - std::floor(truth)));
      sums[fraction] += static_cast<double>(error);
      ++counts[fraction];
    }
  double worst = 0;
  for (std::size_t i = 0; i < sums.size(); ++i)
    if (counts[i] > 0) worst = std::max(worst, std::fabs(sums[i] / counts[i]));
  return worst;
}

}  // namespace floornav
