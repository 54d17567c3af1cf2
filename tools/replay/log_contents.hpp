#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

namespace floornav {

/// What a log holds, found by reading it once.
struct LogContents {
  std::int64_t events = 0;
  std::int64_t clouds = 0;                       ///< messages on the clouds' channels
  std::int64_t first_us = 0;                     ///< time stamp of the first event
  std::int64_t last_us = 0;                      ///< of the last one
  std::map<std::string, std::int64_t> channels;  ///< events on each
  std::int64_t skipped_bytes = 0;                ///< that belong to no event
  std::int64_t skipped_places = 0;
};

/// Throws LogError for a file that is missing, empty or no log.
LogContents contents_of(const std::filesystem::path& log);

/// Throws LogError where there is nothing to replay, or where the log is damaged or cut short and `salvage`
/// is false.
void require_replayable(const LogContents& contents, const std::filesystem::path& log, bool salvage);

}  // namespace floornav
