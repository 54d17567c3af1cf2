#include "drivers/bumblebee/frame_stamp.hpp"

#include <algorithm>
#include <cmath>

namespace floornav {
namespace {

constexpr std::size_t kStampBytes = 8;
constexpr std::int64_t kTurn_us = 128'000'000;

std::uint32_t big_endian(std::span<const std::uint8_t> bytes) {
  return static_cast<std::uint32_t>(bytes[0]) << 24 | static_cast<std::uint32_t>(bytes[1]) << 16 |
         static_cast<std::uint32_t>(bytes[2]) << 8 | bytes[3];
}

std::int64_t us_of(std::uint32_t cycle_time) {
  const std::int64_t seconds = cycle_time >> 25;
  const std::int64_t cycles = cycle_time >> 12 & 0x1FFFU;
  const std::int64_t offset = cycle_time & 0xFFFU;
  return seconds * 1'000'000 + cycles * 125 + offset * 125 / 3072;
}

}  // namespace

FrameStamp take_stamp(std::span<std::uint8_t> frame) {
  if (frame.size() < 2 * kStampBytes) return {};
  const FrameStamp stamp{big_endian(frame.first(4)), big_endian(frame.subspan(4, 4))};
  std::copy_n(frame.begin() + kStampBytes, kStampBytes, frame.begin());
  return stamp;
}

std::uint64_t CycleClock::us(std::uint32_t cycle_time, std::int64_t arrival_us) {
  const std::int64_t phase = us_of(cycle_time) % kTurn_us;
  if (!started_) {
    started_ = true;
    last_us_ = phase;
  } else {
    const std::int64_t expected = last_us_ + std::max<std::int64_t>(0, arrival_us - last_arrival_us_);
    const auto turns = std::llround(static_cast<double>(expected - phase) / static_cast<double>(kTurn_us));
    last_us_ = phase + turns * kTurn_us;
  }
  last_arrival_us_ = arrival_us;
  return static_cast<std::uint64_t>(std::max<std::int64_t>(0, last_us_));
}

}  // namespace floornav
