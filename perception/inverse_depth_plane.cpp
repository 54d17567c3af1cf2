#include "perception/inverse_depth_plane.hpp"

#include <cmath>

namespace floornav {

namespace {

/// Twice the area of the triangle of three rays below which they determine no plane (about 7 x 7 pixels of a
/// Kinect).
constexpr float kMinTriangle = 2e-4F;
/// Least part of the normal along the ray.
constexpr float kMinAlongRay = 1e-3F;
/// Least deviation of the rays across their main direction, in rays at depth 1 (about one pixel).
constexpr double kMinDeviation = 1e-3;

}  // namespace

std::optional<InverseDepthPlane> plane_through(const Eigen::Vector3f& p, const Eigen::Vector3f& q,
                                               const Eigen::Vector3f& r) {
  const Eigen::Vector3f u = q - p;
  const Eigen::Vector3f v = r - p;
  const float det = u.x() * v.y() - u.y() * v.x();
  if (!(std::abs(det) >= kMinTriangle)) return std::nullopt;
  InverseDepthPlane plane;
  plane.a = (u.z() * v.y() - u.y() * v.z()) / det;
  plane.b = (u.x() * v.z() - u.z() * v.x()) / det;
  plane.c = p.z() - plane.a * p.x() - plane.b * p.y();
  return plane;
}

std::optional<InverseDepthPlane> plane_through(const Eigen::Vector3f& p, const Eigen::Vector3f& normal) {
  const float along_ray = normal.x() * p.x() + normal.y() * p.y() + normal.z();
  if (!(std::abs(along_ray) >= kMinAlongRay)) return std::nullopt;
  const Eigen::Vector3f coefficients = normal * (p.z() / along_ray);
  return InverseDepthPlane{coefficients.x(), coefficients.y(), coefficients.z()};
}

PlaneFit::PlaneFit(const ResidualSums& s, const InverseDepthPlane& plane) {
  const double a = static_cast<double>(plane.a), b = static_cast<double>(plane.b);
  const double x0 = static_cast<double>(s.ray_x), y0 = static_cast<double>(s.ray_y);
  const double c = a * x0 + b * y0 + static_cast<double>(plane.c);
  // Inverse depth is residual + a x + b y + c; x and y still count from the ray.
  const double q = s.r + a * s.x + b * s.y + c * s.w;
  const double xq = s.xr + a * s.xx + b * s.xy + c * s.x;
  const double yq = s.yr + a * s.xy + b * s.yy + c * s.y;
  qq_ = s.rr + 2.0 * (a * s.xr + b * s.yr + c * s.r) + a * a * s.xx + 2.0 * a * b * s.xy + b * b * s.yy +
        2.0 * c * (a * s.x + b * s.y) + c * c * s.w;
  w_ = s.w, q_ = q;
  x_ = s.x + x0 * s.w, y_ = s.y + y0 * s.w;
  xx_ = s.xx + 2.0 * x0 * s.x + x0 * x0 * s.w;
  yy_ = s.yy + 2.0 * y0 * s.y + y0 * y0 * s.w;
  xy_ = s.xy + x0 * s.y + y0 * s.x + x0 * y0 * s.w;
  xq_ = xq + x0 * q, yq_ = yq + y0 * q;
}

PlaneFit& PlaneFit::operator+=(const PlaneFit& more) {
  w_ += more.w_, x_ += more.x_, y_ += more.y_, q_ += more.q_, qq_ += more.qq_;
  xx_ += more.xx_, xy_ += more.xy_, yy_ += more.yy_, xq_ += more.xq_, yq_ += more.yq_;
  return *this;
}

PlaneFit& PlaneFit::operator*=(double weight) {
  for (double* sum : {&w_, &x_, &y_, &q_, &qq_, &xx_, &xy_, &yy_, &xq_, &yq_}) *sum *= weight;
  return *this;
}

std::optional<InverseDepthPlane> PlaneFit::solve() const {
  if (!(w_ > 0.0)) return std::nullopt;
  const double mx = x_ / w_, my = y_ / w_, mq = q_ / w_;
  const double vxx = xx_ / w_ - mx * mx, vxy = xy_ / w_ - mx * my, vyy = yy_ / w_ - my * my;
  const double det = vxx * vyy - vxy * vxy;
  const double trace = vxx + vyy;
  // det / trace is at most the smaller eigenvalue of the rays' covariance, and at least half of it.
  if (!(trace > 0.0 && det > kMinDeviation * kMinDeviation * trace)) return std::nullopt;
  const double vxq = xq_ / w_ - mx * mq, vyq = yq_ / w_ - my * mq;
  const double a = (vxq * vyy - vyq * vxy) / det;
  const double b = (vyq * vxx - vxq * vxy) / det;
  return InverseDepthPlane{static_cast<float>(a), static_cast<float>(b),
                           static_cast<float>(mq - a * mx - b * my)};
}

/// Parallel planes differ by a factor of all three coefficients.
InverseDepthPlane PlaneFit::solve_parallel(const InverseDepthPlane& plane) const {
  const double a = static_cast<double>(plane.a), b = static_cast<double>(plane.b),
               c = static_cast<double>(plane.c);
  const double with_q = a * xq_ + b * yq_ + c * q_;
  const double with_itself =
      a * a * xx_ + b * b * yy_ + c * c * w_ + 2.0 * (a * b * xy_ + a * c * x_ + b * c * y_);
  const double factor = with_q / with_itself;
  return {static_cast<float>(factor * a), static_cast<float>(factor * b), static_cast<float>(factor * c)};
}

double PlaneFit::cost(const InverseDepthPlane& plane) const {
  const double a = static_cast<double>(plane.a), b = static_cast<double>(plane.b),
               c = static_cast<double>(plane.c);
  return qq_ - 2.0 * (a * xq_ + b * yq_ + c * q_) + a * a * xx_ + b * b * yy_ + c * c * w_ +
         2.0 * (a * b * xy_ + a * c * x_ + b * c * y_);
}

}  // namespace floornav
