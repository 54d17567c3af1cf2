#include "tests/drivers/kinect/driver_rig.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <gtest/gtest.h>

#include "lcmtypes/depth_cloud.hpp"

namespace floornav {

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
  return bus.wait_for_clouds(count, timeout);
}

bool DriverRig::wait_for_state(std::int8_t state, const std::string& reason_part,
                               std::chrono::milliseconds timeout) {
  return bus.wait_for_state(state, reason_part, timeout);
}

std::int64_t DriverRig::drops(const std::string& cause) const {
  return bus.drops(cause);
}

std::vector<std::string> DriverRig::lines() const {
  const std::scoped_lock lock(lines_mutex_);
  return lines_;
}

}  // namespace floornav
