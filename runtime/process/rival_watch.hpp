#pragma once

#include <chrono>
#include <cstdint>
#include <mutex>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "floornav/health_t.hpp"
#include "runtime/process/identity.hpp"

namespace floornav {

/// Notices that somebody else publishes on a process's own channels: a log is played on the live bus, or the
/// process runs twice. Thread-safe.
class RivalWatch {
 public:
  using Instant = std::chrono::steady_clock::time_point;
  static constexpr std::chrono::seconds kRemembered{2};

  RivalWatch(Identity identity, const std::vector<std::string>& channels)
      : identity_(std::move(identity)), channels_(channels.begin(), channels.end()) {}

  /// Looks at a message from the bus.
  void look(std::string_view channel, std::span<const std::uint8_t> bytes, Instant now);
  /// Makes `health` DEGRADED while a rival is about.
  void report(health_t& health, Instant now) const;

 private:
  Identity identity_;
  std::set<std::string, std::less<>> channels_;
  mutable std::mutex mutex_;
  Instant last_{};
  std::string who_;
  std::int64_t count_ = 0;
};

}  // namespace floornav
