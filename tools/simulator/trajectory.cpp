#include "tools/simulator/trajectory.hpp"

#include <algorithm>
#include <cmath>

namespace floornav {
namespace {

constexpr int kPieces = 64;  ///< of a segment of the spline

/// Uniform cubic B-spline between its second and third control point, `t` in [0, 1].
Eigen::Vector2d spline(const Eigen::Vector2d* p, double t) {
  const double u = 1.0 - t;
  return (u * u * u * p[0] + (3 * t * t * t - 6 * t * t + 4) * p[1] + (3 * u * u * u - 6 * u * u + 4) * p[2] +
          t * t * t * p[3]) /
         6.0;
}

/// The waypoints with the ends mirrored outwards, so that the curve begins and ends at them.
std::vector<Eigen::Vector2d> control_points(const std::vector<Eigen::Vector2d>& waypoints) {
  std::vector<Eigen::Vector2d> points{2.0 * waypoints[0] - waypoints[1]};
  points.insert(points.end(), waypoints.begin(), waypoints.end());
  points.push_back(2.0 * waypoints[waypoints.size() - 1] - waypoints[waypoints.size() - 2]);
  return points;
}

}  // namespace

Trajectory::Trajectory(const DrivePlan& plan, double acceleration_mps2)
    : speed_mps_(plan.speed_mps), acceleration_mps2_(acceleration_mps2) {
  const std::vector<Eigen::Vector2d> control = control_points(plan.waypoints_m);
  points_.push_back(spline(control.data(), 0.0));
  arc_m_.push_back(0.0);
  for (std::size_t i = 0; i + 3 < control.size(); ++i) {
    for (int k = 1; k <= kPieces; ++k) {
      points_.push_back(spline(control.data() + i, static_cast<double>(k) / kPieces));
      arc_m_.push_back(arc_m_.back() + (points_.back() - points_[points_.size() - 2]).norm());
    }
  }
  speed_mps_ = std::min(speed_mps_, std::sqrt(length_m() * acceleration_mps2_));
  duration_s_ = length_m() / speed_mps_ + speed_mps_ / acceleration_mps2_;
}

double Trajectory::travelled_m(double time_s) const {
  const double t = std::clamp(time_s, 0.0, duration_s_);
  const double ramp_s = speed_mps_ / acceleration_mps2_;
  if (t < ramp_s) return 0.5 * acceleration_mps2_ * t * t;
  const double left_s = duration_s_ - t;
  if (left_s < ramp_s) return length_m() - 0.5 * acceleration_mps2_ * left_s * left_s;
  return speed_mps_ * (t - 0.5 * ramp_s);
}

PlanarState Trajectory::at(double time_s) const {
  const double arc = travelled_m(time_s);
  const auto after = std::upper_bound(arc_m_.begin() + 1, arc_m_.end() - 1, arc);
  const auto i = static_cast<std::size_t>(after - arc_m_.begin());
  const double fraction = std::clamp((arc - arc_m_[i - 1]) / (arc_m_[i] - arc_m_[i - 1]), 0.0, 1.0);
  // the direction is blended between the pieces before and after, so that it turns without jerks
  const auto piece = [this](std::size_t k) { return (points_[k] - points_[k - 1]).normalized(); };
  const std::size_t neighbour =
      fraction < 0.5 ? std::max<std::size_t>(i, 2) - 1 : std::min(i + 1, points_.size() - 1);
  const double weight = std::fabs(fraction - 0.5);
  return {points_[i - 1] + fraction * (points_[i] - points_[i - 1]),
          ((1.0 - weight) * piece(i) + weight * piece(neighbour)).normalized()};
}

}  // namespace floornav
