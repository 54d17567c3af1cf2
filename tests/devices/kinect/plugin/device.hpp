#pragma once

#include <array>
#include <vector>

#include "tests/devices/kinect/control_block.hpp"
#include "tests/devices/kinect/plugin/openni_driver_api.hpp"
#include "tests/devices/kinect/plugin/scene.hpp"

namespace floornav {

/// One open virtual Kinect: a depth and a colour sensor, registration, a serial number.
class Device final : public oni::driver::DeviceBase {
 public:
  /// Its serial number is VK000n for device n. Throws std::runtime_error where the scene cannot be read.
  Device(int number, ControlBlock& control);

  OniStatus getSensorInfoList(OniSensorInfo** sensors, int* count) override;
  oni::driver::StreamBase* createStream(OniSensorType type) override;
  void destroyStream(oni::driver::StreamBase* stream) override;
  OniBool isPropertySupported(int id) override;
  OniStatus getProperty(int id, void* data, int* size) override;
  OniStatus setProperty(int id, const void* data, int size) override;
  OniBool isImageRegistrationModeSupported(OniImageRegistrationMode mode) override;

 private:
  const int number_;
  ControlBlock& control_;
  Scene scene_;
  std::vector<OniVideoMode> depth_modes_;
  std::vector<OniVideoMode> color_modes_;
  std::array<OniSensorInfo, 2> sensors_;
};

}  // namespace floornav
