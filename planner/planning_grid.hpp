#pragma once

#include <cstdint>
#include <vector>

#include "mapping/grid_map.hpp"
#include "planner/cell_rect.hpp"
#include "planner/gap_field.hpp"
#include "planner/search/line_of_sight.hpp"
#include "planner/search/search_grid.hpp"
#include "planner/settings.hpp"
#include "runtime/geometry/robot.hpp"

namespace floornav {

/// What the planner takes a cell for.
enum class Floor : std::uint8_t { kFree = 0, kAssumed = 1, kUnknown = 2, kBlocked = 3 };

/// A circle around the place where the robot started: what was never seen in it is taken for floor.
struct AssumedFloor {
  double x_m = 0;
  double y_m = 0;
  double radius_m = 0;
  friend bool operator==(const AssumedFloor&, const AssumedFloor&) = default;
};

/// The grid-map as the robot's centre may move on it: a window of the map with obstacles grown by the
/// footprint, steps that cross a closed edge shut, and a weight for what one would rather not drive on.
/// Follows one map: only tiles whose version changed, and what lies within reach of them, are worked out
/// again.
class PlanningGrid {
 public:
  PlanningGrid(const PlannerSettings& settings, const RobotSettings& robot)
      : settings_(settings), robot_(robot) {}

  /// Brings the grid up to date with `map`; afterwards it covers `needed` (cells of the map). Throws
  /// std::invalid_argument where the map's cells are too small for the robot's size.
  void update(const GridMap& map, const CellRect& needed, const AssumedFloor& assumed);
  /// The next update starts afresh: another map follows.
  void forget() { window_ = {}; }

  [[nodiscard]] const SearchGrid& search_grid() const { return search_; }
  [[nodiscard]] double pitch_m() const { return lattice_.pitch_m; }

  /// The cell that holds a point (m, local frame); it may lie off the grid.
  [[nodiscard]] GridCell cell_of(double x_m, double y_m) const;
  /// A point (m, local frame) in columns and rows of the grid, and back.
  [[nodiscard]] GridPoint point_of(double x_m, double y_m) const {
    return {x_m / lattice_.pitch_m - 0.5 - window_.x0, y_m / lattice_.pitch_m - 0.5 - window_.y0};
  }
  [[nodiscard]] double x_of(double column) const { return (column + 0.5 + window_.x0) * lattice_.pitch_m; }
  [[nodiscard]] double y_of(double row) const { return (row + 0.5 + window_.y0) * lattice_.pitch_m; }
  /// The map's cell that is the grid's (0, 0).
  [[nodiscard]] CellIndex origin() const { return {window_.x0, window_.y0}; }

  [[nodiscard]] Floor floor(GridCell cell) const { return static_cast<Floor>(floor_[search_.index(cell)]); }
  /// The robot's circle around the cell's centre touches nothing blocked.
  [[nodiscard]] bool passable(GridCell cell) const { return blocked_gap_[search_.index(cell)] >= least_gap_; }
  /// And nothing unknown.
  [[nodiscard]] bool known_free(GridCell cell) const { return open_gap_[search_.index(cell)] >= least_gap_; }
  /// From the cell's centre to the nearest blocked cell, or to the nearest one not known to be free; m, no
  /// more than the reach that the robot's size and comfort ask for.
  [[nodiscard]] double obstacle_clearance_m(GridCell cell) const {
    return metres(blocked_gap_[search_.index(cell)]);
  }
  [[nodiscard]] double clearance_m(GridCell cell) const { return metres(open_gap_[search_.index(cell)]); }

 private:
  void start_afresh(const GridMap& map, const CellRect& needed, const AssumedFloor& assumed);
  CellRect take_changed_tiles(const GridMap& map);
  void take_tile(const GridTile* tile, std::int32_t x0, std::int32_t y0);
  void weigh(const CellRect& rect);
  void open_edges(const CellRect& rect);
  [[nodiscard]] bool link_open(std::size_t from, std::size_t to, std::size_t k) const;
  [[nodiscard]] std::uint8_t edges_at(std::int32_t x, std::int32_t y) const;
  [[nodiscard]] bool assumed_at(std::int32_t x, std::int32_t y) const;
  [[nodiscard]] double metres(std::int16_t gap) const;

  PlannerSettings settings_;
  RobotSettings robot_;
  Lattice lattice_;
  AssumedFloor assumed_;
  std::int32_t epoch_ = 0;
  std::int64_t version_ = 0;
  CellRect window_;                        ///< cells of the map that the grid covers, whole tiles
  std::int16_t least_gap_ = 0;             ///< of a cell where the footprint fits
  std::vector<std::uint8_t> gap_weights_;  ///< weight of each squared gap to an obstacle
  std::vector<std::int64_t> tile_versions_;
  std::vector<std::uint8_t> floor_;
  std::vector<std::uint8_t> map_edges_;  ///< as the map has them
  std::vector<std::uint8_t> terrain_;    ///< weight of belief and slope
  GapField blocked_gap_;
  GapField open_gap_;
  SearchGrid search_;
};

}  // namespace floornav
