#pragma once

#include <cstdint>
#include <span>

#include "runtime/geometry/pinhole.hpp"
#include "runtime/geometry/pose.hpp"

namespace floornav {

enum class PixelMeaning : std::uint8_t { kDepth, kDisparity };

/// One frame of either sensor, decoded. The spans belong to the caller.
struct DepthFrame {
  std::int64_t utime_us = 0;
  Pinhole camera;
  PixelMeaning meaning = PixelMeaning::kDepth;
  float scale = 0.001F;                   ///< m (depth) or px (disparity) a count
  std::span<const std::uint16_t> pixels;  ///< width x height, row by row; 0 = no measurement
  float baseline_m = 0.075F;
  float disparity_sigma_px = 0.067F;  ///< eq. (3) / (4): sigma_z = Z^2 disparity_sigma / (fx baseline)
  std::span<const std::uint8_t>
      uncertainty;                        ///< empty, or width x height: 1 sigma of disparity, 0 = as above
  float uncertainty_scale = 0.0F;         ///< px a count of uncertainty
  Pose T_body_sensor = Pose::Identity();  ///< sensor axes x right, y down, z forward
};

}  // namespace floornav
