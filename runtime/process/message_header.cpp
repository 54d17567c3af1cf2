#include "runtime/process/message_header.hpp"

#include <cstddef>

namespace floornav {
namespace {

constexpr std::size_t kFingerprintBytes = 8;
constexpr std::size_t kMaxSourceBytes = 255;

/// The big-endian number of `count` bytes at `offset`, all of which must exist.
std::uint64_t number_at(std::span<const std::uint8_t> bytes, std::size_t offset, std::size_t count) {
  std::uint64_t value = 0;
  for (const std::uint8_t byte : bytes.subspan(offset, count)) value = value << 8 | byte;
  return value;
}

}  // namespace

std::optional<std::int64_t> peek_utime(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < kFingerprintBytes + 8) return std::nullopt;
  return static_cast<std::int64_t>(number_at(bytes, kFingerprintBytes, 8));
}

std::optional<MessageHeader> peek_header(std::span<const std::uint8_t> bytes) {
  constexpr std::size_t kSource = kFingerprintBytes + 8 + 4;
  if (bytes.size() < kSource) return std::nullopt;
  const auto source_bytes =
      static_cast<std::size_t>(number_at(bytes, kSource - 4, 4));  // with its final zero
  if (source_bytes < 1 || source_bytes > kMaxSourceBytes) return std::nullopt;
  const std::size_t session = kSource + source_bytes;
  if (bytes.size() < session + 16 || bytes[session - 1] != 0) return std::nullopt;
  MessageHeader header;
  header.utime = static_cast<std::int64_t>(number_at(bytes, kFingerprintBytes, 8));
  header.source = {reinterpret_cast<const char*>(bytes.data() + kSource), source_bytes - 1};
  header.session = static_cast<std::int64_t>(number_at(bytes, session, 8));
  header.seq = static_cast<std::int64_t>(number_at(bytes, session + 8, 8));
  return header;
}

}  // namespace floornav
