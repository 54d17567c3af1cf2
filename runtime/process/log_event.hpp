#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace floornav {

/// One message of an LCM log.
struct LogEvent {
  std::int64_t timestamp_us = 0;  ///< when the logger received it, us since the epoch
  std::string channel;
  std::vector<std::uint8_t> bytes;
};

/// A log that cannot be read or written: one line with the file's name.
class LogError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The bytes of an event in a log, all big endian: sync word, i64 number, i64 timestamp, i32 length of the
/// channel, i32 length of the data; then the channel and the data.
inline constexpr std::uint32_t kLogSync = 0xEDA1DA01;
inline constexpr std::int64_t kLogHeaderBytes = 28;
/// The longest channel that LCM sends.
inline constexpr std::int64_t kMaxChannelBytes = 63;

}  // namespace floornav
