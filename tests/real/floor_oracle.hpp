#pragma once

#include <cmath>
#include <random>
#include <vector>

#include <Eigen/Dense>
#include <opencv2/core.hpp>

namespace floornav {

/// A plane in some frame: normal . p = distance.
struct OraclePlane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  double distance_m = 0;
  int inliers = 0;
  [[nodiscard]] double above(const Eigen::Vector3d& p) const { return normal.dot(p) - distance_m; }
};

/// What a fit may expect of the floor.
struct OracleGuess {
  Eigen::Vector3d normal;
  double distance_m = 0;
  double angle_deg = 12;
  double offset_m = 0.25;
};

/// Every measured pixel of a 16-bit depth image, in the sensor's frame.
inline std::vector<Eigen::Vector3d> points_of(const cv::Mat& image, double counts_per_m, double fx, double fy,
                                              double cx, double cy) {
  std::vector<Eigen::Vector3d> points;
  for (int v = 0; v < image.rows; ++v)
    for (int u = 0; u < image.cols; ++u) {
      const std::uint16_t count = image.at<std::uint16_t>(v, u);
      const double z = count / counts_per_m;
      if (count != 0 && count != 65535) points.emplace_back((u - cx) / fx * z, (v - cy) / fy * z, z);
    }
  return points;
}

/// The plane near the guess that most of the points lie on: plain RANSAC over all of them, then least
/// squares. It shares nothing with the project's perception: no region of interest, no sections, no noise
/// model.
inline OraclePlane fit_floor(const std::vector<Eigen::Vector3d>& points, const OracleGuess& guess) {
  constexpr int kTrials = 400;
  constexpr std::size_t kStride = 7;
  constexpr double kInlier_m = 0.015;
  std::vector<Eigen::Vector3d> near;
  for (std::size_t i = 0; i < points.size(); i += kStride)
    if (std::abs(guess.normal.dot(points[i]) - guess.distance_m) < guess.offset_m && points[i].norm() < 3.5)
      near.push_back(points[i]);
  OraclePlane best;
  if (near.size() < 100) return best;
  std::mt19937 random(1);
  std::uniform_int_distribution<std::size_t> any(0, near.size() - 1);
  for (int trial = 0; trial < kTrials; ++trial) {
    const Eigen::Vector3d a = near[any(random)];
    Eigen::Vector3d normal = (near[any(random)] - a).cross(near[any(random)] - a).normalized();
    if (normal.dot(guess.normal) < 0) normal = -normal;
    if (!(normal.dot(guess.normal) > std::cos(guess.angle_deg * M_PI / 180))) continue;
    OraclePlane plane{normal, normal.dot(a), 0};
    for (const auto& p : near) plane.inliers += std::abs(plane.above(p)) < kInlier_m ? 1 : 0;
    if (plane.inliers > best.inliers) best = plane;
  }
  for (int round = 0; round < 5; ++round) {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    std::vector<Eigen::Vector3d> on;
    for (const auto& p : near)
      if (std::abs(best.above(p)) < kInlier_m) on.push_back(p);
    for (const auto& p : on) middle += p / static_cast<double>(on.size());
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (const auto& p : on) spread += (p - middle) * (p - middle).transpose();
    Eigen::Vector3d normal = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().col(0);
    if (normal.dot(guess.normal) < 0) normal = -normal;
    best = {normal, normal.dot(middle), static_cast<int>(on.size())};
  }
  return best;
}

inline double angle_between_deg(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::acos(std::clamp(a.normalized().dot(b.normalized()), -1.0, 1.0)) * 180 / M_PI;
}

}  // namespace floornav
