#pragma once

#include <cstdint>
#include <string>

#include <dc1394/dc1394.h>

#include "drivers/bumblebee/node/stereo_frame.hpp"
#include "drivers/bumblebee/settings.hpp"

namespace floornav {

/// Throws DeviceError where libdc1394 failed at `what`.
void check(dc1394error_t error, const std::string& what);

/// The registers of an open camera: what it is, and how it shall stream.
class CameraControl {
 public:
  /// Both must outlive it.
  CameraControl(dc1394camera_t& camera, const BumblebeeSettings& settings)
      : camera_(camera), settings_(settings) {}

  /// Sets the camera up for its stream, which does not run yet. Throws DeviceError, or std::runtime_error
  /// for settings or a calibration that make no sense.
  [[nodiscard]] StereoStream prepare() const;
  /// The text that it stores of its calibration. Throws DeviceError.
  [[nodiscard]] std::string stored_calibration() const;

 private:
  [[nodiscard]] std::uint32_t read(std::uint32_t address, const char* what) const;
  void write(std::uint32_t address, std::uint32_t value, const char* what) const;
  [[nodiscard]] FrameLayout choose_layout() const;
  void add_pairs(StereoStream& stream) const;
  [[nodiscard]] int choose_speed() const;
  void choose_format(const FrameLayout& layout, int packet_bytes) const;
  void choose_exposure() const;
  void choose(dc1394feature_t feature, bool automatic, double value, const char* name) const;
  [[nodiscard]] bool offers_automatic(dc1394feature_t feature) const;
  [[nodiscard]] bool start_stamps() const;
  [[nodiscard]] std::int64_t exposure_us() const;

  dc1394camera_t& camera_;
  const BumblebeeSettings& settings_;
};

}  // namespace floornav
