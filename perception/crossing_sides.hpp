#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "perception/cell_points.hpp"
#include "perception/cell_window.hpp"
#include "perception/evidence.hpp"

namespace floornav {

/// Finds cells of level ground that the side of something cuts: a corner of a box stands in them, or of what
/// they lie on a corner is missing. Few points tell of so small a part, but the plane of a side, which many
/// points make, tells where it goes.
class CrossingSides {
 public:
  explicit CrossingSides(double least_height_m) : least_height_m_(static_cast<float>(least_height_m)) {}

  /// Begins a frame.
  void begin(std::int32_t cells) { sides_.assign(static_cast<std::size_t>(cells), {}); }
  /// Keeps which side a cell's points lie on. Calls for different cells may come at once.
  void note(std::int32_t cell, std::span<const CellPoint> points, std::span<const Surfel> surfels);
  /// Whether a side cuts a cell of which the plane lies at `z_m`: one on which points of this cell or one
  /// beside it lie, that reaches to the plane, and goes farther up or down from there than the least height.
  [[nodiscard]] bool cross(std::int32_t cell, float z_m, const CellWindow& window,
                           std::span<const Surfel> surfels) const;

 private:
  /// Of a cell's points, those on a side.
  struct Side {
    std::int16_t surfel = -1;  ///< index into FloorEvidence::surfels
    std::int32_t points = 0;
    float lowest_z_m = 0, highest_z_m = 0;
  };

  float least_height_m_;
  std::vector<Side> sides_;  ///< a cell: the side on which the most points in a row lie
};

}  // namespace floornav
