#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "drivers/kinect/node/kinect_capture.hpp"
#include "drivers/kinect/node/kinect_node.hpp"
#include "drivers/kinect/node/openni_device.hpp"
#include "floornav/depth_cloud_t.hpp"
#include "runtime/process/live_executor.hpp"
#include "tests/devices/kinect/room_scene.hpp"
#include "tests/devices/kinect/virtual_kinect.hpp"
#include "tests/drivers/remembering_bus.hpp"
#include "tests/tools/temporary_folder.hpp"

namespace floornav {

/// Largest difference of a cloud's depths from the room's, m, over the pixels without the room's noise.
/// `skip`: the room's pixels per pixel.
double worst_error_m(const depth_cloud_t& cloud, const RoomScene& room, int skip = 1);

/// The whole driver on the unmodified OpenNI2 with a virtual Kinect in it. One at a time.
class DriverRig {
 public:
  explicit DriverRig(const RoomScene& room = {});
  ~DriverRig();

  /// Before start().
  KinectSettings settings;
  VirtualKinect& kinect() { return *kinect_; }
  RememberingBus bus;

  void start();
  void stop();

  bool wait_for_clouds(std::size_t count, std::chrono::milliseconds timeout = std::chrono::seconds(20));
  bool wait_for_state(std::int8_t state, const std::string& reason_part,
                      std::chrono::milliseconds timeout = std::chrono::seconds(20));
  [[nodiscard]] bool gave_up() const { return gave_up_; }
  [[nodiscard]] CaptureStatus status() const { return capture_->status(); }
  [[nodiscard]] std::int64_t drops(const std::string& cause) const;
  [[nodiscard]] std::vector<std::string> lines() const;

 private:
  TemporaryFolder folder_;
  std::unique_ptr<VirtualKinect> kinect_;
  mutable std::mutex lines_mutex_;
  std::vector<std::string> lines_;
  std::unique_ptr<KinectNode> node_;
  KinectCapture* capture_ = nullptr;  ///< the node's
  std::atomic<bool> gave_up_ = false;
  std::unique_ptr<LiveExecutor> executor_;
  std::atomic<bool> stopping_ = false;
  std::thread thread_;
};

}  // namespace floornav
