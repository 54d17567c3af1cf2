#pragma once

#include <cstdint>

namespace floornav {

/// Of so many frames, the one that is seen at step n = 0, 1, 2 ... of a camera: over and over, or to the end
/// and back to the beginning.
inline std::int64_t scene_frame_at(std::int64_t step, std::int64_t frames, bool there_and_back) {
  if (!there_and_back || frames < 2) return step % frames;
  const std::int64_t cycle = 2 * (frames - 1);
  const std::int64_t phase = step % cycle;
  return phase < frames ? phase : cycle - phase;
}

}  // namespace floornav
