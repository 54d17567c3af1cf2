#pragma once

#include "mapping/grid_map.hpp"
#include "tools/simulator/drivable.hpp"

namespace floornav {

/// The grid-map that a mapper would make which has seen everything and errs in nothing: free is what can be
/// driven, all else is blocked; an edge is open between two free vertices, a diagonal one where the sides
/// beside it are free too.
GridMap true_map(const TruthGrid& truth);

}  // namespace floornav
