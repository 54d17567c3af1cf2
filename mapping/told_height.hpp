#pragma once

#include "mapping/map_tile.hpp"

namespace floornav {

/// What is told of a vertex on which the robot cannot drive: the height of the highest place that was seen
/// there (section 4.6). What lies around tells it too, within noise: where that is much better known than
/// what only a few views have shown, and not half of `step_m` off; and where all is known so well that noise
/// could not hide 5 mm, by the mean of two on opposite sides, so that a slope is kept. Of a side whose upper
/// edge rises, as its neighbours tell, it is the upper end of the part that was seen.
Surface highest_place(const VertexRef& place, float resolution_m, float step_m);

}  // namespace floornav
