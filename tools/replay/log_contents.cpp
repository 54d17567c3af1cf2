#include "tools/replay/log_contents.hpp"

#include <fmt/format.h>

#include "lcmtypes/channels.hpp"
#include "runtime/process/log_reader.hpp"

namespace floornav {

namespace {

std::string names_of(const std::map<std::string, std::int64_t>& channels) {
  constexpr std::size_t kMostNamed = 6;
  std::string names;
  std::size_t named = 0;
  for (const auto& [channel, count] : channels) {
    if (++named > kMostNamed) return names + ", ...";
    names += fmt::format("{}{}", names.empty() ? "" : ", ", channel);
  }
  return names;
}

}  // namespace

LogContents contents_of(const std::filesystem::path& log) {
  LogContents contents;
  LogReader reader(log);
  LogEvent event;
  while (reader.next(event)) {
    if (contents.events == 0) contents.first_us = event.timestamp_us;
    contents.last_us = event.timestamp_us;
    ++contents.events;
    ++contents.channels[event.channel];
  }
  for (const char* channel : {channel::kKinectCloud, channel::kBumblebeeCloud})
    if (const auto found = contents.channels.find(channel); found != contents.channels.end())
      contents.clouds += found->second;
  contents.skipped_bytes = reader.skipped_bytes();
  contents.skipped_places = reader.skipped_places();
  return contents;
}

void require_replayable(const LogContents& contents, const std::filesystem::path& log, bool salvage) {
  if (contents.clouds == 0)
    throw LogError(fmt::format("{}: holds no {} or {}; its channels are {}", log.string(),
                               channel::kKinectCloud, channel::kBumblebeeCloud, names_of(contents.channels)));
  if (contents.skipped_bytes > 0 && !salvage)
    throw LogError(fmt::format(
        "{}: damaged or cut short, {} bytes at {} place(s) belong to no event; --salvage replays the rest",
        log.string(), contents.skipped_bytes, contents.skipped_places));
}

}  // namespace floornav
