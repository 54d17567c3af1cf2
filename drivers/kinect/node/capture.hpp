#pragma once

#include <functional>
#include <memory>
#include <string>
#include <thread>

#include "drivers/kinect/node/capture_loop.hpp"
#include "drivers/kinect/node/frame_source.hpp"

namespace floornav {

/// Runs a device on a thread of its own, since its library may take its time or not come back at all.
class Capture final : public FrameSource {
 public:
  /// Starts at once. `tell` as in CaptureLoop, on the capture's thread.
  Capture(std::unique_ptr<DepthDevice> device, Connection::Periods periods,
          std::function<void(const std::string&)> tell);
  /// Ends within half a second. A call into the library that does not come back is left behind with its
  /// thread; the process should then end without running the library's destructors.
  ~Capture() override;
  Capture(const Capture&) = delete;
  Capture& operator=(const Capture&) = delete;

  bool take(CapturedFrame& frame) override { return loop_->take(frame); }
  [[nodiscard]] CaptureStatus status() const override { return loop_->status(); }
  void notify(std::function<void()> arrived) override { loop_->notify(std::move(arrived)); }

 private:
  std::shared_ptr<CaptureLoop> loop_;
  std::thread thread_;
};

}  // namespace floornav
