#pragma once

#include <algorithm>
#include <cstddef>
#include <ctime>
#include <vector>

namespace floornav {

/// Of this thread: other programs on the machine do not count.
inline double processor_time_us() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e6 * static_cast<double>(now.tv_sec) + 1e-3 * static_cast<double>(now.tv_nsec);
}

/// What two readings of that clock take, one after the other.
inline double clock_reading_us() {
  static const double median_us = [] {
    std::vector<double> tries(101);
    for (double& us : tries) {
      const double begin_us = processor_time_us();
      us = processor_time_us() - begin_us;
    }
    std::nth_element(tries.begin(), tries.begin() + 50, tries.end());
    return tries[50];
  }();
  return median_us;
}

/// Times of many tries, in microseconds; the clock's own is taken off.
struct Times {
  std::vector<double> us;

  template <class Work>
  void add(const Work& work) {
    const double overhead_us = clock_reading_us();
    const double begin_us = processor_time_us();
    work();
    us.push_back(std::max(processor_time_us() - begin_us - overhead_us, 0.0));
  }
  [[nodiscard]] double mean() const {
    double sum = 0;
    for (const double t : us) sum += t;
    return us.empty() ? 0.0 : sum / static_cast<double>(us.size());
  }
  /// The one that a share of all, 0..1, stays under.
  [[nodiscard]] double at(double share) const {
    if (us.empty()) return 0;
    std::vector<double> sorted = us;
    std::sort(sorted.begin(), sorted.end());
    return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
  }
};

}  // namespace floornav
