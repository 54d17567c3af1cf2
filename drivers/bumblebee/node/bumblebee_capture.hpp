#pragma once

#include <functional>
#include <memory>
#include <string>

#include "drivers/bumblebee/node/stereo_frame.hpp"
#include "drivers/bumblebee/settings.hpp"
#include "drivers/camera/node/capture.hpp"

namespace floornav {

/// Captures a stereo camera's frames on a thread of its own and holds the newest one: matching may take
/// longer than a frame, and old frames are worth nothing.
std::unique_ptr<FrameSource<StereoFrame>> capture_bumblebee(const BumblebeeSettings& settings,
                                                            std::unique_ptr<Device<StereoFrame>> camera,
                                                            std::function<void(const std::string&)> tell);

}  // namespace floornav
