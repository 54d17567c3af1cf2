#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "drivers/camera/node/capture.hpp"
#include "drivers/kinect/node/captured_frame.hpp"
#include "drivers/kinect/settings.hpp"

namespace floornav {

/// When a device is given up and tried again.
Connection::Periods periods_of(const KinectSettings& settings);

/// Captures a depth camera's frames on a thread of its own; holds enough of them for whoever takes them to be
/// late by a tenth of a second.
class KinectCapture final : public Capture<CapturedFrame> {
 public:
  /// Starts at once. `tell` is called with a line for a person when the device comes or goes.
  KinectCapture(std::unique_ptr<DepthDevice> device, Connection::Periods periods,
                std::function<void(const std::string&)> tell);
};

}  // namespace floornav
