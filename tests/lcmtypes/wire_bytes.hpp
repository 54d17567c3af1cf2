#pragma once

#include <bit>
#include <cstdint>
#include <string_view>
#include <vector>

namespace floornav {

/// A message written by hand, after LCM's description of its format: big-endian, fingerprint first.
class WireBytes {
 public:
  explicit WireBytes(std::int64_t fingerprint) { i64(fingerprint); }

  WireBytes& i8(std::int8_t value) { return put(static_cast<std::uint8_t>(value), 1); }
  WireBytes& i16(std::int16_t value) { return put(static_cast<std::uint16_t>(value), 2); }
  WireBytes& i32(std::int32_t value) { return put(static_cast<std::uint32_t>(value), 4); }
  WireBytes& i64(std::int64_t value) { return put(static_cast<std::uint64_t>(value), 8); }
  WireBytes& f32(float value) { return put(std::bit_cast<std::uint32_t>(value), 4); }
  WireBytes& f64(double value) { return put(std::bit_cast<std::uint64_t>(value), 8); }
  /// Length with terminator, characters, terminator.
  WireBytes& text(std::string_view value);

  operator const std::vector<std::uint8_t>&() const { return bytes_; }

 private:
  WireBytes& put(std::uint64_t value, int bytes);

  std::vector<std::uint8_t> bytes_;
};

}  // namespace floornav
