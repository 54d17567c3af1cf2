#pragma once

#include <chrono>
#include <stdexcept>
#include <string>

namespace floornav {

/// What a device cannot do, in one line.
class DeviceError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What a library says after waiting for a frame.
enum class DeviceEvent { kFrame, kNothing, kGone };

/// A camera behind its library, as CaptureLoop runs it: all calls come from one thread and may take their
/// time. `Frame` has a member dropped_before.
template <class Frame>
class Device {
 public:
  virtual ~Device() = default;
  /// True where the device that open() would take is there.
  virtual bool listed() = 0;
  /// Opens the device, starts its stream and returns its name for a person. Throws DeviceError; then nothing
  /// is open.
  virtual std::string open_stream() = 0;
  /// Waits for a frame of the open stream.
  virtual DeviceEvent wait(std::chrono::milliseconds timeout) = 0;
  /// Copies the frame that wait() told of, using the memory of `frame` again; its dropped_before becomes the
  /// number of frames that the device itself passed over for it. Why it cannot be used, or nullptr.
  virtual const char* fetch(Frame& frame) = 0;
  virtual void close() = 0;
  /// Starts the library again, so that it looks for devices. Throws DeviceError.
  virtual void restart() = 0;
  /// Why listed() is false, in one line for a person.
  virtual std::string absence() = 0;
};

}  // namespace floornav
