#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
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
#include "floornav/health_t.hpp"
#include "floornav/image_t.hpp"
#include "runtime/process/live_executor.hpp"
#include "tests/devices/kinect/room_scene.hpp"
#include "tests/devices/kinect/virtual_kinect.hpp"
#include "tests/tools/temporary_folder.hpp"

namespace floornav {

/// A bus that only remembers what was published, and when.
class RememberingBus final : public Transport {
 public:
  using Clock = std::chrono::steady_clock;
  struct Cloud {
    depth_cloud_t message;
    Clock::time_point sent;
  };

  void subscribe(const std::string&) override {}
  bool publish(const EncodedMessage& message) override;
  void receive(std::chrono::milliseconds timeout, const Receiver&) override;

  [[nodiscard]] std::deque<Cloud> clouds() const;
  [[nodiscard]] std::vector<image_t> images() const;
  [[nodiscard]] std::optional<health_t> health() const;
  void forget_clouds();
  /// True as soon as `holds` is, looked at after each message; false after the time-out.
  bool wait_for(const std::function<bool(const std::deque<Cloud>&, const health_t&)>& holds,
                std::chrono::milliseconds timeout);

 private:
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Cloud> clouds_;
  std::vector<image_t> images_;
  health_t health_{};
};

/// Largest difference of a cloud's depths from the room's, m, over the pixels without the room's noise.
/// `skip`: the room's pixels per pixel.
double worst_error_m(const depth_cloud_t& cloud, const RoomScene& room, int skip = 1);

/// A test fails where `frame` does not count the exposures between two clouds of one connection, lost ones
/// included: holds however late the machine runs the driver.
void expect_frames_count_exposures(const std::deque<RememberingBus::Cloud>& clouds, int period_us);

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
