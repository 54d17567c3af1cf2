#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "floornav/depth_cloud_t.hpp"
#include "floornav/health_t.hpp"
#include "floornav/image_t.hpp"
#include "runtime/process/transport.hpp"

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
  bool wait_for_clouds(std::size_t count, std::chrono::milliseconds timeout);
  /// HEALTH tells this state, with these words in its reason.
  bool wait_for_state(std::int8_t state, const std::string& reason_part, std::chrono::milliseconds timeout);
  /// Of this cause, as HEALTH told last.
  [[nodiscard]] std::int64_t drops(const std::string& cause) const;

 private:
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Cloud> clouds_;
  std::vector<image_t> images_;
  health_t health_{};
};

/// A test fails where `frame` does not count the exposures between two clouds of one connection, lost ones
/// included: holds however late the machine runs the driver.
void expect_frames_count_exposures(const std::deque<RememberingBus::Cloud>& clouds, int period_us);

}  // namespace floornav
