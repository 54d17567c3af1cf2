#pragma once

#include "mapping/map_tile.hpp"

namespace floornav {

/// What is told of a vertex on which the robot cannot drive: the height of the highest place that was seen
/// there (section 4.6). Of what only a few views have shown the height is uncertain; what lies around, is
/// known much better and as high as that, within noise and half of `step_m`, tells it too.
Surface highest_place(const VertexRef& place, float resolution_m, float step_m);

}  // namespace floornav
