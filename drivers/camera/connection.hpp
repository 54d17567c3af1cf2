#pragma once

#include <cstdint>

namespace floornav {

/// Decides when a device is opened, given up and looked for anew. Time is an argument, us on a monotonic
/// clock.
///
/// Some drivers tell when a device comes and goes. Others know only what was there when the library was
/// started and cannot open a device twice: there, silence is all that can be seen, and the library must be
/// started again.
class Connection {
 public:
  struct Periods {
    std::int64_t silence_us = 500'000;        ///< after a frame none came for so long: given up
    std::int64_t first_frame_us = 2'000'000;  ///< the same for the first frame after opening
    std::int64_t retry_us = 1'000'000;        ///< between two attempts
  };
  enum class Action {
    kNothing,
    kOpen,     ///< open the device, then tell opened() or failed()
    kClose,    ///< close it
    kRestart,  ///< start the library again
  };

  explicit Connection(Periods periods) : periods_(periods) {}

  /// What to do now. `listed`: the library knows of the device.
  Action next(std::int64_t now_us, bool listed);

  void opened(std::int64_t now_us);
  void failed(std::int64_t now_us);
  void frame(std::int64_t now_us);
  /// The library says that the open device is gone.
  void gone() { gone_ = open_; }

  [[nodiscard]] bool is_open() const { return open_; }
  /// Frames come.
  [[nodiscard]] bool is_streaming() const { return open_ && streaming_; }

 private:
  Action close(std::int64_t now_us);
  Action restart(std::int64_t now_us);

  Periods periods_;
  bool open_ = false;
  bool streaming_ = false;  ///< a frame has come since it was opened
  bool gone_ = false;
  bool library_tells_ = false;    ///< that devices come and go
  bool library_is_fresh_ = true;  ///< nothing was opened or failed since it was started
  std::int64_t alive_us_ = 0;     ///< opened, or last frame
  std::int64_t retry_us_ = 0;     ///< no new start of the library before
};

}  // namespace floornav
