#include "tools/pictures/cell_color.hpp"

#include <vector>

namespace floornav {

namespace {

constexpr Color kUnknown = color(0xD3D7DD);
constexpr Color kFreeDoubtful = color(0xB9C98A);
constexpr Color kFreeSure = color(0xF4F9EC);
constexpr Color kObstacle = color(0x23262F);
constexpr Color kUnreachable = color(0xC4572E);

}  // namespace

Color cell_color(VertexState state, double belief) {
  switch (state) {
    case VertexState::kFree:
      return mix(kFreeDoubtful, kFreeSure, belief);
    case VertexState::kBlocked:
      return mix(kObstacle, kUnreachable, belief);
    case VertexState::kUnknown:
      break;
  }
  return kUnknown;
}

void paint_cells(TopView& view, const MapRaster& map) {
  view.canvas().rectangle(view.plot_corner(), view.plot_size(), kUnknown);
  std::vector<std::uint32_t> colors(map.cells.size());
  for (std::size_t i = 0; i < colors.size(); ++i)
    colors[i] = packed(cell_color(map.state[i], map.belief[i] / 255.0));
  view.paint(map.cells, colors);
}

}  // namespace floornav
