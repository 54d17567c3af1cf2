#include "perception/crossing_sides.hpp"

#include <algorithm>
#include <cmath>

#include "perception/uprightness.hpp"

namespace floornav {

namespace {

constexpr std::int32_t kLeastPoints = 3;
constexpr float kTouch_m = 0.05F;  // what is no farther from a plane may reach to it

/// Whether a side's plane cuts the square of a cell at a height.
bool cuts(const Surfel& side, const Eigen::Vector2d& middle, float z_m, double pitch_m) {
  const Eigen::Vector3d normal = side.normal.cast<double>();
  const double off_m =
      normal.dot(Eigen::Vector3d(middle.x(), middle.y(), static_cast<double>(z_m)) - side.centroid_m);
  return std::abs(off_m) < 0.5 * pitch_m * (std::abs(normal.x()) + std::abs(normal.y()));
}

}  // namespace

void CrossingSides::note(std::int32_t cell, std::span<const CellPoint> points,
                         std::span<const Surfel> surfels) {
  Side most;
  Side here;
  for (const CellPoint& p : points) {
    if (p.surfel < 0 || std::abs(surfels[static_cast<std::size_t>(p.surfel)].normal.z()) > kSideUpright)
      continue;
    if (p.surfel != here.surfel) {
      if (here.points > most.points) most = here;
      here = {p.surfel, 0, p.z_m, p.z_m};
    }
    ++here.points;
    here.lowest_z_m = std::min(here.lowest_z_m, p.z_m);
    here.highest_z_m = std::max(here.highest_z_m, p.z_m);
  }
  sides_[static_cast<std::size_t>(cell)] = here.points > most.points ? here : most;
}

bool CrossingSides::cross(std::int32_t cell, float z_m, const CellWindow& window,
                          std::span<const Surfel> surfels) const {
  const std::int32_t x = cell % window.size_x(), y = cell / window.size_x();
  const CellIndex index = window.cell(cell);
  const Eigen::Vector2d middle(window.lattice().center_of(index.ix), window.lattice().center_of(index.iy));
  for (std::int32_t v = std::max(0, y - 1); v <= std::min(window.size_y() - 1, y + 1); ++v)
    for (std::int32_t u = std::max(0, x - 1); u <= std::min(window.size_x() - 1, x + 1); ++u) {
      const Side& side = sides_[static_cast<std::size_t>(v * window.size_x() + u)];
      if (side.points < kLeastPoints) continue;
      const float up_m = side.highest_z_m - z_m, down_m = z_m - side.lowest_z_m;
      if (std::min(up_m, down_m) < -kTouch_m || std::max(up_m, down_m) <= least_height_m_) continue;
      if (cuts(surfels[static_cast<std::size_t>(side.surfel)], middle, z_m, window.lattice().pitch_m))
        return true;
    }
  return false;
}

}  // namespace floornav
