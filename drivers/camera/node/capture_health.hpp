#pragma once

#include "drivers/camera/frame_content.hpp"
#include "drivers/camera/node/frame_source.hpp"
#include "floornav/health_t.hpp"
#include "runtime/process/time.hpp"

namespace floornav {

/// A call into a library that takes longer does not come back.
inline constexpr std::int64_t kHopeless_us = 10'000'000;

/// What a camera's node knows of its frames.
struct FrameHealth {
  FrameContent::Verdict verdict = FrameContent::Verdict::kGood;  ///< on the last frame
  std::int64_t lost = 0;                                         ///< by the device
  std::int64_t withheld = 0;                                     ///< stuck, not published
  Micros last_loss{0};                                           ///< 0: never
};

/// Adds a device's state, its frames' and the drops by cause to HEALTH. `library`: whose calls are made.
/// `sparse`: what a person should ask where few pixels measure anything.
void report_capture(health_t& health, const CaptureStatus& status, const FrameHealth& frames, Micros now,
                    const char* library, const char* sparse);

}  // namespace floornav
