#pragma once

#include <optional>

#include <Eigen/Core>

namespace floornav {

/// A plane seen by the sensor. Along the ray (ray_x, ray_y, 1) its inverse depth is a ray_x + b ray_y + c:
/// linear in what the sensor measures, so that least squares in inverse depth (disparity) is the most likely
/// plane at every range.
struct InverseDepthPlane {
  float a = 0.0F;  ///< 1/m
  float b = 0.0F;  ///< 1/m
  float c = 0.0F;  ///< 1/m

  [[nodiscard]] float inverse_depth(float ray_x, float ray_y) const { return a * ray_x + b * ray_y + c; }
  [[nodiscard]] Eigen::Vector3f coefficients() const { return {a, b, c}; }
  /// Unit normal in the sensor frame, towards the sensor.
  [[nodiscard]] Eigen::Vector3f normal() const { return -coefficients().normalized(); }
  /// Distance of the sensor from the plane, m.
  [[nodiscard]] float distance_m() const { return 1.0F / coefficients().norm(); }
};

/// The plane through three measurements; nothing where their rays are almost in one plane.
std::optional<InverseDepthPlane> plane_through(
    const Eigen::Vector3f& p, const Eigen::Vector3f& q,
    const Eigen::Vector3f& r);  // each: ray_x, ray_y, inverse depth

/// The plane through one measurement (ray_x, ray_y, inverse depth) with this normal of the sensor frame;
/// nothing where it runs along the ray.
std::optional<InverseDepthPlane> plane_through(const Eigen::Vector3f& p, const Eigen::Vector3f& normal);

/// Weighted sums over points around a ray: x and y are counted from it, r is what the inverse depth is more
/// than some plane's. All are small numbers, so that a sum of floats is exact enough.
struct ResidualSums {
  float ray_x = 0, ray_y = 0;
  double w = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0, r = 0, xr = 0, yr = 0, rr = 0;

  /// Adds sums around the same ray.
  ResidualSums& operator+=(const ResidualSums& more) {
    w += more.w, x += more.x, y += more.y, r += more.r;
    xx += more.xx, xy += more.xy, yy += more.yy;
    xr += more.xr, yr += more.yr, rr += more.rr;
    return *this;
  }
};

/// Weighted least squares of inverse depth over the ray.
class PlaneFit {
 public:
  PlaneFit() = default;
  /// `plane`: the one from which the residuals are.
  PlaneFit(const ResidualSums& sums, const InverseDepthPlane& plane);

  void add(float ray_x, float ray_y, float inverse_depth, float weight) {
    const double w = static_cast<double>(weight);
    const double x = static_cast<double>(ray_x), y = static_cast<double>(ray_y),
                 q = static_cast<double>(inverse_depth);
    w_ += w, x_ += w * x, y_ += w * y, q_ += w * q, qq_ += w * q * q;
    xx_ += w * x * x, xy_ += w * x * y, yy_ += w * y * y, xq_ += w * x * q, yq_ += w * y * q;
  }
  PlaneFit& operator+=(const PlaneFit& more);
  /// Weighs all that was added.
  PlaneFit& operator*=(double weight);
  /// Nothing where the rays do not span a plane.
  [[nodiscard]] std::optional<InverseDepthPlane> solve() const;
  [[nodiscard]] Eigen::Vector2f mean_ray() const {
    return {static_cast<float>(x_ / w_), static_cast<float>(y_ / w_)};
  }
  /// The best one of the planes parallel to `plane`.
  [[nodiscard]] InverseDepthPlane solve_parallel(const InverseDepthPlane& plane) const;
  /// Weighted sum of squared residuals.
  [[nodiscard]] double cost(const InverseDepthPlane& plane) const;

 private:
  double w_ = 0, x_ = 0, y_ = 0, q_ = 0, xx_ = 0, xy_ = 0, yy_ = 0, xq_ = 0, yq_ = 0, qq_ = 0;
};

}  // namespace floornav
