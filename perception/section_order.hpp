#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "perception/sections.hpp"
#include "runtime/geometry/pose.hpp"

namespace floornav {

/// In which order a frame's sections have their turn (section 4.3).
class SectionOrder {
 public:
  static constexpr std::int16_t kMaxAge =
      10;  ///< frames; then a section comes before all rows but the nearest

  explicit SectionOrder(const SectionGrid& grid) : grid_(grid) {}

  /// Where the robot is going, points of a path in the local world frame; empty: nowhere.
  void set_path(std::span<const Eigen::Vector2d> path) { path_.assign(path.begin(), path.end()); }

  /// All sections but those of the nearest row: first those that have waited too long, then those on the
  /// path, then the others; of each kind the nearest row first, in a row the longest wait first. `ages`:
  /// frames since each section was last done.
  std::span<const int> order(std::span<const std::int16_t> ages, const Pose& T_world_body);

 private:
  void find_path_sections(const Pose& T_world_body);

  SectionGrid grid_;
  std::vector<Eigen::Vector2d> path_;
  std::vector<std::uint8_t> on_path_;  ///< a section
  std::vector<int> order_;
};

}  // namespace floornav
