#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "mapping/grid_map.hpp"
#include "planner/cell_rect.hpp"
#include "planner/gap_field.hpp"
#include "planner/robot_outline.hpp"
#include "planner/search/bit_grid.hpp"
#include "planner/search/block_weights.hpp"
#include "planner/search/grid_aids.hpp"
#include "planner/search/line_of_sight.hpp"
#include "planner/search/search_grid.hpp"
#include "planner/settings.hpp"
#include "runtime/geometry/robot.hpp"

namespace floornav {

/// What the planner takes a cell for.
enum class Floor : std::uint8_t { kFree, kAssumed, kUnknown, kBlocked };

/// What the robot must not touch.
enum class Avoid : std::uint8_t { kBlocked, kBlockedAndUnknown };

/// A circle, around the place where the robot started say: what was never seen in it is taken for floor, or
/// for none.
struct AssumedFloor {
  double x_m = 0;
  double y_m = 0;
  double radius_m = 0;
  friend bool operator==(const AssumedFloor&, const AssumedFloor&) = default;
};

/// The grid-map as the robot's centre may move on it: a window of the map with obstacles grown by the
/// footprint's inner circle (the whole footprint where that is a circle) and closed edges by the wheels'
/// track, a weight for what one would rather not drive on, and the same as bits for jump points. Follows one
/// map: only tiles whose version changed, and what lies within reach of them, are worked out again. Eight
/// bytes a cell.
class PlanningGrid {
 public:
  /// Throws as RobotOutline.
  PlanningGrid(const PlannerSettings& settings, const RobotSettings& robot)
      : settings_(settings), robot_(robot), outline_(robot, 1.0) {}

  /// Brings the grid up to date with `map`; afterwards it covers `needed` (cells of the map). There is floor
  /// under the robot itself too, where it stands. Throws std::invalid_argument where the map's cells are too
  /// small for the robot's size.
  void update(const GridMap& map, const CellRect& needed, const AssumedFloor& assumed,
              const AssumedFloor& stands = {});
  /// The next update starts afresh: another map follows.
  void forget() { window_ = {}; }
  /// From the next update on: what was never seen within any of these circles counts as blocked.
  void shut_unknown(std::vector<AssumedFloor> circles) {
    forget();
    shut_ = std::move(circles);
  }

  [[nodiscard]] const SearchGrid& search_grid() const { return search_; }
  /// The cells between which every step that the corner rule allows is open (in_the_open).
  [[nodiscard]] const BitGrid& open_cells() const { return open_cells_; }
  /// Whether those are all cells that have open steps.
  [[nodiscard]] bool no_cell_parted() const { return parted_cells_ == 0; }
  /// Of the search grid.
  [[nodiscard]] GridAids aids() const {
    return {no_cell_parted() ? &open_cells_ : nullptr, search_.weights.empty() ? nullptr : &blocks_};
  }
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

  [[nodiscard]] Floor floor(GridCell cell) const;
  /// The inner circle around the cell's centre touches nothing blocked, and the wheels no closed edge.
  [[nodiscard]] bool passable(GridCell cell) const { return (kinds_[search_.index(cell)] & kFits) != 0; }
  /// And the circle touches nothing unknown.
  [[nodiscard]] bool known_free(GridCell cell) const {
    return (kinds_[search_.index(cell)] & (kFits | kNearUnknown)) == kFits;
  }
  /// There is room for the footprint's outer circle on the cell and on steps from it: any heading fits.
  [[nodiscard]] bool roomy(GridCell cell) const { return blocked_gap_[search_.index(cell)] >= roomy_gap_; }
  /// In cells of this grid.
  [[nodiscard]] const RobotOutline& outline() const { return outline_; }
  /// No cell of a span, moved by `from`, is what is to be avoided; beyond the grid nothing is.
  [[nodiscard]] bool clear(const RowSpan& span, GridCell from, Avoid avoid) const;
  /// Whether the map leaves the step to neighbour k open, whatever the room there.
  [[nodiscard]] bool map_edge_open(GridCell cell, std::size_t k) const;
  /// From the cell's centre to the nearest blocked cell; m, no more than the reach that the robot's size and
  /// comfort ask for.
  [[nodiscard]] double obstacle_clearance_m(GridCell cell) const {
    return metres(blocked_gap_[search_.index(cell)]);
  }
  /// And to the nearest cell not known to be free; looked for at every call.
  [[nodiscard]] double clearance_m(GridCell cell) const;

 private:
  /// Bits of a cell's kind; a free cell has none of the first three.
  static constexpr std::uint8_t kBlocked = 1, kUnknown = 2, kAssumed = 4;
  static constexpr std::uint8_t kAtStep = 8;        ///< a closed edge parts it from another free cell
  static constexpr std::uint8_t kFits = 16;         ///< passable
  static constexpr std::uint8_t kNearUnknown = 32;  ///< the circle touches what is unknown
  static constexpr std::uint8_t kNearStep = 64;     ///< a wheel may stand on a closed edge

  static constexpr std::uint8_t kParted = 128;  ///< has open steps, but is none of the open cells

  /// That of a metre which costs so many metres more.
  [[nodiscard]] static std::uint8_t weight_of(double cost);
  void start_afresh(const GridMap& map, const CellRect& needed, const AssumedFloor& assumed);
  void weigh_gaps();
  /// Nothing costs more than its length.
  [[nodiscard]] bool uniform() const;
  CellRect take_changed_tiles(const GridMap& map);
  void take_tile(const GridTile* tile, std::int32_t x0, std::int32_t y0);
  CellRect assume_floor_under(const AssumedFloor& robot);
  void set_floor(std::size_t index, std::uint8_t floor) {
    constexpr unsigned kFloor = kBlocked | kUnknown | kAssumed;
    kinds_[index] = static_cast<std::uint8_t>((kinds_[index] & ~kFloor) | floor);
  }
  void find_steps(const CellRect& rect);
  void find_near(std::uint8_t what, std::uint8_t mark, std::int16_t least_gap, GapScan& scan,
                 const CellRect& changed);
  void weigh(const CellRect& rect);
  void open_edges(const CellRect& rect);
  void project_open_cells(const CellRect& rect);
  [[nodiscard]] ObstacleCells cells_of(std::uint8_t obstacles) const {
    return {kinds_.data(), search_.width, search_.height, obstacles};
  }
  [[nodiscard]] bool map_edge_open(std::size_t from, std::size_t to, std::size_t k) const;
  [[nodiscard]] std::uint8_t edges_at(std::int32_t x, std::int32_t y) const;
  [[nodiscard]] std::uint8_t never_seen(std::int32_t x, std::int32_t y) const;
  [[nodiscard]] bool within(const AssumedFloor& circle, std::int32_t x, std::int32_t y) const;
  [[nodiscard]] double metres(std::int16_t gap) const;

  PlannerSettings settings_;
  RobotSettings robot_;
  RobotOutline outline_;
  Lattice lattice_;
  AssumedFloor assumed_;
  std::vector<AssumedFloor> shut_;
  std::int32_t epoch_ = 0;
  std::int64_t version_ = 0;
  CellRect window_;                        ///< cells of the map that the grid covers, whole tiles
  std::int16_t least_gap_ = 0;             ///< to a blocked or unknown cell, where the inner circle fits
  std::int16_t roomy_gap_ = 0;             ///< where it fits whatever its heading
  std::int16_t least_step_gap_ = 0;        ///< to a cell at a step, where the wheels fit
  std::vector<std::uint8_t> gap_weights_;  ///< weight of each squared gap to an obstacle
  std::vector<std::int64_t> tile_versions_;
  std::vector<std::uint8_t> kinds_;
  std::vector<std::uint8_t> map_edges_;  ///< as the map has them
  std::vector<std::uint8_t> terrain_;    ///< weight of belief and slope
  GapField blocked_gap_;
  GapScan unknown_scan_;
  GapScan step_scan_;
  SearchGrid search_;
  BitGrid open_cells_;
  BlockWeights blocks_;
  std::int64_t parted_cells_ = 0;
};

}  // namespace floornav
