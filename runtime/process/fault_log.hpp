#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <string>

#include "floornav/health_t.hpp"

namespace floornav {

/// Remembers a node's exceptions: one is a flaw that HEALTH tells for a while, several in a row are a fault.
class FaultLog {
 public:
  using Instant = std::chrono::steady_clock::time_point;
  static constexpr std::chrono::seconds kRemembered{5};
  static constexpr std::size_t kFault = 3;

  void add(const std::string& what, Instant now);
  /// Makes `health` DEGRADED or FAULT by what happened in the last few seconds.
  void report(health_t& health, Instant now) const;

 private:
  std::deque<Instant> recent_;
  std::string last_;
  std::int64_t count_ = 0;
};

}  // namespace floornav
