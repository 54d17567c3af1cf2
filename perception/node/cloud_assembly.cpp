#include "perception/node/cloud_assembly.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "lcmtypes/depth_cloud.hpp"

namespace floornav {

namespace {

bool continues(const depth_cloud_t& before, const depth_cloud_t& next) {
  const auto frame = [](const depth_cloud_t& c) {
    return std::tie(c.source, c.session, c.frame, c.utime, c.sensor, c.width, c.height, c.fx, c.fy, c.cx,
                    c.cy, c.baseline, c.disparity_sigma, c.meaning, c.scale, c.uncertainty_scale);
  };
  return frame(before) == frame(next) && next.first_row == before.first_row + before.rows &&
         before.uncertainty.empty() == next.uncertainty.empty() &&
         std::equal(std::begin(before.sensor_pos), std::end(before.sensor_pos), next.sensor_pos) &&
         std::equal(std::begin(before.sensor_orientation), std::end(before.sensor_orientation),
                    next.sensor_orientation);
}

}  // namespace

std::optional<CloudStrips> CloudAssembly::add(const depth_cloud_t& cloud) {
  if (!strips_.empty() && !continues(strips_.back(), cloud)) {
    ++incomplete_;
    strips_.clear();
  }
  if (strips_.empty() && cloud.first_row != 0) {
    ++incomplete_;
    return std::nullopt;
  }
  strips_.push_back(cloud);
  if (cloud.first_row + cloud.rows < cloud.height) return std::nullopt;
  return std::exchange(strips_, {});
}

DepthFrame unpack_frame(const CloudStrips& strips, FramePixels& memory) {
  memory.pixels.clear();
  memory.uncertainty.clear();
  for (const depth_cloud_t& strip : strips) {
    unpack_pixels(strip, memory.strip);
    if (memory.pixels.empty())
      std::swap(memory.pixels, memory.strip);
    else
      memory.pixels.insert(memory.pixels.end(), memory.strip.begin(), memory.strip.end());
    memory.uncertainty.insert(memory.uncertainty.end(), strip.uncertainty.begin(), strip.uncertainty.end());
  }
  const depth_cloud_t& cloud = strips.front();
  DepthFrame frame;
  frame.utime_us = cloud.utime;
  frame.camera = {cloud.fx, cloud.fy, cloud.cx, cloud.cy, cloud.width, cloud.height};
  frame.meaning = cloud.meaning == depth_cloud_t::DEPTH ? PixelMeaning::kDepth : PixelMeaning::kDisparity;
  frame.scale = cloud.scale;
  frame.pixels = memory.pixels;
  frame.baseline_m = cloud.baseline;
  frame.disparity_sigma_px = cloud.disparity_sigma;
  frame.uncertainty = memory.uncertainty;
  frame.uncertainty_scale = cloud.uncertainty_scale;
  frame.T_body_sensor = pose_from_arrays(cloud.sensor_pos, cloud.sensor_orientation);
  return frame;
}

}  // namespace floornav
