#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "perception/neighbor_tree.hpp"
#include "runtime/geometry/pinhole.hpp"

namespace floornav {

/// Points of an organised cloud: each lies on the ray of its pixel; ascending, no pixel twice.
struct ImagePoints {
  PointsView points;                    ///< sensor frame
  std::span<const std::int32_t> pixel;  ///< row * camera.width + column
  Pinhole camera;
  bool is_on_rays = false;  ///< known: need not be looked at
};

/// The part of the image that holds some points, as planes with an empty margin, and how far away what lies
/// outside a window of pixels must be.
class WindowImage {
 public:
  static constexpr int kMaxHalf_px = 10;  ///< half width of the largest square window
  static constexpr int kMargin_px = kMaxHalf_px;
  static constexpr int kMaxLanes = 16;      ///< a block of pixels may reach this far beyond the last column
  static constexpr float kNothing = 1e15F;  ///< coordinates of a pixel without point, m

  /// Takes the size of the image. False where the pixels do not ascend.
  bool lay_out(const ImagePoints& cloud);
  /// Fills some rows; rows are independent work. False where a point is not on its pixel's ray.
  bool fill_rows(const ImagePoints& cloud, int first_row, int end_row);

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] std::ptrdiff_t stride() const { return stride_; }
  /// Place of a pixel in the planes; row and column may reach into the margin.
  [[nodiscard]] std::ptrdiff_t at(int row, int column) const {
    return (row + kMargin_px) * stride_ + column + kMargin_px;
  }
  [[nodiscard]] int column_of(std::int32_t pixel, int row) const {
    return pixel - (row + first_row_) * image_width_ - first_column_;
  }
  /// Places in a plane.
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] const float* x() const { return x_.data(); }
  [[nodiscard]] const float* y() const { return y_.data(); }
  [[nodiscard]] const float* z() const { return z_.data(); }
  /// The points of a row are [row_begin(row), row_begin(row + 1)).
  [[nodiscard]] std::int32_t row_begin(int row) const { return row_begin_[static_cast<std::size_t>(row)]; }

  /// Points of other columns than those at most `half` away are farther than this times the depth; for
  /// kMaxLanes columns beyond the last one too.
  [[nodiscard]] const float* column_bound(int half) const {
    return column_bound_[static_cast<std::size_t>(half)].data();
  }
  [[nodiscard]] float row_bound(int half, int row) const {
    return row_bound_[static_cast<std::size_t>(half)][static_cast<std::size_t>(row)];
  }
  /// Half widths of the window outside of which nothing is within `radius_m` of the point at a pixel; at most
  /// the image's sides.
  [[nodiscard]] int columns_within(float radius_m, int column, float z_m) const;
  [[nodiscard]] int rows_within(float radius_m, int row, float z_m) const;

 private:
  using Bounds = std::array<std::vector<float>, kMaxHalf_px + 1>;

  void find_rows(std::span<const std::int32_t> pixel);

  int image_width_ = 0;
  int first_column_ = 0, first_row_ = 0;  ///< of the part
  int width_ = 0, height_ = 0;
  std::ptrdiff_t stride_ = 0;
  std::size_t size_ = 0;
  float fx_ = 1.0F, fy_ = 1.0F;
  std::vector<float> x_, y_, z_;  ///< never shrink
  std::vector<std::int32_t> row_begin_;
  std::vector<float> column_tangent_, row_tangent_;  ///< of the pixels' rays
  Bounds column_bound_, row_bound_;
};

}  // namespace floornav
