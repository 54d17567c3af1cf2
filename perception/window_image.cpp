#include "perception/window_image.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace floornav {

namespace {

/// Takes away what rounding may add to a bound.
constexpr float kCautious = 0.99F;
/// Distance from the pixel's ray, at depth 1, of a point that lies on it.
constexpr float kOnRay = 1e-6F;

/// Distance at depth 1 between a ray and the plane through the camera's centre that lies `step` further.
float distance_to_plane(float tangent, float step) {
  const float beyond = std::abs(tangent) + step;
  return step / std::sqrt(1.0F + beyond * beyond);
}

/// Distance at depth 1 that anything more than `half` lines away has at least; nothing lies outside the
/// image.
void fill_bounds(const std::vector<float>& tangents, float focal_px, int half, int beyond,
                 std::vector<float>& bounds) {
  constexpr float kNothingThere = 1e6F;
  const int count = static_cast<int>(tangents.size());
  bounds.assign(static_cast<std::size_t>(count + beyond), kNothingThere);
  const float step = static_cast<float>(half + 1) / focal_px;
  for (int i = 0; i < count; ++i) {
    const auto place = static_cast<std::size_t>(i);
    if (i - half > 0 || i + half < count - 1)
      bounds[place] = kCautious * distance_to_plane(tangents[place], step);
  }
}

/// Inverts distance_to_plane: lines that lie within `distance` at depth 1, at most `most`.
int lines_within(float distance, float tangent, float focal_px, int most) {
  const float q = distance / kCautious;
  if (!(q < 0.9F)) return most;
  const float t = std::abs(tangent);
  const float step = (q * q * t + q * std::sqrt(1.0F + t * t - q * q)) / (1.0F - q * q);
  const float lines = std::ceil(step * focal_px);
  return lines < static_cast<float>(most) ? static_cast<int>(lines) : most;
}

/// Looks at all, which vectors do faster than stopping at the first that does not.
bool is_rising(std::span<const std::int32_t> values) {
  int falls = 0;
  for (std::size_t i = 1; i < values.size(); ++i) falls += values[i] <= values[i - 1] ? 1 : 0;
  return falls == 0;
}

}  // namespace

/// Where each row's points begin, and which columns there are.
void WindowImage::find_rows(std::span<const std::int32_t> pixel) {
  row_begin_.assign(1, 0);
  int first_column = image_width_, last_column = 0;
  for (auto begin = pixel.begin(); begin != pixel.end();) {
    const std::int32_t row_pixel =
        (first_row_ + static_cast<std::int32_t>(row_begin_.size()) - 1) * image_width_;
    const auto end = std::lower_bound(
        begin, begin + std::min<std::ptrdiff_t>(image_width_, pixel.end() - begin), row_pixel + image_width_);
    if (begin != end) {
      first_column = std::min(first_column, *begin - row_pixel);
      last_column = std::max(last_column, *(end - 1) - row_pixel);
    }
    row_begin_.push_back(static_cast<std::int32_t>(end - pixel.begin()));
    begin = end;
  }
  first_column_ = first_column;
  width_ = last_column - first_column + 1;
}

bool WindowImage::lay_out(const ImagePoints& cloud) {
  if (cloud.pixel.front() < 0 || !is_rising(cloud.pixel)) return false;
  image_width_ = cloud.camera.width;
  first_row_ = cloud.pixel.front() / image_width_;
  height_ = cloud.pixel.back() / image_width_ - first_row_ + 1;
  find_rows(cloud.pixel);
  stride_ = width_ + 2 * kMargin_px + kMaxLanes;
  size_ = static_cast<std::size_t>(stride_ * (height_ + 2 * kMargin_px));
  for (auto* plane : {&x_, &y_, &z_}) plane->resize(std::max(plane->size(), size_));

  fx_ = cloud.camera.fx;
  fy_ = cloud.camera.fy;
  column_tangent_.resize(static_cast<std::size_t>(width_));
  row_tangent_.resize(static_cast<std::size_t>(height_));
  for (int c = 0; c < width_; ++c)
    column_tangent_[static_cast<std::size_t>(c)] =
        cloud.camera.ray(static_cast<float>(c + first_column_), 0.0F).x();
  for (int r = 0; r < height_; ++r)
    row_tangent_[static_cast<std::size_t>(r)] =
        cloud.camera.ray(0.0F, static_cast<float>(r + first_row_)).y();
  for (int half = 1; half <= kMaxHalf_px; ++half) {
    const auto h = static_cast<std::size_t>(half);
    fill_bounds(column_tangent_, fx_, half, kMaxLanes, column_bound_[h]);
    fill_bounds(row_tangent_, fy_, half, 0, row_bound_[h]);
  }
  return true;
}

bool WindowImage::fill_rows(const ImagePoints& cloud, int first_row, int end_row) {
  // The first and the last rows bring the margin with them.
  const int from = first_row == 0 ? -kMargin_px : first_row;
  const int to = end_row == height_ ? height_ + kMargin_px : end_row;
  const std::ptrdiff_t begin = (from + kMargin_px) * stride_, end = (to + kMargin_px) * stride_;
  for (auto* plane : {&x_, &y_, &z_}) std::fill(plane->begin() + begin, plane->begin() + end, kNothing);
  bool on_rays = true;
  for (int row = first_row; row < end_row; ++row) {
    const float row_tangent = row_tangent_[static_cast<std::size_t>(row)];
    for (std::int32_t p = row_begin(row); p < row_begin(row + 1); ++p) {
      const auto i = static_cast<std::size_t>(p);
      const int column = column_of(cloud.pixel[i], row);
      const auto place = static_cast<std::size_t>(at(row, column));
      const float x = cloud.points.x[i], y = cloud.points.y[i], z = cloud.points.z[i];
      if (!cloud.is_on_rays) {
        const float off_x = std::abs(x - column_tangent_[static_cast<std::size_t>(column)] * z);
        const float off_y = std::abs(y - row_tangent * z);
        on_rays = on_rays && off_x <= kOnRay * z && off_y <= kOnRay * z;
      }
      x_[place] = x;
      y_[place] = y;
      z_[place] = z;
    }
  }
  return on_rays;
}

int WindowImage::columns_within(float radius_m, int column, float z_m) const {
  return lines_within(radius_m / z_m, column_tangent_[static_cast<std::size_t>(column)], fx_, width_);
}

int WindowImage::rows_within(float radius_m, int row, float z_m) const {
  return lines_within(radius_m / z_m, row_tangent_[static_cast<std::size_t>(row)], fy_, height_);
}

}  // namespace floornav
