#include "tools/import/pinhole_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace floornav {

namespace {

bool is_measured(const Eigen::Vector3f& point) {
  return point.allFinite() && point.z() > 0;
}

/// Calls `take(column, row, point)` for every point in front of the camera.
template <class Take>
void for_each_point(const OrganisedCloud& cloud, Take take) {
  for (int row = 0; row < cloud.height; ++row)
    for (int column = 0; column < cloud.width; ++column) {
      const auto& point = cloud.points[static_cast<std::size_t>(row) * static_cast<std::size_t>(cloud.width) +
                                       static_cast<std::size_t>(column)];
      if (is_measured(point)) take(column, row, point);
    }
}

/// Least squares of tangent = (pixel - c) / f.
class RayLine {
 public:
  void add(double pixel, double tangent) {
    n_ += 1;
    pixel_ += pixel;
    tangent_ += tangent;
    pixel_pixel_ += pixel * pixel;
    pixel_tangent_ += pixel * tangent;
  }
  [[nodiscard]] double focal() const {
    return (n_ * pixel_pixel_ - pixel_ * pixel_) / (n_ * pixel_tangent_ - pixel_ * tangent_);
  }
  [[nodiscard]] double center() const { return pixel_ / n_ - focal() * tangent_ / n_; }
  [[nodiscard]] double count() const { return n_; }

 private:
  double n_ = 0;
  double pixel_ = 0;
  double tangent_ = 0;
  double pixel_pixel_ = 0;
  double pixel_tangent_ = 0;
};

}  // namespace

Pinhole fit_pinhole(const OrganisedCloud& cloud) {
  constexpr double kLeastPoints = 100;
  RayLine columns;
  RayLine rows;
  for_each_point(cloud, [&](int column, int row, const Eigen::Vector3f& p) {
    columns.add(column, double{p.x()} / p.z());
    rows.add(row, double{p.y()} / p.z());
  });
  if (columns.count() < kLeastPoints)
    throw std::runtime_error("has hardly a point in front of the camera (z > 0)");
  return {static_cast<float>(columns.focal()),
          static_cast<float>(rows.focal()),
          static_cast<float>(columns.center()),
          static_cast<float>(rows.center()),
          cloud.width,
          cloud.height};
}

RayResidual ray_residual(const OrganisedCloud& cloud, const Pinhole& camera) {
  RayResidual residual;
  double squares = 0;
  double points = 0;
  for_each_point(cloud, [&](int column, int row, const Eigen::Vector3f& p) {
    const Eigen::Vector2f pixel = camera.project(p);
    const double off =
        std::hypot(pixel.x() - static_cast<float>(column), pixel.y() - static_cast<float>(row));
    squares += off * off;
    points += 1;
    residual.worst_px = std::max(residual.worst_px, off);
  });
  if (points > 0) residual.rms_px = std::sqrt(squares / points);
  return residual;
}

ScaledDepth depth_of(const OrganisedCloud& cloud) {
  constexpr double kMostCounts = std::numeric_limits<std::uint16_t>::max() - 1;
  constexpr double kExact_m = 1e-6;  // a float's error on millimetres at 10 m
  constexpr std::array<double, 5> kScales_m{0.0001, 0.0002, 0.0005, 0.001, 0.01};
  double farthest_m = 0;
  double off_millimetres_m = 0;
  for_each_point(cloud, [&](int, int, const Eigen::Vector3f& p) {
    const double z_m = p.z();
    farthest_m = std::max(farthest_m, z_m);
    off_millimetres_m = std::max(off_millimetres_m, std::abs(z_m - std::round(z_m * 1000) / 1000));
  });
  const bool millimetres = off_millimetres_m < kExact_m && farthest_m * 1000 <= kMostCounts;
  const auto fits = [&](double scale_m) { return farthest_m / scale_m <= kMostCounts; };
  const auto* const finest = std::ranges::find_if(kScales_m, fits);
  if (finest == kScales_m.end()) throw std::runtime_error("has points farther than 655 m");

  ScaledDepth depth{{cloud.width, cloud.height, std::vector<std::uint16_t>(cloud.points.size())},
                    millimetres ? 0.001 : *finest,
                    0};
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (!is_measured(cloud.points[i])) continue;
    const double z_m = cloud.points[i].z();
    const double counts = std::round(z_m / depth.scale_m);
    depth.image.pixels[i] = static_cast<std::uint16_t>(counts);
    depth.worst_rounding_m = std::max(depth.worst_rounding_m, std::abs(z_m - counts * depth.scale_m));
  }
  return depth;
}

}  // namespace floornav
