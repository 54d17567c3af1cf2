#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "runtime/process/log_event.hpp"

namespace floornav {

/// Reads an LCM log from its beginning. Believes nothing that it says: lengths are bounded by the bytes left,
/// and after damage it goes on at the next event that holds together.
class LogReader {
 public:
  /// Throws LogError for a file that is missing, empty or holds no event.
  explicit LogReader(const std::filesystem::path& file);
  ~LogReader();
  LogReader(const LogReader&) = delete;
  LogReader& operator=(const LogReader&) = delete;

  /// Fills in the next event. False at the end. Throws LogError where the disk fails.
  bool next(LogEvent& event);

  [[nodiscard]] std::int64_t size_bytes() const { return size_; }
  /// Bytes so far that belonged to no event, and the number of places where they lay: damage, or a log cut
  /// short.
  [[nodiscard]] std::int64_t skipped_bytes() const { return skipped_bytes_; }
  [[nodiscard]] std::int64_t skipped_places() const { return skipped_places_; }

 private:
  struct Header {
    std::int64_t timestamp_us = 0;
    std::int64_t channel_bytes = 0;
    std::int64_t data_bytes = 0;
    [[nodiscard]] std::int64_t event_bytes() const { return kLogHeaderBytes + channel_bytes + data_bytes; }
  };
  /// The file's bytes [offset, offset + count), all of which must exist.
  std::span<const std::uint8_t> bytes(std::int64_t offset, std::int64_t count);
  std::optional<Header> header_at(std::int64_t offset);
  std::optional<Header> event_at(std::int64_t offset);
  std::int64_t find_sync(std::int64_t from, std::int64_t end);
  std::int64_t find_header(std::int64_t from, std::int64_t end);
  void close();

  std::string name_;
  int descriptor_ = -1;
  std::int64_t size_ = 0;
  std::int64_t position_ = 0;
  std::int64_t skipped_bytes_ = 0;
  std::int64_t skipped_places_ = 0;
  std::vector<std::uint8_t> window_;  ///< a piece of the file, and where it begins
  std::int64_t window_offset_ = 0;
};

}  // namespace floornav
