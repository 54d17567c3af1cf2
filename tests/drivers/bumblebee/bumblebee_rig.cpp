#include "tests/drivers/bumblebee/bumblebee_rig.hpp"

#include <cstdlib>

#include <opencv2/core/utility.hpp>

#include "drivers/bumblebee/node/bumblebee_capture.hpp"
#include "drivers/bumblebee/node/firewire_camera.hpp"
#include "tests/devices/firewire/eye_scene_writer.hpp"
#include "tools/simulator/sensor_spec.hpp"

namespace floornav {
namespace {

constexpr auto kPatience = std::chrono::seconds(30);
constexpr int kPeriod_us = 20'000;

/// The bus opens its control file once in a process, so all rigs share one place for it.
const std::filesystem::path& shared_folder() {
  static const TemporaryFolder folder;
  return folder.path();
}

void write_scene(StereoRig& rig, const std::filesystem::path& file) {
  EyeSceneWriter writer(file, rig, kPeriod_us, false);
  const int frames = rig.spec().ideal.width > 640 ? 2 : 3;
  for (int frame = 0; frame < frames; ++frame) writer.add(rig.see(test_room(), test_mounting(), frame));
  writer.close();
}

}  // namespace

Shapes test_room() {
  Shapes room;
  room.blocks.push_back({{{4.1, 0}, {1, 0}, {0.1, 10}}, 0, 2.5, {0, 0}});
  room.blocks.push_back({{{2.2, 0.4}, {1, 0}, {0.2, 0.2}}, 0, 0.3, {0, 0}});
  room.cylinders.push_back({{1.9, -0.5}, 0.1, 0, 0.5});
  return room;
}

Pose test_mounting() {
  return mounted(0.0, 0.0, 0.72, 20.0);
}

BumblebeeRig::BumblebeeRig(const StereoRigSpec& spec) : rig_(spec, 1) {
  cv::setNumThreads(1);
  write_scene(rig_, folder_ / "eyes");
  camera_ = std::make_unique<VirtualBumblebee>(shared_folder() / "control", folder_ / "eyes");
  ::setenv(kFirewireVariable, camera_->control_file().c_str(), 1);
  const auto nobody = std::make_unique<FirewireCamera>(settings);
  while (!nobody->listed()) std::this_thread::sleep_for(std::chrono::milliseconds(2));
}

BumblebeeRig::~BumblebeeRig() {
  stop();
  camera_->unplug();
  const auto nobody = std::make_unique<FirewireCamera>(settings);
  while (nobody->listed()) std::this_thread::sleep_for(std::chrono::milliseconds(2));
}

void BumblebeeRig::start() {
  auto source =
      capture_bumblebee(settings, std::make_unique<FirewireCamera>(settings), [this](const auto& line) {
        const std::scoped_lock lock(lines_mutex_);
        lines_.push_back(line);
      });
  source_ = source.get();
  node_ = std::make_unique<BumblebeeNode>(settings, MatchedRegion{}, std::move(source), serial_, [] {});
  executor_ = std::make_unique<LiveExecutor>(*node_, bus, LiveOptions{});
  stopping_ = false;
  thread_ = std::thread([this] { executor_->run(stopping_); });
}

void BumblebeeRig::stop() {
  stopping_ = true;
  if (thread_.joinable()) thread_.join();
  executor_.reset();
  node_.reset();
}

bool BumblebeeRig::wait_for_clouds(std::size_t count) {
  return bus.wait_for_clouds(count, kPatience);
}

bool BumblebeeRig::wait_for_state(std::int8_t state, const std::string& reason_part) {
  return bus.wait_for_state(state, reason_part, kPatience);
}

std::vector<std::string> BumblebeeRig::lines() const {
  const std::scoped_lock lock(lines_mutex_);
  return lines_;
}

}  // namespace floornav
