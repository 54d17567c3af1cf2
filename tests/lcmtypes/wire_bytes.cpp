#include "wire_bytes.hpp"

namespace floornav {

WireBytes& WireBytes::text(std::string_view value) {
  i32(static_cast<std::int32_t>(value.size() + 1));
  bytes_.insert(bytes_.end(), value.begin(), value.end());
  return i8(0);
}

WireBytes& WireBytes::put(std::uint64_t value, int bytes) {
  for (int byte = bytes - 1; byte >= 0; --byte)
    bytes_.push_back(static_cast<std::uint8_t>(value >> (8 * byte)));
  return *this;
}

}  // namespace floornav
