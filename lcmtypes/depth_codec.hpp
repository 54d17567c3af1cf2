#pragma once

#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

namespace floornav {

/// Bytes that are no depth image; what() says why.
struct CorruptDepth : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// No image may have more pixels: a few bytes can claim any number of them.
inline constexpr std::size_t kMostDepthPixels = (std::size_t{1} << 24) - 1;

/// Lossless RVL code of a 16-bit image (A. D. Wilson, Fast Lossless Depth Image Compression, ISS 2017): in
/// turns the length of a run of zeros, the length of a run of others, and for each of these the difference
/// from the last one not zero, folded to an unsigned number (0, -1, 1, -2 ... to 0, 1, 2, 3 ...). A number is
/// a chain of nibbles with 3 bits each, lowest first, whose top bit says that another follows. Nibbles fill
/// little-endian 32-bit words from the top. `code` is overwritten. Throws std::length_error for more than
/// kMostDepthPixels.
void encode_rvl(std::span<const std::uint16_t> pixels, std::vector<std::uint8_t>& code);

/// The inverse; fills all of `pixels`. Throws CorruptDepth unless `code` is, to the byte, what encode_rvl
/// makes of the pixels. Reads nothing outside `code`, and `pixels` holds anything after an error.
void decode_rvl(std::span<const std::uint8_t> code, std::span<std::uint16_t> pixels);

/// The plain form: little-endian, one pixel after the other.
void encode_raw16(std::span<const std::uint16_t> pixels, std::vector<std::uint8_t>& code);

/// The inverse. Throws CorruptDepth where `code` is not two bytes a pixel.
void decode_raw16(std::span<const std::uint8_t> code, std::span<std::uint16_t> pixels);

}  // namespace floornav
