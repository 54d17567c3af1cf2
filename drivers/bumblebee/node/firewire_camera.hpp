#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <dc1394/dc1394.h>

#include "drivers/bumblebee/frame_stamp.hpp"
#include "drivers/bumblebee/node/stereo_frame.hpp"
#include "drivers/bumblebee/settings.hpp"
#include "drivers/camera/node/device.hpp"

namespace floornav {

/// A Bumblebee2 or XB3 behind libdc1394.
class FirewireCamera final : public Device<StereoFrame> {
 public:
  explicit FirewireCamera(const BumblebeeSettings& settings);
  ~FirewireCamera() override;
  FirewireCamera(const FirewireCamera&) = delete;
  FirewireCamera& operator=(const FirewireCamera&) = delete;

  bool listed() override;
  std::string open_stream() override;
  DeviceEvent wait(std::chrono::milliseconds timeout) override;
  const char* fetch(StereoFrame& frame) override;
  void close() override;
  void restart() override;
  std::string absence() override;

  /// One line a camera on the bus: GUID, vendor, model.
  [[nodiscard]] std::vector<std::string> list();
  /// The text that a camera stores of its calibration. Throws DeviceError.
  [[nodiscard]] std::string stored_calibration();

 private:
  struct CloseLibrary {
    void operator()(dc1394_t* library) const { dc1394_free(library); }
  };
  struct CloseCamera {
    void operator()(dc1394camera_t* camera) const { dc1394_camera_free(camera); }
  };

  [[nodiscard]] std::vector<std::uint64_t> guids();
  void open_camera();
  void start(const StereoStream& stream);
  bool dequeue_newest();
  void give_back(dc1394video_frame_t* frame);
  void release_ring();

  BumblebeeSettings settings_;
  std::unique_ptr<dc1394_t, CloseLibrary> library_;
  std::unique_ptr<dc1394camera_t, CloseCamera> camera_;
  std::shared_ptr<const StereoStream> stream_;
  std::chrono::steady_clock::time_point looked_;  ///< for cameras
  bool listed_ = false;

  int ring_fd_ = -1;              ///< of the running capture
  std::uint8_t* ring_ = nullptr;  ///< its memory, once a frame has told
  std::size_t ring_bytes_ = 0;
  dc1394video_frame_t* newest_ = nullptr;  ///< dequeued
  HostTime arrival_;
  std::int64_t passed_over_ = 0;  ///< older frames since the last that was fetched
  CycleClock clock_;
  std::int64_t number_ = 0;  ///< of the last frame
  bool in_step_ = false;     ///< the last stamp made sense
  int out_of_step_ = 0;      ///< frames in a row
};

}  // namespace floornav
