#include "tests/drivers/kinect/driver_rig.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <gtest/gtest.h>

#include "lcmtypes/channels.hpp"
#include "lcmtypes/depth_cloud.hpp"

namespace floornav {

bool RememberingBus::publish(const EncodedMessage& message) {
  {
    const std::scoped_lock lock(mutex_);
    const int size = static_cast<int>(message.bytes.size());
    if (message.channel == channel::kHealth) {
      if (health_.decode(message.bytes.data(), 0, size) != size) return false;
    } else if (message.channel == channel::kKinectImage) {
      images_.emplace_back();
      if (images_.back().decode(message.bytes.data(), 0, size) != size) return false;
    } else {
      clouds_.push_back({{}, Clock::now()});
      if (clouds_.back().message.decode(message.bytes.data(), 0, size) != size) return false;
    }
  }
  changed_.notify_all();
  return true;
}

void RememberingBus::receive(std::chrono::milliseconds timeout, const Receiver&) {
  std::this_thread::sleep_for(timeout);
}

std::deque<RememberingBus::Cloud> RememberingBus::clouds() const {
  const std::scoped_lock lock(mutex_);
  return clouds_;
}

std::vector<image_t> RememberingBus::images() const {
  const std::scoped_lock lock(mutex_);
  return images_;
}

std::optional<health_t> RememberingBus::health() const {
  const std::scoped_lock lock(mutex_);
  return health_.state == 0 ? std::nullopt : std::optional(health_);
}

void RememberingBus::forget_clouds() {
  const std::scoped_lock lock(mutex_);
  clouds_.clear();
}

bool RememberingBus::wait_for(const std::function<bool(const std::deque<Cloud>&, const health_t&)>& holds,
                              std::chrono::milliseconds timeout) {
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, timeout, [&] { return holds(clouds_, health_); });
}

double worst_error_m(const depth_cloud_t& cloud, const RoomScene& room, int skip) {
  std::vector<std::uint16_t> pixels;
  unpack_pixels(cloud, pixels);
  double worst = 0;
  for (int row = 0; row < cloud.height; ++row)
    for (int column = 1; column < cloud.width; ++column) {
      if ((row * skip * room.camera.width + column * skip) % 16 == 0) continue;
      const double depth =
          pixels[static_cast<std::size_t>(row * cloud.width + column)] * static_cast<double>(cloud.scale);
      worst = std::max(worst, std::abs(depth - room.depth_at(column * skip, row * skip)));
    }
  return worst;
}

void expect_frames_count_exposures(const std::deque<RememberingBus::Cloud>& clouds, int period_us) {
  for (std::size_t i = 1; i < clouds.size(); ++i) {
    const depth_cloud_t& before = clouds[i - 1].message;
    const depth_cloud_t& cloud = clouds[i].message;
    EXPECT_EQ(cloud.seq, before.seq + 1);
    const std::int64_t exposures = (cloud.utime - before.utime + period_us / 2) / period_us;
    EXPECT_EQ(cloud.frame - before.frame, exposures) << "at frame " << cloud.frame;
  }
}

DriverRig::DriverRig(const RoomScene& room) {
  write_room_scene(room, folder_ / "room.scene");
  kinect_ = std::make_unique<VirtualKinect>(folder_ / "control", folder_ / "room.scene");
  ::setenv(kControlVariable, kinect_->control_file().c_str(), 1);
  settings.width = room.camera.width;
  settings.height = room.camera.height;
}

DriverRig::~DriverRig() {
  stop();
  ::unsetenv(kControlVariable);
}

void DriverRig::start() {
  const Connection::Periods periods = periods_of(settings);
  auto capture = std::make_unique<KinectCapture>(std::make_unique<OpenNiDevice>(settings), periods,
                                                 [this](const auto& line) {
                                                   const std::scoped_lock lock(lines_mutex_);
                                                   lines_.push_back(line);
                                                 });
  capture_ = capture.get();
  node_ = std::make_unique<KinectNode>(settings, std::move(capture), [this] { gave_up_ = true; });
  executor_ = std::make_unique<LiveExecutor>(*node_, bus, LiveOptions{});
  stopping_ = false;
  thread_ = std::thread([this] { executor_->run(stopping_); });
}

void DriverRig::stop() {
  stopping_ = true;
  if (thread_.joinable()) thread_.join();
  executor_.reset();
  node_.reset();
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
