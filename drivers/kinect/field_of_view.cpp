#include "drivers/kinect/field_of_view.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace floornav {

Pinhole pinhole_of_field_of_view(double horizontal_rad, double vertical_rad, int width, int height) {
  const auto possible = [](double angle) { return angle > 0.01 && angle < 0.99 * std::numbers::pi; };
  if (!possible(horizontal_rad) || !possible(vertical_rad))
    throw std::invalid_argument("a field of view must be between 0 and 180 degrees");
  Pinhole camera;
  camera.width = width;
  camera.height = height;
  camera.fx = static_cast<float>(width / (2 * std::tan(horizontal_rad / 2)));
  camera.fy = static_cast<float>(height / (2 * std::tan(vertical_rad / 2)));
  camera.cx = static_cast<float>((width - 1) / 2.0);
  camera.cy = static_cast<float>((height - 1) / 2.0);
  return camera;
}

}  // namespace floornav
