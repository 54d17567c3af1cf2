#pragma once

#include <string>

#include "drivers/bumblebee/stereo_matcher.hpp"
#include "drivers/camera/mounting.hpp"
#include "runtime/geometry/settings.hpp"

namespace floornav {

/// A Bumblebee2 or a Bumblebee XB3 on FireWire.
struct BumblebeeSettings {
  std::string name = "bumblebee";  ///< source of its messages; each of several needs its own
  std::string camera;              ///< GUID, 16 hexadecimal digits; empty: the first one that is there
  std::string channel = "BUMBLEBEE_CLOUD";
  std::string pair = "wide";  ///< of an XB3's eyes: wide (0.24 m), narrow (0.12 m) or both
  std::string narrow_channel = "BUMBLEBEE_NARROW_CLOUD";  ///< of the narrow pair's clouds where it is both
  bool half_size = false;          ///< clouds of half the width and height: less work, less to send
  double frames_per_second = 0.0;  ///< 0: 15 at 640x480, 7.5 above
  bool auto_exposure = true;       ///< the camera chooses the shutter, if it can
  double shutter_ms = 10.0;        ///< where it does not
  bool auto_gain = true;           ///< the camera chooses the gain, if it can
  double gain_db = 6.0;            ///< where it does not
  int iso_speed_mbps = 0;          ///< 100, 200, 400 or 800; 0: 800 where camera and bus can, else 400
  int packet_bytes = 0;     ///< larger ones bring a frame sooner, and more frames a second; 0: by the rate
  int buffers = 8;          ///< of the ring that the bus writes to, frames
  std::string calibration;  ///< OpenCV's YAML, BotParam or EuRoC files; empty: the one that the camera stores
  std::string calibration_block;        ///< the camera's name in a BotParam file
  double exposure_to_arrival_ms = 0.0;  ///< 0: half of the shutter's time and the packets' on the bus
  int silence_ms = 800;                 ///< without a frame: the camera is closed and opened again
  int first_frame_ms = 2000;            ///< the same after opening
  int retry_ms = 1000;                  ///< between two attempts to find and open it
  double least_valid = 0.2;             ///< share of matched pixels under which a frame is reported
  int stuck_after = 5;   ///< equal images in a row: the camera hangs, nothing more is published; 0: never
  bool only_roi = true;  ///< match only what perception's ROI can hold
  MountingSettings mounting;
  StereoSettings stereo;
};

template <class Visitor>
void visit_settings(Visitor& visit, BumblebeeSettings& s) {
  visit("name", s.name);
  visit("camera", s.camera);
  visit("channel", s.channel);
  visit("pair", s.pair, {"wide", "narrow", "both"});
  visit("narrow_channel", s.narrow_channel);
  visit("half_size", s.half_size);
  visit("frames_per_second", s.frames_per_second, Allowed{0.0, 60.0});
  visit("auto_exposure", s.auto_exposure);
  visit("shutter_ms", s.shutter_ms, Allowed{0.01, 1000.0});
  visit("auto_gain", s.auto_gain);
  visit("gain_db", s.gain_db, Allowed{-10.0, 40.0});
  visit("iso_speed_mbps", s.iso_speed_mbps, Allowed{0, 800});
  visit("packet_bytes", s.packet_bytes, Allowed{0, 8188});
  visit("buffers", s.buffers, Allowed{4, 64});
  visit("calibration", s.calibration);
  visit("calibration_block", s.calibration_block);
  visit("exposure_to_arrival_ms", s.exposure_to_arrival_ms, Allowed{0.0, 1000.0});
  visit("silence_ms", s.silence_ms, Allowed{50, 60'000});
  visit("first_frame_ms", s.first_frame_ms, Allowed{50, 60'000});
  visit("retry_ms", s.retry_ms, Allowed{50, 60'000});
  visit("least_valid", s.least_valid, Allowed{0.0, 1.0});
  visit("stuck_after", s.stuck_after, Allowed{0, 1000});
  visit("only_roi", s.only_roi);
  visit("mounting", s.mounting);
  visit("stereo", s.stereo);
}

}  // namespace floornav
