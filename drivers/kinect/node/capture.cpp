#include "drivers/kinect/node/capture.hpp"

#include <utility>

namespace floornav {

Capture::Capture(std::unique_ptr<DepthDevice> device, Connection::Periods periods,
                 std::function<void(const std::string&)> tell)
    : loop_(std::make_shared<CaptureLoop>(std::move(device), periods, std::move(tell))),
      thread_([loop = loop_] { loop->run(); }) {}

Capture::~Capture() {
  constexpr std::chrono::milliseconds kPatience(400);
  if (loop_->stop(kPatience))
    thread_.join();
  else
    thread_.detach();
}

}  // namespace floornav
