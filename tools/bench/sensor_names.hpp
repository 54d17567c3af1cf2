#pragma once

#include "tools/simulator/sensor_spec.hpp"

namespace floornav {

/// As printed.
inline const char* name_of(SensorKind sensor) {
  return sensor == SensorKind::kKinect ? "kinect" : "bumblebee";
}
inline const char* noise_name(bool correlated) {
  return correlated ? "correlated" : "independent";
}

}  // namespace floornav
