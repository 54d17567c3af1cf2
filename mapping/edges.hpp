#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "mapping/map_tile.hpp"

namespace floornav {

/// Eq. (2): when a robot can go from a vertex to the next one.
struct StepRule {
  float max_step_m = 0.02F;    ///< T
  float resolution_m = 0.05F;  ///< side of a vertex

  /// Whether the step between a vertex and its neighbour k is at most T. The step is the difference of the
  /// two planes' heights half-way between them: on level ground the difference of their heights, as in eq.
  /// (2); on a ramp the slope, which has a limit of its own, is not taken for a step, however coarse the map
  /// is.
  [[nodiscard]] bool open(const Surface& from, const Surface& to, std::size_t k) const {
    return climbs(std::abs(rise_m(from, to, k)), from, to);
  }
  /// The same for a step of that height between the two: one that is clearly there must be lower than T by
  /// what both heights are uncertain.
  [[nodiscard]] bool climbs(float step_m, const Surface& from, const Surface& to) const {
    constexpr float kClearly_sigmas = 2.0F;
    const float sigma_m = std::sqrt(from.var_m2 + to.var_m2);
    return step_m <= max_step_m && (step_m + sigma_m <= max_step_m || step_m <= kClearly_sigmas * sigma_m);
  }
  /// How far up that step goes.
  [[nodiscard]] float rise_m(const Surface& from, const Surface& to, std::size_t k) const;
};

/// Whether a vertex is the upper side of a step of more than T, or of a drop. The highest surface in a vertex
/// decides, so that the edge itself goes through the upper one or the one before it: no wheel may stand
/// there.
bool is_rim(const VertexRef& place, const StepRule& rule);

/// Works out MapTile::steps_open of a tile: where both vertices are drivable and eq. (2) lets the robot pass.
void open_steps(MapTile& tile, const StepRule& rule);

/// GridTile::edges of a vertex: open where both vertices are free and eq. (2) lets the robot pass. A diagonal
/// is open only where both ways around its corner are open too, so that no wheel cuts over a step or past an
/// obstacle's corner. The edges to tiles that rest, or whose MapTile::judged is not `version`, stay as they
/// were `published`.
std::uint8_t open_edges(const VertexRef& from, std::int64_t version, std::uint8_t published);

}  // namespace floornav
