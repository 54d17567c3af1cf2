#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

namespace floornav {

/// A frame that the virtual bus has delivered. Times on CLOCK_MONOTONIC, us.
struct DeliveredFrame {
  std::atomic<std::int64_t> exposure_us;  ///< middle of the exposure
  std::atomic<std::int64_t> raised_us;    ///< when its last packet was there
};

/// What the virtual bus in a driver's process shares with whoever commands it: a file that both map. A new
/// file is all zero, so 0 is the ordinary case everywhere.
struct FirewireControl {
  static constexpr std::size_t kLongestPath = 512;
  static constexpr std::size_t kRecords = 4096;

  char scene_path[kLongestPath];        ///< what the camera sees, and what kind of camera it is
  std::atomic<std::int64_t> origin_us;  ///< CLOCK_MONOTONIC of the scene's first frame; 0: not yet described

  // What kind of camera it is.
  std::atomic<std::int32_t> without_stamps;  ///< writes no timestamp and counter into its frames
  std::atomic<std::int32_t> without_calibration;
  std::atomic<std::int32_t> without_automatic_gain;
  std::atomic<std::int32_t> clock_ppm;  ///< the bus's clock runs so much too fast

  // Commands.
  std::atomic<std::int32_t> unplugged;         ///< the camera, while set
  std::atomic<std::int32_t> no_bus;            ///< no /dev/fw* at all, while set
  std::atomic<std::int32_t> stalled;           ///< takes every command, but sends nothing
  std::atomic<std::int32_t> drop;              ///< loses so many of the next frames
  std::atomic<std::int32_t> lose_packets;      ///< of the next frame: from there on frames begin late
  std::atomic<std::int32_t> black;             ///< every pixel 0 while set
  std::atomic<std::int32_t> frozen;            ///< the same image again and again while set
  std::atomic<std::int32_t> bus_resets;        ///< so many so far
  std::atomic<std::int32_t> reset_stops;       ///< a bus reset ends the camera's transmission
  std::atomic<std::int32_t> requests_hang;     ///< registers answer only when it is 0 again
  std::atomic<std::int32_t> bandwidth_taken;   ///< the bus has none left
  std::atomic<std::int32_t> random_registers;  ///< every read gives random bits

  // What happened.
  std::atomic<std::int64_t> opened;     ///< captures that were started
  std::atomic<std::int64_t> raised;     ///< frames delivered
  std::atomic<std::int64_t> lost;       ///< frames that `drop` took
  std::atomic<std::int64_t> no_buffer;  ///< frames for which nothing was queued
  std::atomic<std::int32_t> shutter;    ///< the camera's register, us
  std::atomic<std::int32_t> gain;       ///< the same, 0.01 dB
  std::atomic<std::int32_t> automatic;  ///< features that the camera chooses itself: bit n for number n
  std::atomic<std::int32_t> packet_bytes;
  std::array<DeliveredFrame, kRecords> records;  ///< of step n: records[n % kRecords]
};

static_assert(std::atomic<std::int64_t>::is_always_lock_free, "shared between processes");

/// Names the file with the control block in the environment of the driver's process. Without it no virtual
/// bus is there.
inline constexpr const char* kFirewireVariable = "FLOORNAV_VIRTUAL_FIREWIRE";

}  // namespace floornav
