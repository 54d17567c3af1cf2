#include "runtime/process/log_reader.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace floornav {
namespace {

constexpr std::int64_t kWindowBytes = 1 << 20;
// How far into a file the first event may begin.
constexpr std::int64_t kSearchBytes = 64 << 20;

template <class Integer>
Integer big_endian(std::span<const std::uint8_t> bytes) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < sizeof(Integer); ++i) value = value << 8 | bytes[i];
  return static_cast<Integer>(value);
}

bool is_channel(std::span<const std::uint8_t> bytes) {
  return std::all_of(bytes.begin(), bytes.end(), [](std::uint8_t c) { return c > 0x20 && c < 0x7F; });
}

}  // namespace

LogReader::LogReader(const std::filesystem::path& file) : name_(file.string()) {
  descriptor_ = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor_ < 0) throw LogError(name_ + ": " + std::strerror(errno));
  struct stat status {};
  const bool is_file = ::fstat(descriptor_, &status) == 0 && S_ISREG(status.st_mode);
  size_ = status.st_size;
  if (!is_file || size_ == 0) {
    close();
    throw LogError(name_ + (is_file ? ": an empty file, not an LCM log" : ": not a file"));
  }
  try {
    const std::int64_t end = std::min(size_, kSearchBytes);
    if (find_header(0, end) == end) throw LogError(name_ + ": not an LCM log: no event in it");
  } catch (...) {
    close();
    throw;
  }
}

LogReader::~LogReader() {
  close();
}

void LogReader::close() {
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = -1;
}

bool LogReader::next(LogEvent& event) {
  const std::int64_t expected = position_;
  while (position_ < size_) {
    if (const std::optional<Header> header = event_at(position_)) {
      if (position_ > expected) ++skipped_places_;
      skipped_bytes_ += position_ - expected;
      const auto content = bytes(position_, header->event_bytes()).subspan(kLogHeaderBytes);
      const auto channel = content.first(static_cast<std::size_t>(header->channel_bytes));
      const auto data = content.subspan(channel.size());
      event.timestamp_us = header->timestamp_us;
      event.channel.assign(channel.begin(), channel.end());
      event.bytes.assign(data.begin(), data.end());
      position_ += header->event_bytes();
      return true;
    }
    position_ = find_header(position_ + 1, size_);
  }
  if (size_ > expected) ++skipped_places_;
  skipped_bytes_ += size_ - expected;
  return false;
}

std::span<const std::uint8_t> LogReader::bytes(std::int64_t offset, std::int64_t count) {
  const std::int64_t window_end = window_offset_ + static_cast<std::int64_t>(window_.size());
  if (offset < window_offset_ || offset + count > window_end) {
    window_offset_ = offset;
    window_.resize(static_cast<std::size_t>(std::min(std::max(count, kWindowBytes), size_ - offset)));
    std::size_t filled = 0;
    while (filled < window_.size()) {
      const ssize_t got = ::pread(descriptor_, window_.data() + filled, window_.size() - filled,
                                  offset + static_cast<std::int64_t>(filled));
      if (got < 0 && errno == EINTR) continue;
      if (got <= 0) {
        window_.clear();
        throw LogError(name_ + ": " + (got < 0 ? std::strerror(errno) : "became shorter while it was read"));
      }
      filled += static_cast<std::size_t>(got);
    }
  }
  return std::span(window_).subspan(static_cast<std::size_t>(offset - window_offset_),
                                    static_cast<std::size_t>(count));
}

/// The header at `offset`, where the event that it announces fits into the file.
std::optional<LogReader::Header> LogReader::header_at(std::int64_t offset) {
  const std::int64_t left = size_ - offset - kLogHeaderBytes;
  if (left < 0) return std::nullopt;
  const auto raw = bytes(offset, kLogHeaderBytes);
  if (big_endian<std::uint32_t>(raw) != kLogSync) return std::nullopt;
  Header header;
  header.timestamp_us = big_endian<std::int64_t>(raw.subspan(12));
  header.channel_bytes = big_endian<std::int32_t>(raw.subspan(20));
  header.data_bytes = big_endian<std::int32_t>(raw.subspan(24));
  if (header.channel_bytes < 1 || header.channel_bytes > kMaxChannelBytes || header.channel_bytes > left)
    return std::nullopt;
  if (header.data_bytes < 0 || header.data_bytes > left - header.channel_bytes) return std::nullopt;
  if (!is_channel(bytes(offset + kLogHeaderBytes, header.channel_bytes))) return std::nullopt;
  return header;
}

/// The event at `offset`, unless its length must be wrong: the next event does not follow, but one lies
/// inside.
std::optional<LogReader::Header> LogReader::event_at(std::int64_t offset) {
  const std::optional<Header> header = header_at(offset);
  if (!header) return std::nullopt;
  const std::int64_t end = offset + header->event_bytes();
  if (end == size_ || header_at(end)) return header;
  if (find_header(offset + 1, end) < end) return std::nullopt;
  return header;
}

/// Where the next sync word begins in [from, end); `end` where there is none.
std::int64_t LogReader::find_sync(std::int64_t from, std::int64_t end) {
  constexpr std::uint8_t kSync[] = {0xED, 0xA1, 0xDA, 0x01};
  while (from + 4 <= size_ && from < end) {
    const auto piece = bytes(from, std::min(size_ - from, kWindowBytes));
    const auto found = std::search(piece.begin(), piece.end(), std::begin(kSync), std::end(kSync));
    if (found != piece.end()) return std::min(end, from + (found - piece.begin()));
    from += static_cast<std::int64_t>(piece.size()) - 3;
  }
  return end;
}

/// Where the next header that holds together begins in [from, end); `end` where there is none.
std::int64_t LogReader::find_header(std::int64_t from, std::int64_t end) {
  for (from = find_sync(from, end); from < end; from = find_sync(from + 1, end)) {
    if (header_at(from)) return from;
  }
  return end;
}

}  // namespace floornav
