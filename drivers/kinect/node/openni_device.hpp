#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include <OpenNI.h>

#include "drivers/kinect/node/calibration_file.hpp"
#include "drivers/kinect/node/depth_device.hpp"
#include "drivers/kinect/settings.hpp"

namespace floornav {

/// How an .oni file is played.
enum class Playback {
  kInRealTime,  ///< over and over
  kByHand,      ///< each wait() gives the next frame at once; kGone after the last one
};

/// Any depth camera that OpenNI2 has a driver for, or an .oni file. One at a time: OpenNI2 is global.
class OpenNiDevice final : public DepthDevice {
 public:
  /// Throws DeviceError where OpenNI2 does not start.
  explicit OpenNiDevice(const KinectSettings& settings, Playback playback = Playback::kInRealTime);
  ~OpenNiDevice() override;
  OpenNiDevice(const OpenNiDevice&) = delete;
  OpenNiDevice& operator=(const OpenNiDevice&) = delete;

  bool listed() override;
  DepthStream open() override;
  Event wait(std::chrono::milliseconds timeout) override;
  DeviceFrame frame() override;
  HostTime arrival() override { return arrival_; }
  void close() override;
  void restart() override;
  std::string absence() override;

 private:
  class Disconnected;

  void start_library();
  void stop_library();
  [[nodiscard]] bool is_file() const;
  [[nodiscard]] static std::vector<std::string> uris();
  void open_device();
  bool open_if_serial(const std::string& uri);
  void choose_mode();
  void set_registration();
  [[nodiscard]] DepthStream describe();
  [[nodiscard]] Calibration calibration_of(const openni::VideoMode& mode);
  void play_file();

  KinectSettings settings_;
  Playback playback_;
  openni::Device device_;
  openni::VideoStream depth_;
  openni::VideoFrameRef frame_;
  HostTime arrival_;
  int frames_left_ = 0;  ///< of a file played by hand
  std::unique_ptr<Disconnected> disconnected_;
};

}  // namespace floornav
