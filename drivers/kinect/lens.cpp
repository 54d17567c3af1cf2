#include "drivers/kinect/lens.hpp"

#include <algorithm>
#include <cmath>

namespace floornav {

Eigen::Vector2d distort(const Eigen::Vector2d& ray, const Distortion& d) {
  const auto& [k1, k2, p1, p2, k3] = d;
  const double x = ray.x();
  const double y = ray.y();
  const double r2 = ray.squaredNorm();
  const double radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
  return {x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x),
          y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y};
}

Lens::Lens(const Pinhole& camera, const Distortion& distortion) {
  if (std::all_of(distortion.begin(), distortion.end(), [](double k) { return k == 0; })) return;
  for (int row = 0; row < camera.height; ++row)
    for (int column = 0; column < camera.width; ++column) {
      const Eigen::Vector3f ray = camera.ray(static_cast<float>(column), static_cast<float>(row));
      const Eigen::Vector2d at = distort(ray.head<2>().cast<double>(), distortion);
      const long u = std::lround(at.x() * static_cast<double>(camera.fx) + static_cast<double>(camera.cx));
      const long v = std::lround(at.y() * static_cast<double>(camera.fy) + static_cast<double>(camera.cy));
      const bool inside = u >= 0 && u < camera.width && v >= 0 && v < camera.height;
      source_.push_back(inside ? static_cast<std::int32_t>(v * camera.width + u) : -1);
    }
  result_.resize(source_.size());
}

void Lens::undistort(std::vector<std::uint16_t>& pixels) {
  if (source_.empty()) return;
  for (std::size_t i = 0; i < source_.size(); ++i)
    result_[i] = source_[i] < 0 ? std::uint16_t{0} : pixels[static_cast<std::size_t>(source_[i])];
  pixels.swap(result_);
}

}  // namespace floornav
