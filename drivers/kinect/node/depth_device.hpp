#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "drivers/camera/device_clock.hpp"
#include "drivers/camera/node/device.hpp"
#include "drivers/kinect/color_image.hpp"
#include "drivers/kinect/device_frame.hpp"
#include "drivers/kinect/lens.hpp"
#include "runtime/geometry/pinhole.hpp"

namespace floornav {

/// The depth stream of an open device.
struct DepthStream {
  std::string device;  ///< for a person: name, URI, mode
  FrameShape shape;
  Pinhole camera;               ///< of the image after mirroring and distortion are undone
  Distortion distortion{};      ///< of the image as it comes, mirroring undone
  float count_m = 0.001F;       ///< depth of one count
  std::int64_t period_us = 0;   ///< between frames
  bool counts_by_clock = true;  ///< gaps in its stamps are lost frames; not so in a file
};

/// A depth camera behind its library. All calls come from one thread and may take their time.
class DepthDevice {
 public:
  using Event = DeviceEvent;

  virtual ~DepthDevice() = default;
  /// True where the device that open() would take is there.
  virtual bool listed() = 0;
  /// Opens the device and starts its depth stream. Throws DeviceError; then nothing is open.
  virtual DepthStream open() = 0;
  /// Waits for a frame of the open stream.
  virtual Event wait(std::chrono::milliseconds timeout) = 0;
  /// The frame that wait() told of, and when it came; valid until the next call.
  virtual DeviceFrame frame() = 0;
  virtual HostTime arrival() = 0;
  /// The newest colour image, where colour is on and one has come since the last call.
  virtual bool take_color(ColorImage& /*image*/) { return false; }
  virtual void close() = 0;
  /// Starts the library again, so that it looks for devices.
  virtual void restart() = 0;
  /// Why listed() is false, in one line for a person.
  virtual std::string absence() = 0;
};

}  // namespace floornav
