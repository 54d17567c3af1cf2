#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>

namespace floornav {

/// How a device is.
struct CaptureStatus {
  std::string trouble = "starting";           ///< why no frames come, for a person; empty: they come
  const char* doing = nullptr;                ///< the call into the library that is going on
  std::int64_t doing_us = 0;                  ///< for how long
  std::int64_t opened = 0;                    ///< times that the device was opened
  std::map<std::string, std::int64_t> drops;  ///< frames that came, but could not be used or waited too long
};

/// Where a node's frames come from.
template <class Frame>
class FrameSource {
 public:
  virtual ~FrameSource() = default;
  /// Swaps the next frame into `frame`, whose memory is used again. False where none has come since the last
  /// call.
  virtual bool take(Frame& frame) = 0;
  [[nodiscard]] virtual CaptureStatus status() const = 0;
  /// `arrived` is called on any thread after each frame; empty: no more.
  virtual void notify(std::function<void()> arrived) = 0;
};

}  // namespace floornav
