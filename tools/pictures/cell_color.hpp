#pragma once

#include "mapping/grid_map.hpp"
#include "tools/pictures/color.hpp"
#include "tools/pictures/raster.hpp"
#include "tools/pictures/top_view.hpp"

namespace floornav {

/// How a vertex looks. Of the blocked ones those of high belief are flat and low, but out of the robot's
/// reach.
Color cell_color(VertexState state, double belief);

/// Paints a map over the whole plot, unknown where it does not reach.
void paint_cells(TopView& view, const MapRaster& map);

}  // namespace floornav
