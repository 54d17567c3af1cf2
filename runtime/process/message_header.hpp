#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace floornav {

/// The fields with which every message of ours but POSE begins, read without decoding the rest.
struct MessageHeader {
  std::int64_t utime = 0;
  std::string_view source;  ///< points into the message
  std::int64_t session = 0;
  std::int64_t seq = 0;
};

/// utime, the first field of every message (POSE too).
std::optional<std::int64_t> peek_utime(std::span<const std::uint8_t> bytes);

/// Nothing where the bytes do not begin like this. Checks no fingerprint: the decode does.
std::optional<MessageHeader> peek_header(std::span<const std::uint8_t> bytes);

}  // namespace floornav
