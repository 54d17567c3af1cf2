#include "tests/drivers/remembering_bus.hpp"

#include <thread>

#include <gtest/gtest.h>

#include "lcmtypes/channels.hpp"

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

bool RememberingBus::wait_for_clouds(std::size_t count, std::chrono::milliseconds timeout) {
  return wait_for([count](const auto& clouds, const auto&) { return clouds.size() >= count; }, timeout);
}

bool RememberingBus::wait_for_state(std::int8_t state, const std::string& reason_part,
                                    std::chrono::milliseconds timeout) {
  return wait_for(
      [&](const auto&, const health_t& health) {
        return health.state == state && health.reason.find(reason_part) != std::string::npos;
      },
      timeout);
}

std::int64_t RememberingBus::drops(const std::string& cause) const {
  const std::optional<health_t> told = health();
  if (!told) return 0;
  for (const drop_t& drop : told->drops)
    if (drop.cause == cause) return drop.count;
  return 0;
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

}  // namespace floornav
