#include "mapping/view_coverage.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace floornav {
namespace {

constexpr double kAround_m = 0.1;
constexpr float kLeastUpright = 0.87F;  // of a floor's normal's z: 30 degrees
constexpr float kMostUpright = 0.5F;    // of a side's
constexpr float kHardlySeen = 0.1F;     // share of the points of the fullest cell around
constexpr float kSeenInPart = 0.4F;  // half a cell is as much as one row of pixels more or less makes of it

/// z of the normal of the plane that decides a cell; 0 where there is none.
float upright(const CellEvidence& cell, const FloorEvidence& evidence) {
  return cell.points > 0 && cell.surfel >= 0
             ? std::abs(evidence.surfels[static_cast<std::size_t>(cell.surfel)].normal.z())
             : 0.0F;
}

/// How far a cell's plane lies above another one's, which is carried on to it.
float above_m(const CellEvidence& cell, const CellEvidence& other, const FloorEvidence& evidence) {
  const Eigen::Vector3f& normal = evidence.surfels[static_cast<std::size_t>(other.surfel)].normal;
  const auto pitch_m = static_cast<float>(evidence.lattice.pitch_m);
  const Eigen::Vector2f way_m(pitch_m * static_cast<float>(cell.cell.ix - other.cell.ix),
                              pitch_m * static_cast<float>(cell.cell.iy - other.cell.iy));
  return cell.mean_z_m - other.mean_z_m + normal.head<2>().dot(way_m) / normal.z();
}

}  // namespace

void ViewCoverage::begin(const FloorEvidence& evidence, std::span<const std::uint32_t> entries) {
  range_cells_ =
      std::clamp(static_cast<std::int32_t>(std::lround(kAround_m / evidence.lattice.pitch_m)), 1, 4);
  sensor_m_ = (evidence.T_world_body * evidence.T_body_sensor).translation();
  CellIndex low = evidence.cells[entries.front()].cell;
  CellIndex high = low;
  for (const std::uint32_t entry : entries) {
    const CellIndex cell = evidence.cells[entry].cell;
    low = {std::min(low.ix, cell.ix), std::min(low.iy, cell.iy)};
    high = {std::max(high.ix, cell.ix), std::max(high.iy, cell.iy)};
  }
  origin_ = low;
  length_ = high.ix - low.ix + 1;
  width_ = high.iy - low.iy + 1;
  const auto cells = static_cast<std::size_t>(length_) * static_cast<std::size_t>(width_);
  fullest_.assign(cells, Plane{});
  is_level_.assign(cells, 0);
  side_top_z_m_.assign(cells, -std::numeric_limits<float>::infinity());
}

void ViewCoverage::take(const FloorEvidence& evidence, std::span<const std::uint32_t> entries) {
  if (entries.empty()) return;
  begin(evidence, entries);
  for (const std::uint32_t entry : entries) {
    const CellEvidence& cell = evidence.cells[entry];
    const std::size_t place = place_of(cell.cell);
    const float up = upright(cell, evidence);
    if (up >= kLeastUpright) {
      fullest_[place] = {cell.points, entry};
      is_level_[place] = 1;
    } else if (cell.surfel >= 0 && up < kMostUpright && cell.points > 0) {
      side_top_z_m_[place] = std::max(side_top_z_m_[place], cell.top_z_m);
    }
  }
  find_fullest();
}

/// The greatest within a square is that of its rows' greatest.
void ViewCoverage::find_fullest() {
  const auto fuller = [](const Plane& a, const Plane& b) { return b.points > a.points ? b : a; };
  along_y_ = fullest_;
  const auto spread = [&](std::vector<Plane>& to, const std::vector<Plane>& from, std::int32_t stride,
                          std::int32_t at, std::int32_t size, std::size_t place) {
    for (std::int32_t d = std::max(-range_cells_, -at); d <= std::min(range_cells_, size - 1 - at); ++d)
      to[place] = fuller(to[place], from[place + static_cast<std::size_t>(d * stride)]);
  };
  std::size_t place = 0;
  for (std::int32_t x = 0; x < length_; ++x)
    for (std::int32_t y = 0; y < width_; ++y) spread(along_y_, fullest_, 1, y, width_, place++);
  place = 0;
  for (std::int32_t x = 0; x < length_; ++x)
    for (std::int32_t y = 0; y < width_; ++y) spread(fullest_, along_y_, width_, x, length_, place++);
}

/// The cell before this one, as seen from the sensor, holds a side that is clearly higher than the sight
/// line; that of a box goes no higher than the sight line to its own top.
bool ViewCoverage::is_behind_side(const FloorEvidence& evidence, const CellEvidence& cell) const {
  const Lattice& lattice = evidence.lattice;
  const Eigen::Vector2d middle_m(lattice.center_of(cell.cell.ix), lattice.center_of(cell.cell.iy));
  const Eigen::Vector2d way_m = sensor_m_.head<2>() - middle_m;
  const double share = std::min(1.0, lattice.pitch_m / way_m.norm());
  const Eigen::Vector2d before_m = middle_m + share * way_m;
  const CellIndex before = lattice.cell_of(before_m.x(), before_m.y());
  if (!holds(before)) return false;
  constexpr double kClearly_m = 0.05;
  const double floor_z_m = static_cast<double>(cell.mean_z_m);
  if (before == cell.cell) return false;
  return static_cast<double>(side_top_z_m_[place_of(before)]) >
         floor_z_m + share * (sensor_m_.z() - floor_z_m) + kClearly_m;
}

bool ViewCoverage::is_beside_unseen(CellIndex cell) const {
  for (std::int32_t x = cell.ix - 1; x <= cell.ix + 1; ++x)
    for (std::int32_t y = cell.iy - 1; y <= cell.iy + 1; ++y)
      if (!holds({x, y}) || is_level_[place_of({x, y})] == 0) return true;
  return false;
}

Coverage ViewCoverage::of(const FloorEvidence& evidence, std::uint32_t entry) const {
  const CellEvidence& cell = evidence.cells[entry];
  if (upright(cell, evidence) < kLeastUpright) return Coverage::kWhole;
  const bool is_floor = evidence.surfels[static_cast<std::size_t>(cell.surfel)].dominant;
  if ((cell.partly_hidden && is_floor) || is_behind_side(evidence, cell)) return Coverage::kGlimpse;
  const CellEvidence& fullest = evidence.cells[fullest_[place_of(cell.cell)].entry];
  const auto all = static_cast<float>(fullest.points);
  const auto seen = static_cast<float>(cell.points);
  if (seen >= kSeenInPart * all || std::abs(above_m(cell, fullest, evidence)) > same_surface_m_)
    return Coverage::kWhole;
  return seen < kHardlySeen * all || is_beside_unseen(cell.cell) ? Coverage::kGlimpse : Coverage::kPart;
}

}  // namespace floornav
