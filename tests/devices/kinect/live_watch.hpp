#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "floornav/depth_cloud_t.hpp"
#include "floornav/health_t.hpp"
#include "floornav/path_t.hpp"
#include "floornav/surfels_t.hpp"
#include "runtime/process/inbox.hpp"
#include "runtime/process/lcm_transport.hpp"
#include "tests/devices/kinect/virtual_kinect.hpp"

namespace floornav {

/// Counts and times what a live stack says over the bus.
class LiveWatch {
 public:
  /// `period_us`: between the frames of the virtual Kinect.
  LiveWatch(LcmTransport& bus, VirtualKinect& kinect, int period_us);

  void receive(std::chrono::milliseconds timeout);
  /// The virtual Kinect was unplugged, or plugged in again, now.
  void unplugged();
  void plugged();

  [[nodiscard]] std::int64_t clouds() const { return clouds_; }
  /// A table for a person; `raised`: frames that the virtual Kinect handed to OpenNI2.
  [[nodiscard]] std::string table(std::int64_t raised) const;
  /// Why the run is no good; empty: it is. A process that says nothing, a frame that nobody accounts for,
  /// more than `may_lose` lost, an unplugged camera that does not stop the robot or never comes back.
  [[nodiscard]] std::string flaw(std::int64_t raised, std::int64_t may_lose) const;

 private:
  using Clock = std::chrono::steady_clock;
  /// When something happened, and how long after it another thing did.
  struct Reaction {
    std::optional<Clock::time_point> since;
    std::optional<double> ms;
    void begin() { since = Clock::now(); }
    void end();
  };

  void see(const depth_cloud_t& cloud);
  void see(const surfels_t& surfels);
  void see(const path_t& path);
  [[nodiscard]] std::int64_t lost_on_bus() const;

  LcmTransport& bus_;
  VirtualKinect& kinect_;
  int period_us_;
  Inbox inbox_;
  std::int64_t clouds_ = 0;
  std::int64_t last_frame_ = 0;
  std::int64_t frame_gaps_ = 0;  ///< clouds that were lost on the bus are in it
  std::int64_t surfel_frames_ = 0;
  std::int64_t last_surfels_ = 0;
  std::vector<double> latency_ms_;
  std::map<int, std::int64_t> path_status_;
  std::map<std::string, health_t> health_;
  Reaction stop_;    ///< unplugged: the planner stops
  Reaction frames_;  ///< plugged in again: clouds come
  Reaction moves_;   ///< plugged in again: the robot may drive
};

}  // namespace floornav
