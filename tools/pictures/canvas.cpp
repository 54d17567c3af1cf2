#include "tools/pictures/canvas.hpp"

#include <numbers>
#include <stdexcept>

#include <cairo.h>
#include <fmt/format.h>

namespace floornav {

namespace {

void set_color(cairo_t* cairo, Color c, double alpha = 1) {
  cairo_set_source_rgba(cairo, c.red, c.green, c.blue, alpha);
}

}  // namespace

void Canvas::Free::operator()(_cairo* cairo) const {
  cairo_destroy(cairo);
}
void Canvas::Free::operator()(_cairo_surface* surface) const {
  cairo_surface_destroy(surface);
}

Canvas::Canvas(int width_px, int height_px, Color background)
    : surface_(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width_px, height_px)),
      cairo_(cairo_create(surface_.get())) {
  if (cairo_status(cairo_.get()) != CAIRO_STATUS_SUCCESS)
    throw std::runtime_error(fmt::format("a picture of {} x {} px: {}", width_px, height_px,
                                         cairo_status_to_string(cairo_status(cairo_.get()))));
  set_color(cairo_.get(), background);
  cairo_paint(cairo_.get());
  cairo_set_line_join(cairo_.get(), CAIRO_LINE_JOIN_ROUND);
}

void Canvas::trace(std::span<const Eigen::Vector2d> points) {
  for (const auto& p : points) cairo_line_to(cairo_.get(), p.x(), p.y());
}

void Canvas::stroke_path(const Stroke& stroke) {
  set_color(cairo_.get(), stroke.color, stroke.alpha);
  cairo_set_line_width(cairo_.get(), stroke.width_px);
  cairo_set_line_cap(cairo_.get(), stroke.dash_px > 0 ? CAIRO_LINE_CAP_BUTT : CAIRO_LINE_CAP_ROUND);
  cairo_set_dash(cairo_.get(), &stroke.dash_px, stroke.dash_px > 0 ? 1 : 0, 0);
  cairo_stroke(cairo_.get());
}

void Canvas::line(std::span<const Eigen::Vector2d> points, const Stroke& stroke) {
  trace(points);
  stroke_path(stroke);
}

void Canvas::polygon(std::span<const Eigen::Vector2d> points, Color fill, double alpha) {
  trace(points);
  cairo_close_path(cairo_.get());
  set_color(cairo_.get(), fill, alpha);
  cairo_fill(cairo_.get());
}

void Canvas::rectangle(Eigen::Vector2d corner, Eigen::Vector2d size, Color fill) {
  cairo_rectangle(cairo_.get(), corner.x(), corner.y(), size.x(), size.y());
  set_color(cairo_.get(), fill);
  cairo_fill(cairo_.get());
}

void Canvas::outline(Eigen::Vector2d corner, Eigen::Vector2d size, const Stroke& stroke) {
  cairo_rectangle(cairo_.get(), corner.x(), corner.y(), size.x(), size.y());
  stroke_path(stroke);
}

void Canvas::circle(Eigen::Vector2d center, double radius_px, const Stroke& stroke) {
  cairo_new_path(cairo_.get());
  cairo_arc(cairo_.get(), center.x(), center.y(), radius_px, 0, 2 * std::numbers::pi);
  stroke_path(stroke);
}

void Canvas::disc(Eigen::Vector2d center, double radius_px, Color fill, double alpha) {
  cairo_new_path(cairo_.get());
  cairo_arc(cairo_.get(), center.x(), center.y(), radius_px, 0, 2 * std::numbers::pi);
  set_color(cairo_.get(), fill, alpha);
  cairo_fill(cairo_.get());
}

void Canvas::text(Eigen::Vector2d at, const std::string& words, double size_px, Color color, Align align,
                  bool bold) {
  cairo_select_font_face(cairo_.get(), "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                         bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cairo_.get(), size_px);
  cairo_text_extents_t extents;
  cairo_text_extents(cairo_.get(), words.c_str(), &extents);
  const double before = align == Align::kLeft ? 0 : align == Align::kCenter ? 0.5 : 1;
  set_color(cairo_.get(), color);
  cairo_move_to(cairo_.get(), at.x() - before * extents.x_advance, at.y());
  cairo_show_text(cairo_.get(), words.c_str());
  cairo_new_path(cairo_.get());
}

void Canvas::image(std::vector<std::uint32_t> pixels, int columns, int rows, Eigen::Vector2d corner,
                   Eigen::Vector2d size) {
  const std::unique_ptr<_cairo_surface, Free> picture(cairo_image_surface_create_for_data(
      reinterpret_cast<unsigned char*>(pixels.data()), CAIRO_FORMAT_RGB24, columns, rows, 4 * columns));
  cairo_save(cairo_.get());
  cairo_translate(cairo_.get(), corner.x(), corner.y());
  cairo_scale(cairo_.get(), size.x() / columns, size.y() / rows);
  cairo_set_source_surface(cairo_.get(), picture.get(), 0, 0);
  cairo_pattern_set_filter(cairo_get_source(cairo_.get()),
                           size.x() >= columns ? CAIRO_FILTER_NEAREST : CAIRO_FILTER_GOOD);
  cairo_paint(cairo_.get());
  cairo_restore(cairo_.get());
}

void Canvas::clip(Eigen::Vector2d corner, Eigen::Vector2d size) {
  cairo_save(cairo_.get());
  cairo_rectangle(cairo_.get(), corner.x(), corner.y(), size.x(), size.y());
  cairo_clip(cairo_.get());
}

void Canvas::unclip() {
  cairo_restore(cairo_.get());
}

void Canvas::write_png(const std::filesystem::path& file) const {
  const cairo_status_t status = cairo_surface_write_to_png(surface_.get(), file.c_str());
  if (status != CAIRO_STATUS_SUCCESS)
    throw std::runtime_error(fmt::format("{}: {}", file.string(), cairo_status_to_string(status)));
}

}  // namespace floornav
