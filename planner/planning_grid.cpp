#include "planner/planning_grid.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace floornav {
namespace {

constexpr std::int64_t kNeverTaken = -2;
constexpr std::int64_t kNoTile = -1;
constexpr std::int64_t kMaxCells = 1 << 25;  ///< of 16 bytes each, the searches' included

std::uint8_t weight_of(double cost) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(cost * SearchGrid::kWeightUnit, 0.0, 255.0)));
}

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

bool PlanningGrid::uniform() const {
  return settings_.unknown_cost == 0 && settings_.belief_cost == 0 && settings_.slope_cost == 0 &&
         settings_.clearance_cost == 0;
}

/// What that changed.
CellRect PlanningGrid::assume_floor_under(const AssumedFloor& robot) {
  const GridCell low = cell_of(robot.x_m - robot.radius_m, robot.y_m - robot.radius_m),
                 high = cell_of(robot.x_m + robot.radius_m, robot.y_m + robot.radius_m);
  const CellRect rect =
      CellRect{low.x, low.y, high.x + 1, high.y + 1}.clipped({0, 0, search_.width, search_.height});
  CellRect changed;
  for (std::int32_t y = rect.y0; y < rect.y1; ++y) {
    for (std::int32_t x = rect.x0; x < rect.x1; ++x) {
      if (floor({x, y}) != Floor::kUnknown || !within(robot, x, y)) continue;
      set_floor(search_.index({x, y}), kAssumed);
      changed = changed.joined({x, y, x + 1, y + 1});
    }
  }
  return changed;
}

void PlanningGrid::weigh_gaps() {
  const double comfort_m = std::max(settings_.comfort_m, 1e-6);
  gap_weights_.resize(static_cast<std::size_t>(blocked_gap_.cap()) + 1);
  for (std::size_t gap = 0; gap < gap_weights_.size(); ++gap) {
    const double spare_m = metres(static_cast<std::int16_t>(gap)) - robot_.radius_m;
    gap_weights_[gap] = weight_of(settings_.clearance_cost * std::clamp(1.0 - spare_m / comfort_m, 0.0, 1.0));
  }
}

/// Copies the tiles that are new, changed or gone; the rectangle that holds them.
CellRect PlanningGrid::take_changed_tiles(const GridMap& map) {
  CellRect changed;
  std::size_t slot = 0;
  for (std::int32_t y = 0; y < search_.height; y += GridTile::kSide) {
    for (std::int32_t x = 0; x < search_.width; x += GridTile::kSide, ++slot) {
      const GridTile* const tile = map.find(GridMap::tile_of({window_.x0 + x, window_.y0 + y}));
      const std::int64_t version = tile != nullptr ? tile->version : kNoTile;
      if (tile_versions_[slot] == version) continue;
      tile_versions_[slot] = version;
      take_tile(tile, x, y);
      changed = changed.joined({x, y, x + GridTile::kSide, y + GridTile::kSide});
    }
  }
  return changed;
}

void PlanningGrid::take_tile(const GridTile* tile, std::int32_t x0, std::int32_t y0) {
  std::size_t from = 0;
  for (std::int32_t y = y0; y < y0 + GridTile::kSide; ++y) {
    for (std::int32_t x = x0; x < x0 + GridTile::kSide; ++x, ++from) {
      const std::size_t to = search_.index({x, y});
      const VertexState state = tile != nullptr ? tile->state[from] : VertexState::kUnknown;
      if (state == VertexState::kUnknown) {
        set_floor(to, never_seen(x, y));
        map_edges_[to] = 0xFF;
        terrain_[to] = 0;
        continue;
      }
      set_floor(to, state == VertexState::kFree ? std::uint8_t{0} : kBlocked);
      map_edges_[to] = tile->edges[from];
      const double slope_deg = static_cast<double>(GridTile::kSlopeUnit_deg) * tile->slope[from];
      const double steepness =
          robot_.max_slope_deg > 0 ? std::min(slope_deg / robot_.max_slope_deg, 1.0) : 1.0;
      terrain_[to] = weight_of(settings_.belief_cost * (1.0 - tile->belief[from] / 255.0) +
                               settings_.slope_cost * steepness);
    }
  }
}

/// Marks free cells that a closed edge parts from another free one. Edges to what is not free are closed too,
/// but need no mark of their own.
void PlanningGrid::find_steps(const CellRect& rect) {
  for (std::int32_t y = rect.y0; y < rect.y1; ++y) {
    for (std::int32_t x = rect.x0; x < rect.x1; ++x) {
      const std::size_t i = search_.index({x, y});
      bool at_step = false;
      for (std::size_t k = 0; k < 8 && floor({x, y}) == Floor::kFree; k += 2) {
        const GridCell to{x + kStepX[k], y + kStepY[k]};
        at_step = at_step || (search_.contains(to) && !map_edge_open(i, search_.index(to), k));
      }
      kinds_[i] = static_cast<std::uint8_t>(at_step ? kinds_[i] | kAtStep : kinds_[i] & ~kAtStep);
    }
  }
}

/// Marks the cells within the least gap of those of a kind, after a change.
void PlanningGrid::find_near(std::uint8_t what, std::uint8_t mark, std::int16_t least_gap, GapScan& scan,
                             const CellRect& changed) {
  const CellRect out = changed.grown(scan.reach()).clipped({0, 0, search_.width, search_.height});
  scan.scan(cells_of(what), out, [&](std::int32_t y, const std::int16_t* gaps) {
    std::uint8_t* const kinds = kinds_.data() + search_.index({out.x0, y});
    for (std::int32_t i = 0; i < out.width(); ++i)
      kinds[i] = static_cast<std::uint8_t>(gaps[i] < least_gap ? kinds[i] | mark : kinds[i] & ~mark);
  });
}

void PlanningGrid::weigh(const CellRect& rect) {
  const std::uint8_t unknown = weight_of(settings_.unknown_cost);
  for (std::int32_t y = rect.y0; y < rect.y1; ++y) {
    for (std::int32_t x = rect.x0; x < rect.x1; ++x) {
      const std::size_t i = search_.index({x, y});
      const bool fits = blocked_gap_[i] >= least_gap_ && (kinds_[i] & kNearStep) == 0;
      kinds_[i] = static_cast<std::uint8_t>(fits ? kinds_[i] | kFits : kinds_[i] & ~kFits);
      if (search_.weights.empty()) continue;
      const unsigned unseen = (kinds_[i] & kNearUnknown) != 0 ? unknown : 0U;
      const unsigned near_obstacle = gap_weights_[static_cast<std::size_t>(blocked_gap_[i])];
      search_.weights[i] = static_cast<std::uint8_t>(std::min(255U, terrain_[i] + unseen + near_obstacle));
    }
  }
}

void PlanningGrid::open_edges(const CellRect& rect) {
  for (std::int32_t y = rect.y0; y < rect.y1; ++y)
    for (std::int32_t x = rect.x0; x < rect.x1; ++x) search_.edges[search_.index({x, y})] = edges_at(x, y);
}

void PlanningGrid::project_open_cells(const CellRect& rect) {
  for (std::int32_t y = rect.y0; y < rect.y1; ++y) {
    for (std::int32_t x = rect.x0; x < rect.x1; ++x) {
      std::uint8_t& kind = kinds_[search_.index({x, y})];
      const bool parted = search_.edges[search_.index({x, y})] != 0 && !in_the_open(search_, {x, y});
      parted_cells_ += (parted ? 1 : 0) - ((kind & kParted) != 0 ? 1 : 0);
      kind = static_cast<std::uint8_t>(parted ? kind | kParted : kind & ~kParted);
    }
  }
  const auto is_open = [&](GridCell cell) {
    return search_.edges[search_.index(cell)] != 0 && (kinds_[search_.index(cell)] & kParted) == 0;
  };
  if (rect.contains({0, 0, search_.width, search_.height}))
    return open_cells_.build(search_.width, search_.height, is_open);
  for (std::int32_t y = rect.y0; y < rect.y1; ++y)
    for (std::int32_t x = rect.x0; x < rect.x1; ++x) open_cells_.set({x, y}, is_open({x, y}));
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

/// The map knows edges only between cells that were seen to be free.
bool PlanningGrid::map_edge_open(std::size_t from, std::size_t to, std::size_t k) const {
  constexpr unsigned kNotFree = kBlocked | kUnknown | kAssumed;
  if (((kinds_[from] | kinds_[to]) & kNotFree) != 0) return true;
  return (map_edges_[from] >> k & 1) != 0 && (map_edges_[to] >> ((k + 4) % 8) & 1) != 0;
}

bool PlanningGrid::map_edge_open(GridCell cell, std::size_t k) const {
  const GridCell to{cell.x + kStepX[k], cell.y + kStepY[k]};
  return search_.contains(cell) && search_.contains(to) &&
         map_edge_open(search_.index(cell), search_.index(to), k);
}

/// Steps out of a cell, to others that the robot fits in too. A diagonal one is open where all four edges of
/// the square that it crosses are: it cuts no corner, neither of an obstacle nor of a step.
std::uint8_t PlanningGrid::edges_at(std::int32_t x, std::int32_t y) const {
  if (!passable({x, y})) return 0;
  const auto link_open = [&](GridCell from, std::size_t k) {
    const GridCell to{from.x + kStepX[k], from.y + kStepY[k]};
    return search_.contains(to) && passable(from) && passable(to) &&
           map_edge_open(search_.index(from), search_.index(to), k);
  };
  const auto neighbour = [&](std::size_t k) { return GridCell{x + kStepX[k], y + kStepY[k]}; };
  unsigned mask = 0;
  for (std::size_t k = 0; k < 8; k += 2)
    if (link_open({x, y}, k)) mask |= 1U << k;
  for (std::size_t k = 1; k < 8; k += 2) {
    const std::size_t a = k - 1, b = (k + 1) % 8;
    if ((mask >> a & 1) == 0 || (mask >> b & 1) == 0) continue;
    if (link_open({x, y}, k) && link_open(neighbour(a), b) && link_open(neighbour(b), a)) mask |= 1U << k;
  }
  return static_cast<std::uint8_t>(mask);
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

/// What a cell that was never seen is taken for.
std::uint8_t PlanningGrid::never_seen(std::int32_t x, std::int32_t y) const {
  if (within(assumed_, x, y)) return kAssumed;
  const bool shut =
      std::any_of(shut_.begin(), shut_.end(), [&](const AssumedFloor& c) { return within(c, x, y); });
  return shut ? kBlocked : kUnknown;
}

bool PlanningGrid::within(const AssumedFloor& circle, std::int32_t x, std::int32_t y) const {
  return std::hypot(x_of(x) - circle.x_m, y_of(y) - circle.y_m) <= circle.radius_m;
}

double PlanningGrid::metres(std::int16_t gap) const {
  return 0.5 * std::sqrt(static_cast<double>(gap)) * lattice_.pitch_m;
}

}  // namespace floornav
