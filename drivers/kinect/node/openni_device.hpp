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
  kByHand,      ///< each wait() gives the next frame at once; kGone after the last one, or where none comes
};

struct OpenNiOptions {
  Playback playback = Playback::kInRealTime;
  std::string
      record;  ///< .oni file to record depth to; opened anew, the device goes on in FILE-2.oni and so on
};

/// Any depth camera that OpenNI2 has a driver for, or an .oni file. One at a time: OpenNI2 is global.
class OpenNiDevice final : public DepthDevice {
 public:
  /// Throws DeviceError where OpenNI2 does not start.
  explicit OpenNiDevice(const KinectSettings& settings, OpenNiOptions options = {});
  ~OpenNiDevice() override;
  OpenNiDevice(const OpenNiDevice&) = delete;
  OpenNiDevice& operator=(const OpenNiDevice&) = delete;

  bool listed() override;
  DepthStream open() override;
  Event wait(std::chrono::milliseconds timeout) override;
  DeviceFrame frame() override;
  HostTime arrival() override { return arrival_; }
  bool take_color(ColorImage& image) override;
  void close() override;
  void restart() override;
  std::string absence() override;
  /// Depth frames of the open .oni file; 0 for a device.
  [[nodiscard]] int frames_in_file() const { return frames_in_file_; }
  /// One line a device that OpenNI2 knows of: URI, name, serial number.
  [[nodiscard]] static std::vector<std::string> list();

 private:
  class Disconnected;

  void start_library();
  void stop_library();
  [[nodiscard]] bool is_file() const;
  [[nodiscard]] static std::vector<std::string> uris();
  void open_device();
  bool open_if_serial(const std::string& uri);
  void choose_mode();
  void start_color();
  void set_registration();
  [[nodiscard]] DepthStream describe();
  [[nodiscard]] Calibration calibration_of(const openni::VideoMode& mode);
  void play_file();
  void rest_player();
  void record();

  KinectSettings settings_;
  OpenNiOptions options_;
  openni::Device device_;
  openni::VideoStream depth_;
  openni::VideoStream color_;
  openni::VideoFrameRef frame_;
  openni::Recorder recorder_;
  int recordings_ = 0;
  HostTime arrival_;
  int frames_in_file_ = 0;
  int frames_left_ = 0;  ///< of a file played by hand
  std::unique_ptr<Disconnected> disconnected_;
};

}  // namespace floornav
