#include "runtime/process/log_writer.hpp"

#include <array>
#include <cerrno>
#include <cstring>
#include <limits>
#include <stdexcept>

namespace floornav {
namespace {

template <class Integer>
void append_big_endian(std::uint8_t*& place, Integer value) {
  for (int shift = static_cast<int>(8 * sizeof(Integer)) - 8; shift >= 0; shift -= 8)
    *place++ = static_cast<std::uint8_t>(static_cast<std::uint64_t>(value) >> shift);
}

}  // namespace

LogWriter::LogWriter(const std::filesystem::path& file) : name_(file.string()) {
  file_.reset(std::fopen(file.c_str(), "wbe"));
  if (!file_) fail();
}

void LogWriter::write(std::int64_t timestamp_us, std::string_view channel,
                      std::span<const std::uint8_t> bytes) {
  if (!file_) throw std::logic_error(name_ + ": written to after close()");
  if (channel.empty() || channel.size() > static_cast<std::size_t>(kMaxChannelBytes))
    throw std::invalid_argument("a channel has 1 to 63 characters: '" + std::string(channel) + "'");
  if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
    throw std::invalid_argument(std::string(channel) + ": a message of more than 2 GB");
  std::array<std::uint8_t, kLogHeaderBytes> header{};
  std::uint8_t* place = header.data();
  append_big_endian(place, kLogSync);
  append_big_endian(place, events_++);
  append_big_endian(place, timestamp_us);
  append_big_endian(place, static_cast<std::int32_t>(channel.size()));
  append_big_endian(place, static_cast<std::int32_t>(bytes.size()));
  put(header);
  put({reinterpret_cast<const std::uint8_t*>(channel.data()), channel.size()});
  put(bytes);
}

void LogWriter::close() {
  if (file_ && std::fclose(file_.release()) != 0) fail();
}

void LogWriter::put(std::span<const std::uint8_t> bytes) {
  if (!bytes.empty() && std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size()) fail();
}

void LogWriter::fail() const {
  throw LogError(name_ + ": " + std::strerror(errno));
}

}  // namespace floornav
