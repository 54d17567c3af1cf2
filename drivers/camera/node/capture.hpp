#pragma once

#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <utility>

#include "drivers/camera/node/capture_loop.hpp"

namespace floornav {

/// Runs a device on a thread of its own, since its library may take its time or not come back at all.
template <class Frame>
class Capture : public FrameSource<Frame> {
 public:
  /// Starts at once. `waiting` and `tell` as in CaptureLoop; `tell` is called on the capture's thread.
  Capture(std::unique_ptr<Device<Frame>> device, Connection::Periods periods, std::size_t waiting,
          std::function<void(const std::string&)> tell)
      : loop_(std::make_shared<CaptureLoop<Frame>>(std::move(device), periods, waiting, std::move(tell))),
        thread_([loop = loop_] { loop->run(); }) {}
  /// Ends within half a second. A call into the library that does not come back is left behind with its
  /// thread; the process should then end without running the library's destructors.
  ~Capture() override {
    constexpr std::chrono::milliseconds kPatience(400);
    if (loop_->stop(kPatience))
      thread_.join();
    else
      thread_.detach();
  }
  Capture(const Capture&) = delete;
  Capture& operator=(const Capture&) = delete;

  bool take(Frame& frame) override { return loop_->take(frame); }
  [[nodiscard]] CaptureStatus status() const override { return loop_->status(); }
  void notify(std::function<void()> arrived) override { loop_->notify(std::move(arrived)); }

 private:
  std::shared_ptr<CaptureLoop<Frame>> loop_;
  std::thread thread_;
};

}  // namespace floornav
