#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <optional>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "tests/real/outputs.hpp"

namespace floornav {

/// How far the frame's floor near the robot lies above what its own pixels say: of each floor surfel there,
/// the median height of all pixels around its middle; the mean over the surfels, each as often as it has
/// points. Nothing where no floor was found. `surfels`: rows of surfels.csv; `points`: of the frame, in the
/// same world.
inline std::optional<double> near_floor_error(const std::vector<Row>& surfels, double frame,
                                              const Eigen::Vector2d& robot,
                                              const std::vector<Eigen::Vector3d>& points) {
  constexpr double kNearRobot_m = 2.0;
  constexpr double kAround_m = 0.15;
  constexpr double kBeside_m = 0.05;
  double sum = 0, weight = 0;
  for (const Row& s : surfels) {
    const Eigen::Vector3d middle(s.at("x"), s.at("y"), s.at("z"));
    const Eigen::Vector3d normal(s.at("nx"), s.at("ny"), s.at("nz"));
    const bool is_floor = s.at("frame") == frame && s.at("dominant") == 1 && s.at("traversable") == 1;
    if (!is_floor || (middle.head<2>() - robot).norm() > kNearRobot_m) continue;
    std::vector<double> above;
    for (const auto& p : points)
      if ((p - middle).head<2>().norm() < kAround_m && std::abs(normal.dot(p - middle)) < kBeside_m)
        above.push_back(normal.dot(p - middle));
    if (above.size() < 100) continue;
    const auto half = above.begin() + static_cast<std::ptrdiff_t>(above.size() / 2);
    std::ranges::nth_element(above, half);
    sum -= s.at("points") * *half;
    weight += s.at("points");
  }
  if (weight == 0) return std::nullopt;
  return sum / weight;
}

/// How steady the floor near the robot is from frame to frame: errors that stay, as a sensor's distortion at
/// a place does, count once, in the spread.
class FrameToFrame {
 public:
  void add(std::optional<double> error_m) {
    if (error_m)
      errors_m_.push_back(*error_m);
    else
      ++lost_;
  }
  void expect_steady(const char* name) const {
    ASSERT_GT(errors_m_.size(), 1U);
    const auto n = static_cast<double>(errors_m_.size());
    const double mean_m = std::accumulate(errors_m_.begin(), errors_m_.end(), 0.0) / n;
    double spread = 0, steps = 0;
    for (const double e : errors_m_) spread += (e - mean_m) * (e - mean_m);
    for (std::size_t i = 1; i < errors_m_.size(); ++i)
      steps += (errors_m_[i] - errors_m_[i - 1]) * (errors_m_[i] - errors_m_[i - 1]);
    const double sigma_m = std::sqrt(steps / (n - 1) / 2);  // of one, told by the difference of two
    std::printf(
        "%s: floor within 2 m, frame to frame %.2f mm (1 sigma), spread %.2f mm, %zu frames, lost in %d\n",
        name, 1000 * sigma_m, 1000 * std::sqrt(spread / n), errors_m_.size(), lost_);
    EXPECT_LE(sigma_m, 0.003);
    EXPECT_EQ(lost_, 0);
  }

 private:
  std::vector<double> errors_m_;
  int lost_ = 0;
};

}  // namespace floornav
