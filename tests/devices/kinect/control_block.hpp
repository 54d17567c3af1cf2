#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

namespace floornav {

/// A frame of the virtual Kinect that reached OpenNI2. Times on CLOCK_MONOTONIC, us.
struct RaisedFrame {
  std::atomic<std::int64_t> exposure_us;  ///< middle of the exposure
  std::atomic<std::int64_t> raised_us;    ///< when the whole of it was handed to OpenNI2
};

/// What the virtual Kinect in a driver's process shares with whoever commands it: a file that both map. A new
/// file is all zero, so 0 is the ordinary case everywhere.
struct ControlBlock {
  static constexpr std::size_t kLongestPath = 512;
  static constexpr std::size_t kRecords = 8192;

  char scene_path[kLongestPath];  ///< scene file that it sees
  std::atomic<std::int64_t>
      origin_us;  ///< CLOCK_MONOTONIC of the scene's first frame; exposures keep its step

  // What kind of device it is.
  std::atomic<std::int32_t> devices;  ///< beside the first one
  std::atomic<std::int32_t>
      without_hotplug;  ///< as OpenNI2-FreenectDriver: nothing is told when it is plugged
                        ///< or unplugged, and no device can be opened a second time
  std::atomic<std::int32_t> index_hides_lost;  ///< frameIndex counts delivered frames only
  std::atomic<std::int32_t> only_mirrored;     ///< mirrors always and says so
  std::atomic<std::int32_t> transfer_us;       ///< from mid-exposure to the whole frame's arrival
  std::atomic<std::int32_t> jitter_us;         ///< up to so much later
  std::atomic<std::int32_t> clock_ppm;         ///< its clock runs so much too fast
  std::atomic<std::int32_t> clock_60_mhz;      ///< timestamps are raw: 60 MHz, 32 bits
  std::atomic<std::int64_t> clock_start_us;    ///< its clock's reading at CLOCK_MONOTONIC 0

  // Commands. Device n is bit n of a mask.
  std::atomic<std::uint32_t> unplugged;       ///< mask
  std::atomic<std::int32_t> unplug_in_frame;  ///< 1: unplugs device 0 when half of the next frame is through
  std::atomic<std::int32_t> stalled;          ///< opens and starts, but sends nothing
  std::atomic<std::int32_t> drop;             ///< loses so many of the next frames
  std::atomic<std::int32_t> cut_short;        ///< delivers half of each of so many next frames
  std::atomic<std::int32_t> wrong_size;       ///< delivers so many next frames that claim another width
  std::atomic<std::int32_t> garbage;          ///< fills so many next frames with random bytes
  std::atomic<std::int32_t> black;            ///< every pixel 0 while set
  std::atomic<std::int32_t> frozen;           ///< the same image again and again while set
  std::atomic<std::int32_t> open_hangs;       ///< opening does not come back while set
  std::atomic<std::int32_t> stop_hangs;       ///< stopping a stream does not come back while set

  // What happened.
  std::atomic<std::int32_t> registered;  ///< registration is switched on
  std::atomic<std::int64_t> opened;      ///< times a device was opened
  std::atomic<std::int64_t> raised;      ///< frames handed to OpenNI2
  std::atomic<std::int64_t> lost;        ///< frames that `drop` took
  std::atomic<std::int64_t> last_raised_us;
  std::array<RaisedFrame, kRecords> records;  ///< of frame n: records[n % kRecords]
};

static_assert(std::atomic<std::int64_t>::is_always_lock_free, "shared between processes");

/// Names the file with the control block in the environment of the driver's process. Without it no virtual
/// Kinect is there.
inline constexpr const char* kControlVariable = "FLOORNAV_VIRTUAL_KINECT";

}  // namespace floornav
