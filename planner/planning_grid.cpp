#include "planner/planning_grid.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace floornav {
namespace {

constexpr std::int64_t kNeverTaken = -2;
constexpr std::int64_t kNoTile = -1;
constexpr std::int64_t kMaxCells = 1 << 25;  ///< of some 17 bytes each

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

void PlanningGrid::update(const GridMap& map, const CellRect& needed, const AssumedFloor& assumed) {
  const bool same_map =
      map.lattice().pitch_m == lattice_.pitch_m && map.epoch == epoch_ && map.version >= version_;
  if (!same_map || !(assumed == assumed_) || window_.empty() || !window_.contains(needed))
    start_afresh(map, needed, assumed);
  version_ = map.version;
  const CellRect changed = take_changed_tiles(map);
  if (changed.empty()) return;
  blocked_gap_.update(floor_, static_cast<std::uint8_t>(Floor::kBlocked), changed);
  open_gap_.update(floor_, static_cast<std::uint8_t>(Floor::kUnknown), changed);
  const CellRect grid{0, 0, search_.width, search_.height};
  const CellRect within_reach = changed.grown(blocked_gap_.reach()).clipped(grid);
  weigh(within_reach);
  open_edges(within_reach.grown(1).clipped(grid));
}

void PlanningGrid::start_afresh(const GridMap& map, const CellRect& needed, const AssumedFloor& assumed) {
  forget();  // until all below has succeeded
  lattice_ = map.lattice();
  epoch_ = map.epoch;
  assumed_ = assumed;
  const double radius_in_cells = robot_.radius_m / lattice_.pitch_m;
  const auto least_reach = static_cast<std::int32_t>(std::ceil(radius_in_cells)) + 2;
  if (least_reach > GapField::kMaxReach)
    throw std::invalid_argument("the robot's radius is more than " + std::to_string(GapField::kMaxReach - 2) +
                                " cells of the map");
  const auto comfort = static_cast<std::int32_t>(std::ceil(settings_.comfort_m / lattice_.pitch_m));
  const std::int32_t reach = std::min(least_reach + comfort, GapField::kMaxReach);
  least_gap_ = least_gap_of(radius_in_cells);

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
  search_.steps = kWeightedSteps;
  search_.whole_squares = true;
  const auto cells = static_cast<std::size_t>(search_.width) * static_cast<std::size_t>(search_.height);
  floor_.assign(cells, static_cast<std::uint8_t>(Floor::kUnknown));
  map_edges_.assign(cells, 0xFF);
  terrain_.assign(cells, 0);
  search_.weights.assign(cells, 0);
  search_.edges.assign(cells, 0);
  blocked_gap_.reset(search_.width, search_.height, reach);
  open_gap_.reset(search_.width, search_.height, reach);
  const double comfort_m = std::max(settings_.comfort_m, 1e-6);
  gap_weights_.resize(static_cast<std::size_t>(blocked_gap_.cap()) + 1);
  for (std::size_t gap = 0; gap < gap_weights_.size(); ++gap) {
    const double spare_m = metres(static_cast<std::int16_t>(gap)) - robot_.radius_m;
    gap_weights_[gap] = weight_of(settings_.clearance_cost * std::clamp(1.0 - spare_m / comfort_m, 0.0, 1.0));
  }
  tile_versions_.assign(cells / static_cast<std::size_t>(GridTile::kVertices), kNeverTaken);
  window_ = window;
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
        floor_[to] = static_cast<std::uint8_t>(assumed_at(x, y) ? Floor::kAssumed : Floor::kUnknown);
        map_edges_[to] = 0xFF;
        terrain_[to] = 0;
        continue;
      }
      floor_[to] = static_cast<std::uint8_t>(state == VertexState::kFree ? Floor::kFree : Floor::kBlocked);
      map_edges_[to] = tile->edges[from];
      const double slope_deg = static_cast<double>(GridTile::kSlopeUnit_deg) * tile->slope[from];
      const double steepness =
          robot_.max_slope_deg > 0 ? std::min(slope_deg / robot_.max_slope_deg, 1.0) : 1.0;
      terrain_[to] = weight_of(settings_.belief_cost * (1.0 - tile->belief[from] / 255.0) +
                               settings_.slope_cost * steepness);
    }
  }
}

void PlanningGrid::weigh(const CellRect& rect) {
  const std::uint8_t unknown = weight_of(settings_.unknown_cost);
  for (std::int32_t y = rect.y0; y < rect.y1; ++y) {
    for (std::int32_t x = rect.x0; x < rect.x1; ++x) {
      const std::size_t i = search_.index({x, y});
      const unsigned unseen = open_gap_[i] < least_gap_ ? unknown : 0U;
      const unsigned near_obstacle = gap_weights_[static_cast<std::size_t>(blocked_gap_[i])];
      search_.weights[i] = static_cast<std::uint8_t>(std::min(255U, terrain_[i] + unseen + near_obstacle));
    }
  }
}

void PlanningGrid::open_edges(const CellRect& rect) {
  for (std::int32_t y = rect.y0; y < rect.y1; ++y)
    for (std::int32_t x = rect.x0; x < rect.x1; ++x) search_.edges[search_.index({x, y})] = edges_at(x, y);
}

/// Both cells have room for the robot, and the map does not close the edge between them. It knows edges only
/// between cells that were seen.
bool PlanningGrid::link_open(std::size_t from, std::size_t to, std::size_t k) const {
  if (blocked_gap_[from] < least_gap_ || blocked_gap_[to] < least_gap_) return false;
  if (floor_[from] != static_cast<std::uint8_t>(Floor::kFree) ||
      floor_[to] != static_cast<std::uint8_t>(Floor::kFree))
    return true;
  return (map_edges_[from] >> k & 1) != 0 && (map_edges_[to] >> ((k + 4) % 8) & 1) != 0;
}

/// Steps out of a cell. A diagonal one is open where all four edges of the square that it crosses are: it
/// cuts no corner, neither of an obstacle nor of a step.
std::uint8_t PlanningGrid::edges_at(std::int32_t x, std::int32_t y) const {
  const std::size_t here = search_.index({x, y});
  if (blocked_gap_[here] < least_gap_) return 0;
  const auto neighbour = [&](std::size_t k) { return GridCell{x + kStepX[k], y + kStepY[k]}; };
  unsigned mask = 0;
  for (std::size_t k = 0; k < 8; k += 2) {
    const GridCell to = neighbour(k);
    if (search_.contains(to) && link_open(here, search_.index(to), k)) mask |= 1U << k;
  }
  for (std::size_t k = 1; k < 8; k += 2) {
    const std::size_t a = k - 1, b = (k + 1) % 8;
    if ((mask >> a & 1) == 0 || (mask >> b & 1) == 0) continue;
    const std::size_t to = search_.index(neighbour(k));
    if (link_open(here, to, k) && link_open(search_.index(neighbour(a)), to, b) &&
        link_open(search_.index(neighbour(b)), to, a))
      mask |= 1U << k;
  }
  return static_cast<std::uint8_t>(mask);
}

GridCell PlanningGrid::cell_of(double x_m, double y_m) const {
  const CellIndex cell = lattice_.cell_of(x_m, y_m);
  return {cell.ix - window_.x0, cell.iy - window_.y0};
}

bool PlanningGrid::assumed_at(std::int32_t x, std::int32_t y) const {
  return std::hypot(x_of(x) - assumed_.x_m, y_of(y) - assumed_.y_m) <= assumed_.radius_m;
}

double PlanningGrid::metres(std::int16_t gap) const {
  return 0.5 * std::sqrt(static_cast<double>(gap)) * lattice_.pitch_m;
}

}  // namespace floornav
