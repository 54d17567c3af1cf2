#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "drivers/bumblebee/node/bumblebee_node.hpp"
#include "drivers/bumblebee/settings.hpp"
#include "runtime/process/live_executor.hpp"
#include "tests/devices/firewire/virtual_bumblebee.hpp"
#include "tests/drivers/remembering_bus.hpp"
#include "tests/tools/temporary_folder.hpp"
#include "tools/simulator/stereo/stereo_rig.hpp"

namespace floornav {

/// What the virtual camera sees in the tests: floor, a wall across, a box and a post.
Shapes test_room();
/// Where it stands: 0.72 m high, 20 degrees down.
Pose test_mounting();

/// The bus of this process's virtual camera. A process has one bus, so its rigs all see the same camera.
class BumblebeeRig {
 public:
  /// A Bumblebee2, or an XB3.
  explicit BumblebeeRig(const StereoRigSpec& spec = bumblebee2_rig());
  ~BumblebeeRig();

  /// Before start().
  BumblebeeSettings settings;
  VirtualBumblebee& camera() { return *camera_; }
  [[nodiscard]] const StereoRig& rig() const { return rig_; }
  RememberingBus bus;

  void start();
  void stop();

  bool wait_for_clouds(std::size_t count);
  bool wait_for_state(std::int8_t state, const std::string& reason_part);
  [[nodiscard]] CaptureStatus status() const { return source_->status(); }
  [[nodiscard]] std::vector<std::string> lines() const;

 private:
  TemporaryFolder folder_;
  StereoRig rig_;
  std::unique_ptr<VirtualBumblebee> camera_;
  mutable std::mutex lines_mutex_;
  std::vector<std::string> lines_;
  Serial serial_;
  std::unique_ptr<BumblebeeNode> node_;
  FrameSource<StereoFrame>* source_ = nullptr;  ///< the node's
  std::unique_ptr<LiveExecutor> executor_;
  std::atomic<bool> stopping_ = false;
  std::thread thread_;
};

}  // namespace floornav
