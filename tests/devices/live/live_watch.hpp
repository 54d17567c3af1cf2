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
#include "tests/devices/live/live_camera.hpp"

namespace floornav {

/// Counts and times what a live stack says over the bus.
class LiveWatch {
 public:
  /// Both must outlive it.
  LiveWatch(LcmTransport& bus, const LiveCamera& camera);

  void receive(std::chrono::milliseconds timeout);
  /// The camera was unplugged, or plugged in again, now.
  void unplugged();
  void plugged();

  [[nodiscard]] std::int64_t clouds() const { return clouds_; }
  /// Whether every process was heard and did what it was asked to.
  [[nodiscard]] bool settled() const { return silence().empty(); }
  /// Whether every frame of the camera came as a cloud or is told as lost.
  [[nodiscard]] bool all_told() const;
  /// A table for a person.
  [[nodiscard]] std::string table() const;
  /// Why the run is no good; empty: it is. A process that says nothing, a frame that nobody accounts for,
  /// more than `may_lose` lost, an unplugged camera that does not stop the robot or never comes back; where
  /// it stays plugged in, a frame without the nearest sections.
  [[nodiscard]] std::string flaw(std::int64_t may_lose) const;

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
  [[nodiscard]] std::string nearest_text() const;
  /// What was not heard or seen yet; empty: nothing.
  [[nodiscard]] std::string silence() const;
  [[nodiscard]] std::int64_t may_be_untold() const;
  /// The step of the camera at a time of CLOCK_MONOTONIC.
  [[nodiscard]] std::int64_t step_at(std::int64_t monotonic_us) const;
  /// Frames that the camera handed to the driver's library, from that of the first cloud on.
  [[nodiscard]] std::int64_t raised() const;

  LcmTransport& bus_;
  const LiveCamera& camera_;
  Inbox inbox_;
  std::int64_t clouds_ = 0;
  std::int64_t first_step_ = 0;  ///< of the camera's frames, that of the first cloud
  std::int64_t last_frame_ = 0;
  std::int64_t frame_gaps_ = 0;  ///< clouds that were lost on the bus are in it
  std::int64_t surfel_frames_ = 0;
  std::int64_t nearest_frames_ = 0;  ///< of those, with the nearest row of sections
  std::int64_t last_surfels_ = -1;
  std::int64_t last_nearest_ = -1;
  std::map<std::int64_t, std::int64_t> arrived_us_;  ///< a frame: when its cloud came
  std::vector<double> near_ms_;                      ///< from a cloud to its nearest sections
  std::vector<double> latency_ms_;
  std::map<int, std::int64_t> path_status_;
  std::map<std::string, health_t> health_;
  Reaction stop_;    ///< unplugged: the planner stops
  Reaction frames_;  ///< plugged in again: clouds come
  Reaction moves_;   ///< plugged in again: the robot may drive
};

}  // namespace floornav
