#include "drivers/camera/device_clock.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

namespace floornav {
namespace {

/// How much too slow a camera's clock may be: crystals are good to 100 ppm.
constexpr double kSlowest = 300e-6;
/// Of the elapsed time that the offset may move to follow the least one.
constexpr double kFollow = 0.01;
/// Stamps and arrivals may disagree by so much from frame to frame: a busy host takes a while to look.
constexpr std::int64_t kMostDisagreement_us = 500'000;
/// So many frames in a row that all came so late: the way itself has become longer, or the clock is worse
/// than kSlowest.
constexpr int kManyFrames = 90;
constexpr double kLate_us = 10'000;

constexpr std::array<int, 2> kStampsPerUs = {1, 60};

/// Stamp minus an earlier one, where either has wrapped at 32 bits or none.
std::uint64_t stamp_difference(std::uint64_t stamp, std::uint64_t earlier) {
  constexpr std::uint64_t k32Bits = 0xFFFFFFFF;
  const bool wrapped = stamp < earlier && earlier <= k32Bits;
  return wrapped ? (stamp - earlier) & k32Bits : stamp - earlier;
}

}  // namespace

std::int64_t DeviceClock::utime_of(std::uint64_t stamp, HostTime arrival) {
  const std::optional<std::int64_t> elapsed = started_ ? elapsed_us(stamp, arrival) : std::nullopt;
  if (elapsed) {
    device_us_ += *elapsed;
    last_stamp_ = stamp;
    last_arrival_us_ = arrival.monotonic_us;
    follow(arrival.monotonic_us - device_us_, *elapsed);
  } else {
    start(stamp, arrival);
  }
  const std::int64_t exposure_us = device_us_ + std::llround(offset_us_) - shortest_way_us_;
  return last_utime_us_ = exposure_us + (arrival.utime_us - arrival.monotonic_us);
}

std::int64_t DeviceClock::utime_near_last(std::uint64_t stamp) const {
  const int per_us = std::max(1, stamps_per_us_);
  const auto ahead = static_cast<std::int64_t>(stamp_difference(stamp, last_stamp_));
  const auto behind = static_cast<std::int64_t>(stamp_difference(last_stamp_, stamp));
  const bool later = ahead >= 0 && (behind < 0 || ahead <= behind);
  return last_utime_us_ + (later ? ahead : -behind) / per_us;
}

void DeviceClock::start(std::uint64_t stamp, HostTime arrival) {
  if (started_) ++restarts_;
  started_ = true;
  stamps_per_us_ = 0;
  stamp_remainder_ = 0;
  last_stamp_ = stamp;
  last_arrival_us_ = arrival.monotonic_us;
  device_us_ = 0;
  late_frames_ = 0;
  least_offset_us_ = offset_us_ = static_cast<double>(arrival.monotonic_us);
}

/// Nothing where the stamps make no sense beside the arrivals.
std::optional<std::int64_t> DeviceClock::elapsed_us(std::uint64_t stamp, HostTime arrival) {
  const auto counts = static_cast<std::int64_t>(stamp_difference(stamp, last_stamp_));
  const std::int64_t between_arrivals = arrival.monotonic_us - last_arrival_us_;
  const auto disagreement = [&](int per_us) { return std::abs(counts / per_us - between_arrivals); };
  if (counts <= 0) return std::nullopt;
  if (stamps_per_us_ == 0) {
    const auto nearer = [&](int a, int b) { return disagreement(a) < disagreement(b); };
    stamps_per_us_ = *std::min_element(kStampsPerUs.begin(), kStampsPerUs.end(), nearer);
  }
  if (disagreement(stamps_per_us_) > kMostDisagreement_us) return std::nullopt;
  const std::int64_t all = counts + stamp_remainder_;
  stamp_remainder_ = all % stamps_per_us_;
  return all / stamps_per_us_;
}

void DeviceClock::follow(std::int64_t offset_now_us, std::int64_t elapsed_us) {
  const auto now = static_cast<double>(offset_now_us);
  const auto elapsed = static_cast<double>(elapsed_us);
  least_offset_us_ = std::min(least_offset_us_ + kSlowest * elapsed, now);
  late_frames_ = now > least_offset_us_ + kLate_us ? late_frames_ + 1 : 0;
  if (late_frames_ > kManyFrames) least_offset_us_ = now;
  const double most = kFollow * elapsed;
  offset_us_ += std::clamp(least_offset_us_ - offset_us_, -most, most);
}

}  // namespace floornav
