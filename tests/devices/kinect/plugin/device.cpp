#include "tests/devices/kinect/plugin/device.hpp"

#include <cstdio>

#include "tests/devices/kinect/plugin/stream.hpp"

namespace floornav {

Device::Device(int number, ControlBlock& control)
    : number_(number),
      control_(control),
      scene_(control.scene_path),
      depth_modes_(Stream::modes_of(ONI_SENSOR_DEPTH, scene_)),
      color_modes_(Stream::modes_of(ONI_SENSOR_COLOR, scene_)),
      sensors_{{{ONI_SENSOR_DEPTH, static_cast<int>(depth_modes_.size()), depth_modes_.data()},
                {ONI_SENSOR_COLOR, static_cast<int>(color_modes_.size()), color_modes_.data()}}} {}

OniStatus Device::getSensorInfoList(OniSensorInfo** sensors, int* count) {
  *sensors = sensors_.data();
  *count = static_cast<int>(sensors_.size());
  return ONI_STATUS_OK;
}

oni::driver::StreamBase* Device::createStream(OniSensorType type) {
  if (type != ONI_SENSOR_DEPTH && type != ONI_SENSOR_COLOR) return nullptr;
  return new Stream(type, number_, scene_, control_);
}

void Device::destroyStream(oni::driver::StreamBase* stream) {
  delete stream;
}

OniBool Device::isPropertySupported(int id) {
  return id == ONI_DEVICE_PROPERTY_DRIVER_VERSION || id == ONI_DEVICE_PROPERTY_SERIAL_NUMBER ||
         id == ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION;
}

OniStatus Device::getProperty(int id, void* data, int* size) {
  switch (id) {
    case ONI_DEVICE_PROPERTY_DRIVER_VERSION:
      return answer(OniVersion{1, 0, 0, 0}, data, size);
    case ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION:
      return answer(
          control_.registered != 0 ? ONI_IMAGE_REGISTRATION_DEPTH_TO_COLOR : ONI_IMAGE_REGISTRATION_OFF, data,
          size);
    case ONI_DEVICE_PROPERTY_SERIAL_NUMBER: {
      std::array<char, 8> serial{};
      std::snprintf(serial.data(), serial.size(), "VK%04d", number_);
      return answer(serial, data, size);
    }
    default:
      return ONI_STATUS_NOT_SUPPORTED;
  }
}

OniStatus Device::setProperty(int id, const void* data, int size) {
  if (id != ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION) return ONI_STATUS_NOT_SUPPORTED;
  OniImageRegistrationMode wanted = ONI_IMAGE_REGISTRATION_OFF;
  const OniStatus status = take(wanted, data, size);
  if (status == ONI_STATUS_OK) control_.registered = wanted == ONI_IMAGE_REGISTRATION_OFF ? 0 : 1;
  return status;
}

OniBool Device::isImageRegistrationModeSupported(OniImageRegistrationMode mode) {
  return mode == ONI_IMAGE_REGISTRATION_OFF || mode == ONI_IMAGE_REGISTRATION_DEPTH_TO_COLOR;
}

}  // namespace floornav
