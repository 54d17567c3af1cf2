#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "runtime/process/log_event.hpp"

namespace floornav {

/// Writes an LCM log: the same events make the same bytes.
class LogWriter {
 public:
  /// Replaces the file. Throws LogError where it cannot be made.
  explicit LogWriter(const std::filesystem::path& file);

  /// Throws LogError where the disk is full, std::invalid_argument for a channel that LCM would not take.
  void write(std::int64_t timestamp_us, std::string_view channel, std::span<const std::uint8_t> bytes);

  /// Ends the log; throws LogError where its end does not reach the disk. Without it the destructor closes
  /// silently.
  void close();

 private:
  struct Closer {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  void put(std::span<const std::uint8_t> bytes);
  [[noreturn]] void fail() const;

  std::string name_;
  std::unique_ptr<std::FILE, Closer> file_;
  std::int64_t events_ = 0;
};

}  // namespace floornav
