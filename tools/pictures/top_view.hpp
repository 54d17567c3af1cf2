#pragma once

#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "tools/pictures/canvas.hpp"
#include "tools/pictures/raster.hpp"

namespace floornav {

/// What a view from above shows and how large.
struct TopViewLayout {
  Eigen::AlignedBox2d shown_m;  ///< part of the local frame
  double resolution_m = 0.05;   ///< of the cells, so that each becomes a whole number of pixels where it can
  double longest_px = 1000;     ///< longer side of the plot
  double key_width_px = 230;    ///< room at the right
  double left_room_px = 0;      ///< more room at the left
  std::string title;
  std::string subtitle;
};

/// The floor seen from above, x to the right and y up, with a frame in metres around it.
class TopView {
 public:
  explicit TopView(const TopViewLayout& layout);

  /// Pixel of a place in the local frame.
  [[nodiscard]] Eigen::Vector2d at(double x_m, double y_m) const;
  [[nodiscard]] Eigen::Vector2d at(const Eigen::Vector2d& p) const { return at(p.x(), p.y()); }
  [[nodiscard]] double pixels_per_m() const { return pixels_per_m_; }

  /// Paints one packed colour a cell, row 0 at the lowest y.
  void paint(const CellRectangle& cells, std::span<const std::uint32_t> colors);
  /// A line through places of the local frame; it breaks where two are farther apart than `gap_m`.
  void line(std::span<const Eigen::Vector2d> places_m, const Stroke& stroke, double gap_m);
  /// Grid, ticks, labels and scale bar: after the cells, before what is drawn on them.
  void frame();

  [[nodiscard]] Canvas& canvas() { return canvas_; }
  [[nodiscard]] Eigen::Vector2d plot_corner() const { return corner_; }
  [[nodiscard]] Eigen::Vector2d plot_size() const { return size_; }
  /// Top left of the room at the right.
  [[nodiscard]] Eigen::Vector2d key_corner() const { return {corner_.x() + size_.x() + 24, corner_.y()}; }

 private:
  void ticks_along_x(double step_m);
  void ticks_along_y(double step_m);
  void scale_bar();

  Eigen::AlignedBox2d shown_m_;
  double pixels_per_m_;
  Eigen::Vector2d corner_;
  Eigen::Vector2d size_;
  Canvas canvas_;
};

/// The next 1, 2 or 5 times a power of ten that is not below `least`.
double round_step(double least);

/// A number with as many decimals as a step needs: 0.5 -> "1.5", 2 -> "4".
std::string label(double value, double step);

}  // namespace floornav
