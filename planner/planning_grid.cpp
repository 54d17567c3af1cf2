#include "planner/planning_grid.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace floornav {
namespace {

constexpr std::int64_t kNeverTaken = -2;
constexpr std::int64_t kMaxCells = 1 << 25;  ///< of 16 bytes each, the searches' included

/// Squared gap in half cells from which the robot's circle moves freely. A way runs between centres of
/// neighbouring cells or through squares of four such cells, and is looked at every quarter of a cell: half a
/// cell's diagonal and an eighth of a cell make up for what lies between.
std::int16_t least_gap_of(double radius_in_cells) {
  const double with_samples = radius_in_cells + 0.125;
  return static_cast<std::int16_t>(std::ceil(4.0 * (with_samples * with_samples + 0.5)));
}

}  // namespace

void PlanningGrid::update(const GridMap& map, const CellRect& needed, const AssumedFloor& assumed,
                          const AssumedFloor& stands) {
  const bool same_map =
      map.lattice().pitch_m == lattice_.pitch_m && map.epoch == epoch_ && map.version >= version_;
  if (!same_map || !(assumed == assumed_) || window_.empty() || !window_.contains(needed))
    start_afresh(map, needed, assumed);
  version_ = map.version;
  CellRect changed = take_changed_tiles(map);
  changed = changed.joined(assume_floor_under(stands));
  if (changed.empty()) return;
  const CellRect grid{0, 0, search_.width, search_.height};
  blocked_gap_.update(cells_of(kBlocked), changed);
  find_near(kBlocked | kUnknown, kNearUnknown, least_gap_, unknown_scan_, changed);
  find_steps(changed.grown(1).clipped(grid));
  find_near(kAtStep, kNearStep, least_step_gap_, step_scan_, changed.grown(1).clipped(grid));
  const CellRect within_reach =
      changed.grown(std::max(blocked_gap_.reach(), step_scan_.reach() + 1)).clipped(grid);
  weigh(within_reach);
  open_edges(within_reach.grown(1).clipped(grid));
  if (!search_.weights.empty()) blocks_.update(search_, within_reach.grown(1).clipped(grid));
  project_open_cells(within_reach.grown(2).clipped(grid));
}

void PlanningGrid::start_afresh(const GridMap& map, const CellRect& needed, const AssumedFloor& assumed) {
  forget();  // until all below has succeeded
  lattice_ = map.lattice();
  epoch_ = map.epoch;
  assumed_ = assumed;
  outline_ = RobotOutline(robot_, lattice_.pitch_m);
  const double radius_in_cells = outline_.outer_radius();
  const auto least_reach = static_cast<std::int32_t>(std::ceil(radius_in_cells)) + 2;
  if (least_reach > GapScan::kMaxReach)
    throw std::invalid_argument("the robot's radius is more than " + std::to_string(GapScan::kMaxReach - 2) +
                                " cells of the map");
  const auto comfort = static_cast<std::int32_t>(std::ceil(settings_.comfort_m / lattice_.pitch_m));
  const std::int32_t reach = std::min(least_reach + comfort, GapScan::kMaxReach);
  const double wheels_in_cells = 0.5 * robot_.track_m / lattice_.pitch_m;
  least_gap_ = least_gap_of(outline_.inner_radius());
  roomy_gap_ = least_gap_of(radius_in_cells);
  least_step_gap_ = least_gap_of(std::min(wheels_in_cells, radius_in_cells));
  unknown_scan_ = GapScan(least_reach);
  step_scan_ = GapScan(least_reach);

  // Whole tiles, and one around them, so that a map that grows does not start afresh each time.
  constexpr std::int32_t kSide = GridTile::kSide;
  const CellRect window{(block_of(needed.x0, kSide) - 1) * kSide, (block_of(needed.y0, kSide) - 1) * kSide,
                        (block_of(needed.x1 - 1, kSide) + 2) * kSide,
                        (block_of(needed.y1 - 1, kSide) + 2) * kSide};
  search_.width = window.width();
  search_.height = window.height();
  if (std::int64_t{search_.width} * search_.height > kMaxCells)
    throw std::invalid_argument("the map and the way to the goal take more than " +
                                std::to_string(kMaxCells) + " cells");
  search_.steps = uniform() ? kExactSteps : kWeightedSteps;
  search_.whole_squares = true;
  const auto cells = static_cast<std::size_t>(search_.width) * static_cast<std::size_t>(search_.height);
  kinds_.assign(cells, kUnknown | kNearUnknown | kFits);
  map_edges_.assign(cells, 0xFF);
  terrain_.assign(cells, 0);
  search_.weights.assign(uniform() ? 0 : cells, 0);
  search_.edges.assign(cells, 0);
  open_cells_.reset(search_.width, search_.height);
  blocks_.reset(search_.width, search_.height);
  parted_cells_ = 0;
  blocked_gap_.reset(search_.width, search_.height, reach);
  weigh_gaps();
  tile_versions_.assign(cells / static_cast<std::size_t>(GridTile::kVertices), kNeverTaken);
  window_ = window;
}

std::uint8_t PlanningGrid::weight_of(double cost) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(cost * SearchGrid::kWeightUnit, 0.0, 255.0)));
}

bool PlanningGrid::uniform() const {
  return settings_.unknown_cost == 0 && settings_.belief_cost == 0 && settings_.slope_cost == 0 &&
         settings_.clearance_cost == 0;
}

void PlanningGrid::weigh_gaps() {
  const double comfort_m = std::max(settings_.comfort_m, 1e-6);
  gap_weights_.resize(static_cast<std::size_t>(blocked_gap_.cap()) + 1);
  for (std::size_t gap = 0; gap < gap_weights_.size(); ++gap) {
    const double spare_m = metres(static_cast<std::int16_t>(gap)) - robot_.radius_m;
    gap_weights_[gap] = weight_of(settings_.clearance_cost * std::clamp(1.0 - spare_m / comfort_m, 0.0, 1.0));
  }
}

bool PlanningGrid::clear(const RowSpan& span, GridCell from, Avoid avoid) const {
  const unsigned kinds = avoid == Avoid::kBlocked ? kBlocked : kBlocked | kUnknown;
  const std::int32_t y = span.y + from.y;
  const std::int32_t x0 = std::max(span.x0 + from.x, 0), x1 = std::min(span.x1 + from.x, search_.width - 1);
  if (y < 0 || y >= search_.height) return true;
  unsigned found = 0;
  for (std::int32_t x = x0; x <= x1; ++x) found |= kinds_[search_.index({x, y})];
  return (found & kinds) == 0;
}

Floor PlanningGrid::floor(GridCell cell) const {
  const unsigned kind = kinds_[search_.index(cell)];
  if ((kind & kBlocked) != 0) return Floor::kBlocked;
  if ((kind & kUnknown) != 0) return Floor::kUnknown;
  return (kind & kAssumed) != 0 ? Floor::kAssumed : Floor::kFree;
}

double PlanningGrid::clearance_m(GridCell cell) const {
  const std::int32_t reach = blocked_gap_.reach();
  const CellRect around =
      CellRect{cell.x - reach, cell.y - reach, cell.x + reach + 1, cell.y + reach + 1}.clipped(
          {0, 0, search_.width, search_.height});
  std::int32_t least = blocked_gap_.cap();
  for (std::int32_t y = around.y0; y < around.y1; ++y) {
    const std::int32_t dy = std::max(2 * std::abs(y - cell.y) - 1, 0);
    for (std::int32_t x = around.x0; x < around.x1; ++x) {
      if ((kinds_[search_.index({x, y})] & (kBlocked | kUnknown)) == 0) continue;
      const std::int32_t dx = std::max(2 * std::abs(x - cell.x) - 1, 0);
      least = std::min(least, dx * dx + dy * dy);
    }
  }
  return metres(static_cast<std::int16_t>(least));
}

GridCell PlanningGrid::cell_of(double x_m, double y_m) const {
  const CellIndex cell = lattice_.cell_of(x_m, y_m);
  return {cell.ix - window_.x0, cell.iy - window_.y0};
}

bool PlanningGrid::within(const AssumedFloor& circle, std::int32_t x, std::int32_t y) const {
  return std::hypot(x_of(x) - circle.x_m, y_of(y) - circle.y_m) <= circle.radius_m;
}

double PlanningGrid::metres(std::int16_t gap) const {
  return 0.5 * std::sqrt(static_cast<double>(gap)) * lattice_.pitch_m;
}

}  // namespace floornav
