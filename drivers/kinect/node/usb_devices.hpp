#pragma once

#include <filesystem>
#include <string>

namespace floornav {

/// Where Linux lists what is plugged in.
inline const std::filesystem::path kUsbDevices = "/sys/bus/usb/devices";

/// Where a Kinect or one of its kin is plugged in: one line that says so and what is missing. Empty where
/// none is.
std::string usb_camera_hint(const std::filesystem::path& usb_devices);

}  // namespace floornav
