#include "tools/pictures/frame_picture.hpp"

#include <algorithm>
#include <cmath>

#include "tools/pictures/cell_color.hpp"
#include "tools/pictures/color.hpp"
#include "tools/pictures/top_view.hpp"

namespace floornav {

namespace {

constexpr double kImageLeft_px = 20;
constexpr double kImageWidth_px = 560;
constexpr Color kInk = color(0x26292E);
constexpr Color kFreeTint = color(0x2FA84F);
constexpr Color kBlockedTint = color(0xD8432B);

void draw_key(Canvas& canvas, Eigen::Vector2d at) {
  const auto entry = [&](Color swatch, const std::string& words, double width_px) {
    canvas.rectangle(at, {16, 16}, swatch);
    canvas.text(at + Eigen::Vector2d(23, 13), words, 12.5, kInk);
    at.x() += width_px;
  };
  entry(mix(color(0x808080), kFreeTint, 0.6), "free", 80);
  entry(mix(color(0x808080), kBlockedTint, 0.6), "blocked", 100);
  entry(color(0x808080), "not judged", 120);
  entry(color(0x000000), "not measured", 120);
}

}  // namespace

std::uint32_t pixel_color(double depth_m, VertexState state) {
  constexpr double kFade_m = 3;
  if (depth_m <= 0) return packed(color(0x000000));
  const double light = 0.2 + 0.75 * std::exp(-depth_m / kFade_m);
  const Color grey{light, light, light};
  if (state == VertexState::kUnknown) return packed(grey);
  return packed(mix(grey, state == VertexState::kFree ? kFreeTint : kBlockedTint, 0.6));
}

void write_frame_png(const FramePicture& picture, const std::filesystem::path& file) {
  const CellRectangle& cells = picture.map.cells;
  Eigen::AlignedBox2d shown(Eigen::Vector2d(cells.x_min_m(), cells.y_min_m()),
                            Eigen::Vector2d(cells.x_max_m(), cells.y_max_m()));
  shown.extend(picture.robot.place_m);
  constexpr double kMargin_m = 0.3;
  TopView view({.shown_m = {shown.min().array() - kMargin_m, shown.max().array() + kMargin_m},
                .resolution_m = cells.resolution_m,
                .longest_px = 560,
                .key_width_px = 20,
                .left_room_px = kImageWidth_px + kImageLeft_px,
                .title = picture.title,
                .subtitle = picture.subtitle});
  paint_cells(view, picture.map);
  view.frame();
  draw_robot(view, picture.robot);
  const Eigen::Vector2d corner(kImageLeft_px, view.plot_corner().y());
  const Eigen::Vector2d size(kImageWidth_px, kImageWidth_px * picture.image_height / picture.image_width);
  view.canvas().image(picture.pixels, picture.image_width, picture.image_height, corner, size);
  draw_key(view.canvas(), corner + Eigen::Vector2d(0, size.y() + 12));
  view.canvas().write_png(file);
}

}  // namespace floornav
