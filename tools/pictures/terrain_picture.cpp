#include "tools/pictures/terrain_picture.hpp"

#include <algorithm>
#include <cmath>

#include "tools/pictures/top_view.hpp"

namespace floornav {

namespace {

constexpr Color kInk = color(0x26292E);
constexpr Color kUnknown = color(0xE3E6EA);
constexpr double kTrajectoryGap_m = 2.0;

/// The heights that the colours span: all but the outermost half per cent, on round numbers.
struct HeightRange {
  double low_m = 0;
  double high_m = 1;
  double step_m = 0.1;  ///< between the bar's labels
  [[nodiscard]] double fraction(double z_m) const { return (z_m - low_m) / (high_m - low_m); }
};

HeightRange range_of(const std::vector<float>& height_m) {
  constexpr double kLeastSpan_m = 0.05;
  std::vector<float> seen;
  std::ranges::copy_if(height_m, std::back_inserter(seen), [](float z) { return std::isfinite(z); });
  if (seen.empty()) return {};
  std::ranges::sort(seen);
  const std::size_t tail = seen.size() / 200;
  const double low_m = seen[tail];
  const double high_m = seen[seen.size() - 1 - tail];
  const double step_m = round_step(std::max(high_m - low_m, kLeastSpan_m) / 7);
  HeightRange range{std::floor(low_m / step_m) * step_m, std::ceil(high_m / step_m) * step_m, step_m};
  if (range.high_m - range.low_m < step_m) range.high_m = range.low_m + step_m;
  return range;
}

/// Light on a cell from the upper left, by the slope towards its neighbours; 1 on level ground.
double light_on(const HeightRaster& terrain, int column, int row) {
  constexpr double kRelief = 0.9;
  const auto height_at = [&](int c, int r) {
    c = std::clamp(c, 0, terrain.cells.width - 1);
    r = std::clamp(r, 0, terrain.cells.height - 1);
    return terrain.height_m[static_cast<std::size_t>(r) * static_cast<std::size_t>(terrain.cells.width) +
                            static_cast<std::size_t>(c)];
  };
  const double span_m = 2 * terrain.cells.resolution_m;
  const double rise_x = (height_at(column + 1, row) - height_at(column - 1, row)) / span_m;
  const double rise_y = (height_at(column, row + 1) - height_at(column, row - 1)) / span_m;
  const double towards_light = (rise_x - rise_y) / std::numbers::sqrt2;
  return std::isfinite(towards_light) ? 1 + 0.25 * std::tanh(kRelief * towards_light) : 1.0;
}

void paint_terrain(TopView& view, const HeightRaster& terrain, const HeightRange& range) {
  view.canvas().rectangle(view.plot_corner(), view.plot_size(), kUnknown);
  std::vector<std::uint32_t> colors(terrain.cells.size(), packed(kUnknown));
  std::size_t i = 0;
  for (int row = 0; row < terrain.cells.height; ++row)
    for (int column = 0; column < terrain.cells.width; ++column, ++i)
      if (std::isfinite(terrain.height_m[i]))
        colors[i] = packed(
            shade(perceptual_color(range.fraction(terrain.height_m[i])), light_on(terrain, column, row)));
  view.paint(terrain.cells, colors);
}

void draw_color_bar(TopView& view, const HeightRange& range) {
  constexpr double kWidth_px = 22;
  const double height_px = std::clamp(view.plot_size().y(), 240.0, 420.0) - 40;
  const Eigen::Vector2d top = view.key_corner() + Eigen::Vector2d(0, 26);
  Canvas& canvas = view.canvas();
  canvas.text(view.key_corner() + Eigen::Vector2d(0, 10), "height, m", 12.5, kInk);
  for (int px = 0; px < static_cast<int>(height_px); ++px)
    canvas.rectangle(top + Eigen::Vector2d(0, px), {kWidth_px, 1}, perceptual_color(1 - px / height_px));
  for (double z = range.low_m; z <= range.high_m + range.step_m / 2; z += range.step_m) {
    const double py = top.y() + (1 - range.fraction(z)) * height_px;
    canvas.rectangle({top.x() + kWidth_px, py - 0.5}, {5, 1}, kInk);
    canvas.text({top.x() + kWidth_px + 9, py + 4}, label(z, range.step_m), 12, kInk);
  }
  canvas.outline(top + Eigen::Vector2d(-0.5, -0.5), {kWidth_px + 1, height_px + 1}, {kInk, 1});
  const Eigen::Vector2d below = top + Eigen::Vector2d(0, height_px + 18);
  canvas.rectangle(below, {kWidth_px, 16}, kUnknown);
  canvas.text(below + Eigen::Vector2d(kWidth_px + 9, 13), "never seen", 12, kInk);
}

Eigen::AlignedBox2d shown_part(const TerrainPicture& picture) {
  const CellRectangle& cells = picture.terrain.cells;
  Eigen::AlignedBox2d box(Eigen::Vector2d(cells.x_min_m(), cells.y_min_m()),
                          Eigen::Vector2d(cells.x_max_m(), cells.y_max_m()));
  for (const auto& place : picture.trajectory) box.extend(place);
  const double margin_m = 0.3 + 0.02 * box.sizes().maxCoeff();
  return {box.min().array() - margin_m, box.max().array() + margin_m};
}

}  // namespace

void write_terrain_png(const TerrainPicture& picture, const std::filesystem::path& file) {
  TopView view({.shown_m = shown_part(picture),
                .resolution_m = picture.terrain.cells.resolution_m,
                .longest_px = picture.longest_px,
                .key_width_px = 140,
                .title = picture.title,
                .subtitle = picture.subtitle});
  const HeightRange range = range_of(picture.terrain.height_m);
  paint_terrain(view, picture.terrain, range);
  view.frame();
  view.line(picture.trajectory, {color(0xFFFFFF), 3, 0.6}, kTrajectoryGap_m);
  view.line(picture.trajectory, {kInk, 1.4, 0.9}, kTrajectoryGap_m);
  draw_color_bar(view, range);
  view.canvas().write_png(file);
}

}  // namespace floornav
