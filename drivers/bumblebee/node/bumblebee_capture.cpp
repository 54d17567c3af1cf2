#include "drivers/bumblebee/node/bumblebee_capture.hpp"

#include <utility>

namespace floornav {

std::unique_ptr<FrameSource<StereoFrame>> capture_bumblebee(const BumblebeeSettings& settings,
                                                            std::unique_ptr<Device<StereoFrame>> camera,
                                                            std::function<void(const std::string&)> tell) {
  constexpr std::int64_t kPerMs = 1000;
  constexpr std::size_t kWaiting = 1;
  const Connection::Periods periods{settings.silence_ms * kPerMs, settings.first_frame_ms * kPerMs,
                                    settings.retry_ms * kPerMs};
  return std::make_unique<Capture<StereoFrame>>(std::move(camera), periods, kWaiting, std::move(tell));
}

}  // namespace floornav
