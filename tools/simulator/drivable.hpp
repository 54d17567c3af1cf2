#pragma once

#include <cstdint>
#include <vector>

#include "runtime/geometry/lattice.hpp"
#include "runtime/geometry/robot.hpp"
#include "tools/simulator/scene.hpp"

namespace floornav {

/// The truth about one cell.
struct TruthCell {
  float height_m = 0;   ///< mean z of its surface
  float highest_m = 0;  ///< highest z of all that begins below the robot's height
  bool standable =
      false;  ///< no step > T crosses it or its border, nowhere too steep, the robot's height free above
  bool drivable = false;  ///< standable, and reached from the start over steps <= T
  /// Drivable by its inside; a step > T that lies along its border, or less than half a sample beyond it,
  /// makes it not standable. Eq. (2) closes an edge there, not the cell.
  bool beside_step = false;
};

/// The truth on a grid of square cells. Cell (ix, iy) of `lattice` is cells[(iy - origin.iy) * width + ix -
/// origin.ix].
struct TruthGrid {
  Lattice lattice;
  CellIndex origin;
  std::int32_t width = 0;
  std::int32_t height = 0;
  std::vector<TruthCell> cells;

  /// The cell that holds a place, nullptr outside.
  [[nodiscard]] const TruthCell* at(const Eigen::Vector2d& place) const;
};

/// Samples the scene's area every centimetre or finer; steps are judged between neighbouring samples. Where
/// the robot starts decides what it can reach. The robot is a point here: grow what is not drivable by its
/// footprint.
TruthGrid truth_of(const Scene& scene, const RobotSettings& robot, double resolution_m,
                   const Eigen::Vector2d& start);

}  // namespace floornav
