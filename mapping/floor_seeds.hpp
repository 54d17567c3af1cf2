#pragma once

#include <vector>

#include "mapping/map_tiles.hpp"
#include "runtime/geometry/lattice.hpp"
#include "runtime/geometry/pose.hpp"

namespace floornav {

/// The drivable vertices within 2.5 m of the robot that lie at most T above or below the plane it stands on:
/// there its floor begins. Where less than 0.05 m2 do (a camera that is mounted a little higher or lower than
/// told, a pose that drifts in z), the level within 10 cm of that plane that most vertices share, the lowest
/// of equals.
std::vector<VertexRef> floor_seeds(const Pose& T_world_body, const Lattice& vertices, float max_step_m,
                                   const MapTiles& tiles);

}  // namespace floornav
