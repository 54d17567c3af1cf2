#include "runtime/process/latency.hpp"

#include <algorithm>
#include <cmath>

namespace floornav {

void LatencyHistogram::add(std::chrono::nanoseconds duration) {
  const double us = std::max(1.0, static_cast<double>(duration.count()) * 1e-3);
  const int bin = static_cast<int>(std::log2(us) * kPerOctave);
  ++bins_[static_cast<std::size_t>(std::clamp(bin, 0, kPerOctave * kOctaves - 1))];
  ++count_;
  max_ = std::max(max_, duration);
}

void LatencyHistogram::merge(const LatencyHistogram& other) {
  for (std::size_t i = 0; i < bins_.size(); ++i) bins_[i] += other.bins_[i];
  count_ += other.count_;
  max_ = std::max(max_, other.max_);
}

double LatencyHistogram::percentile_ms(double share) const {
  const auto wanted = static_cast<std::int64_t>(std::ceil(share * static_cast<double>(count_)));
  std::int64_t below = 0;
  for (std::size_t bin = 0; bin + 1 < bins_.size(); ++bin) {  // the last one has no upper end
    below += bins_[bin];
    if (below >= wanted && below > 0)
      return std::min(max_ms(), std::exp2((static_cast<double>(bin) + 1) / kPerOctave) * 1e-3);
  }
  return max_ms();
}

void RecentLatency::add(std::chrono::nanoseconds duration, Instant now) {
  if (now - begin_ >= kWindow) {
    previous_ = now - begin_ < 2 * kWindow ? current_ : LatencyHistogram();
    current_ = {};
    begin_ = now;
  }
  current_.add(duration);
}

LatencyHistogram RecentLatency::recent(Instant now) const {
  LatencyHistogram all;
  if (now - begin_ < 2 * kWindow) all.merge(current_);
  if (now - begin_ < kWindow) all.merge(previous_);
  return all;
}

}  // namespace floornav
