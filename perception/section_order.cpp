#include "perception/section_order.hpp"

#include <algorithm>
#include <tuple>

namespace floornav {

namespace {

constexpr double kPathStep_m = 0.1;
constexpr int kMaxPathSteps = 1000;

}  // namespace

void SectionOrder::find_path_sections(const Pose& T_world_body) {
  on_path_.assign(static_cast<std::size_t>(grid_.count()), 0);
  const Pose T_body_world = T_world_body.inverse();
  const double z = T_world_body.translation().z();
  const auto mark = [&](const Eigen::Vector2d& place) {
    const Eigen::Vector3f p = (T_body_world * Eigen::Vector3d(place.x(), place.y(), z)).cast<float>();
    const int section = grid_.at(p.x(), p.y());
    if (section >= 0) on_path_[static_cast<std::size_t>(section)] = 1;
  };
  for (std::size_t i = 0; i < path_.size(); ++i) {
    mark(path_[i]);
    if (i == 0) continue;
    const Eigen::Vector2d way = path_[i] - path_[i - 1];
    const int steps = static_cast<int>(std::min<double>(way.norm() / kPathStep_m, kMaxPathSteps));
    for (int k = 1; k < steps; ++k) mark(path_[i - 1] + way * k / steps);
  }
}

std::span<const int> SectionOrder::order(std::span<const std::int16_t> ages, const Pose& T_world_body) {
  find_path_sections(T_world_body);
  order_.clear();
  for (int section = grid_.y_res(); section < grid_.count(); ++section) order_.push_back(section);
  const auto rank = [&](int section) {
    const auto s = static_cast<std::size_t>(section);
    const int kind = ages[s] >= kMaxAge ? 0 : on_path_[s] != 0 ? 1 : 2;
    return std::tuple(kind, grid_.row_of(section), -ages[s], section);
  };
  std::sort(order_.begin(), order_.end(), [&](int a, int b) { return rank(a) < rank(b); });
  return order_;
}

}  // namespace floornav
