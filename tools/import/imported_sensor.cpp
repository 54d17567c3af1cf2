#include "tools/import/imported_sensor.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "floornav/depth_cloud_t.hpp"
#include "lcmtypes/channels.hpp"

namespace floornav {

ImportedSensor imported_sensor(const std::string& name) {
  // eq. (3): 1.4 cm at 3 m; eq. (4), wide baseline of the XB3: 0.35 cm at 3 m
  if (name == "kinect") return {depth_cloud_t::KINECT, channel::kKinectCloud, 0.075, 0.014 / 9};
  if (name == "bumblebee") return {depth_cloud_t::BUMBLEBEE, channel::kBumblebeeCloud, 0.24, 0.0035 / 9};
  throw std::invalid_argument("sensor is kinect or bumblebee, not " + name);
}

Pinhole parse_intrinsics(const std::string& text) {
  std::array<float, 4> values{};
  const char* at = text.data();
  const char* const end = at + text.size();
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto [stop, error] = std::from_chars(at, end, values[i]);
    const bool last = i + 1 == values.size();
    if (error != std::errc{} || (last ? stop != end : (stop == end || *stop != ',')))
      throw std::runtime_error(fmt::format("--intrinsics \"{}\" is not fx,fy,cx,cy in pixels", text));
    at = last ? stop : stop + 1;
  }
  Pinhole camera;
  camera.fx = values[0];
  camera.fy = values[1];
  camera.cx = values[2];
  camera.cy = values[3];
  return camera;
}

void check_intrinsics(const Pinhole& camera) {
  constexpr double kShortestFocal = 0.1;  // of the image's size: 157 degrees of view
  constexpr double kLongestFocal = 50;    // 1.1 degrees
  constexpr double kOutside = 0.5;
  const auto require = [](const char* name, double value, double least, double most) {
    if (!(value >= least && value <= most))
      throw std::runtime_error(fmt::format("intrinsics: {} = {} px, an image of this size allows {} .. {}",
                                           name, value, least, most));
  };
  require("fx", camera.fx, kShortestFocal * camera.width, kLongestFocal * camera.width);
  require("fy", camera.fy, kShortestFocal * camera.height, kLongestFocal * camera.height);
  require("cx", camera.cx, -kOutside * camera.width, (1 + kOutside) * camera.width);
  require("cy", camera.cy, -kOutside * camera.height, (1 + kOutside) * camera.height);
}

}  // namespace floornav
