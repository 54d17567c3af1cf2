#pragma once

#include <string>

#include "drivers/camera/mounting.hpp"
#include "runtime/geometry/settings.hpp"

namespace floornav {

/// A Kinect, or any depth camera that OpenNI2 opens.
struct KinectSettings {
  std::string name = "kinect";  ///< source of its messages; each of several needs its own
  std::string device;           ///< URI, serial number or .oni file; empty: the first one that is there
  std::string channel = "KINECT_CLOUD";
  int width = 640;   ///< px
  int height = 480;  ///< px
  int frames_per_second = 30;
  int depth_unit_um = 1000;   ///< of a depth count: 1000, or 100 (to 6.5 m) where the device offers it
  bool registration = false;  ///< depth as the colour camera would see it
  bool color = false;         ///< publish colour images too
  std::string color_channel = "KINECT_IMAGE";
  int jpeg_quality = 85;      ///< of colour images, 1 to 100
  std::string calibration;    ///< YAML file of the depth camera; empty: from the device's field of view
  double baseline_m = 0.075;  ///< projector to camera
  double depth_sigma_at_3m_m = 0.014;    ///< eq. (3)
  double exposure_to_arrival_ms = 33.0;  ///< from mid-exposure to the arrival of a frame that nothing held up
  int silence_ms = 500;                  ///< without a frame: the device is closed and opened again
  int first_frame_ms = 2000;             ///< the same after opening: a device takes its time to start
  int retry_ms = 1000;                   ///< between two attempts to find and open it
  double least_valid = 0.2;              ///< share of pixels with a depth under which a frame is reported
  int stuck_after = 5;  ///< equal images in a row: the device hangs, nothing more is published; 0: never
  MountingSettings mounting;
};

template <class Visitor>
void visit_settings(Visitor& visit, KinectSettings& s) {
  visit("name", s.name);
  visit("device", s.device);
  visit("channel", s.channel);
  visit("width", s.width, Allowed{16, 4096});
  visit("height", s.height, Allowed{16, 4096});
  visit("frames_per_second", s.frames_per_second, Allowed{1, 120});
  visit("depth_unit_um", s.depth_unit_um, Allowed{100, 1000});
  visit("registration", s.registration);
  visit("color", s.color);
  visit("color_channel", s.color_channel);
  visit("jpeg_quality", s.jpeg_quality, Allowed{1, 100});
  visit("calibration", s.calibration);
  visit("baseline_m", s.baseline_m, Allowed{0.001, 1.0});
  visit("depth_sigma_at_3m_m", s.depth_sigma_at_3m_m, Allowed{0.0001, 1.0});
  visit("exposure_to_arrival_ms", s.exposure_to_arrival_ms, Allowed{0.0, 1000.0});
  visit("silence_ms", s.silence_ms, Allowed{50, 60'000});
  visit("first_frame_ms", s.first_frame_ms, Allowed{50, 60'000});
  visit("retry_ms", s.retry_ms, Allowed{50, 60'000});
  visit("least_valid", s.least_valid, Allowed{0.0, 1.0});
  visit("stuck_after", s.stuck_after, Allowed{0, 1000});
  visit("mounting", s.mounting);
}

}  // namespace floornav
