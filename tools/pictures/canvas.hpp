#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "tools/pictures/color.hpp"

struct _cairo;
struct _cairo_surface;

namespace floornav {

/// Where a text's anchor is.
enum class Align { kLeft, kCenter, kRight };

/// How a line looks.
struct Stroke {
  Color color;
  double width_px = 1;
  double alpha = 1;
  double dash_px = 0;  ///< 0: solid
};

/// A picture in pixels, y down, drawn with cairo and written as PNG.
class Canvas {
 public:
  Canvas(int width_px, int height_px, Color background);

  void line(std::span<const Eigen::Vector2d> points, const Stroke& stroke);
  void polygon(std::span<const Eigen::Vector2d> points, Color fill, double alpha = 1);
  void rectangle(Eigen::Vector2d corner, Eigen::Vector2d size, Color fill);
  void outline(Eigen::Vector2d corner, Eigen::Vector2d size, const Stroke& stroke);
  void circle(Eigen::Vector2d center, double radius_px, const Stroke& stroke);
  void disc(Eigen::Vector2d center, double radius_px, Color fill, double alpha = 1);
  void text(Eigen::Vector2d at, const std::string& words, double size_px, Color color,
            Align align = Align::kLeft, bool bold = false);
  /// Paints packed pixels, row 0 on top, stretched over the rectangle; enlarged pixels keep their edges.
  void image(std::vector<std::uint32_t> pixels, int columns, int rows, Eigen::Vector2d corner,
             Eigen::Vector2d size);
  /// What follows is drawn only inside the rectangle, until unclip().
  void clip(Eigen::Vector2d corner, Eigen::Vector2d size);
  void unclip();

  /// Throws std::runtime_error where the file cannot be written.
  void write_png(const std::filesystem::path& file) const;

 private:
  void trace(std::span<const Eigen::Vector2d> points);
  void stroke_path(const Stroke& stroke);

  struct Free {
    void operator()(_cairo* cairo) const;
    void operator()(_cairo_surface* surface) const;
  };
  std::unique_ptr<_cairo_surface, Free> surface_;
  std::unique_ptr<_cairo, Free> cairo_;
};

}  // namespace floornav
