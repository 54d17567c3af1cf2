#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "floornav/depth_cloud_t.hpp"
#include "lcmtypes/depth_codec.hpp"

namespace floornav {

/// The pixels of a cloud from the wire, width x rows, row by row. Every field that says how to read them is
/// checked first: sizes, strip, intrinsics, error model, sensor's pose, uncertainty plane, encoding. Throws
/// CorruptDepth with the field and the cause. `pixels` is resized; its memory is used again.
void unpack_pixels(const depth_cloud_t& cloud, std::vector<std::uint16_t>& pixels);

/// Puts the pixels into encoding, size and data of a cloud: RVL, or RAW16 where that is smaller. Throws
/// std::length_error for more than kMostDepthPixels.
void pack_pixels(std::span<const std::uint16_t> pixels, depth_cloud_t& cloud);

}  // namespace floornav
