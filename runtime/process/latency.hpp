#pragma once

#include <array>
#include <chrono>
#include <cstdint>

namespace floornav {

/// A histogram of durations from 1 us to over an hour with 3 % resolution, in constant memory.
class LatencyHistogram {
 public:
  void add(std::chrono::nanoseconds duration);
  void clear() { *this = {}; }
  /// Adds the other's durations to this one's.
  void merge(const LatencyHistogram& other);

  [[nodiscard]] std::int64_t count() const { return count_; }
  /// The duration that `share` (0..1) of all do not exceed, within the resolution and never above the
  /// longest; 0 where there is none.
  [[nodiscard]] double percentile_ms(double share) const;
  [[nodiscard]] double max_ms() const { return static_cast<double>(max_.count()) * 1e-6; }

 private:
  static constexpr int kPerOctave = 32;
  static constexpr int kOctaves = 32;
  std::array<std::uint32_t, static_cast<std::size_t>(kPerOctave* kOctaves)> bins_{};
  std::int64_t count_ = 0;
  std::chrono::nanoseconds max_{0};
};

/// The durations of the last 10 to 20 seconds.
class RecentLatency {
 public:
  using Instant = std::chrono::steady_clock::time_point;
  static constexpr std::chrono::seconds kWindow{10};

  void add(std::chrono::nanoseconds duration, Instant now);
  [[nodiscard]] LatencyHistogram recent(Instant now) const;

 private:
  LatencyHistogram current_;
  LatencyHistogram previous_;
  Instant begin_{};  ///< of current_
};

}  // namespace floornav
