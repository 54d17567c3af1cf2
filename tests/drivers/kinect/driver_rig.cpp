#include "tests/drivers/kinect/driver_rig.hpp"

#include <cstdlib>

#include <unistd.h>

#include "lcmtypes/channels.hpp"

namespace floornav {

bool RecordingTransport::publish(const EncodedMessage& message) {
  {
    const std::scoped_lock lock(mutex_);
    const int size = static_cast<int>(message.bytes.size());
    if (message.channel == channel::kHealth) {
      if (health_.decode(message.bytes.data(), 0, size) != size) return false;
    } else {
      clouds_.push_back({{}, Clock::now()});
      if (clouds_.back().message.decode(message.bytes.data(), 0, size) != size) return false;
    }
  }
  changed_.notify_all();
  return true;
}

void RecordingTransport::receive(std::chrono::milliseconds timeout, const Receiver&) {
  std::this_thread::sleep_for(timeout);
}

std::deque<RecordingTransport::Cloud> RecordingTransport::clouds() const {
  const std::scoped_lock lock(mutex_);
  return clouds_;
}

std::optional<health_t> RecordingTransport::health() const {
  const std::scoped_lock lock(mutex_);
  return health_.state == 0 ? std::nullopt : std::optional(health_);
}

void RecordingTransport::forget_clouds() {
  const std::scoped_lock lock(mutex_);
  clouds_.clear();
}

bool RecordingTransport::wait_for(const std::function<bool(const std::deque<Cloud>&, const health_t&)>& holds,
                                  std::chrono::milliseconds timeout) {
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, timeout, [&] { return holds(clouds_, health_); });
}

DriverRig::DriverRig(const RoomScene& room)
    : folder_(std::filesystem::temp_directory_path() / ("floornav-kinect-" + std::to_string(::getpid()))) {
  std::filesystem::create_directories(folder_);
  write_room_scene(room, folder_ / "room.scene");
  kinect_ = std::make_unique<VirtualKinect>(folder_ / "control", folder_ / "room.scene");
  ::setenv(kControlVariable, kinect_->control_file().c_str(), 1);
  settings.width = room.camera.width;
  settings.height = room.camera.height;
}

DriverRig::~DriverRig() {
  stop();
  ::unsetenv(kControlVariable);
  std::filesystem::remove_all(folder_);
}

void DriverRig::start() {
  const Connection::Periods periods = periods_of(settings);
  capture_ =
      std::make_unique<Capture>(std::make_unique<OpenNiDevice>(settings), periods, [this](const auto& line) {
        const std::scoped_lock lock(lines_mutex_);
        lines_.push_back(line);
      });
  node_ = std::make_unique<KinectNode>(settings, *capture_);
  executor_ = std::make_unique<LiveExecutor>(*node_, bus, LiveOptions{});
  stopping_ = false;
  thread_ = std::thread([this] { executor_->run(stopping_); });
}

void DriverRig::stop() {
  stopping_ = true;
  if (thread_.joinable()) thread_.join();
  capture_.reset();
}

bool DriverRig::wait_for_clouds(std::size_t count, std::chrono::milliseconds timeout) {
  return bus.wait_for([count](const auto& clouds, const auto&) { return clouds.size() >= count; }, timeout);
}

bool DriverRig::wait_for_state(std::int8_t state, const std::string& reason_part,
                               std::chrono::milliseconds timeout) {
  return bus.wait_for(
      [&](const auto&, const health_t& health) {
        return health.state == state && health.reason.find(reason_part) != std::string::npos;
      },
      timeout);
}

std::int64_t DriverRig::drops(const std::string& cause) const {
  const std::optional<health_t> health = bus.health();
  if (!health) return 0;
  for (const drop_t& drop : health->drops)
    if (drop.cause == cause) return drop.count;
  return 0;
}

std::vector<std::string> DriverRig::lines() const {
  const std::scoped_lock lock(lines_mutex_);
  return lines_;
}

}  // namespace floornav
