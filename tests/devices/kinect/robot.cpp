#include "tests/devices/kinect/robot.hpp"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <map>
#include <mutex>
#include <thread>
#include <vector>

#include <fmt/format.h>

#include "floornav/depth_cloud_t.hpp"
#include "floornav/goal_t.hpp"
#include "floornav/grid_map_t.hpp"
#include "floornav/health_t.hpp"
#include "floornav/path_t.hpp"
#include "floornav/pose_t.hpp"
#include "floornav/surfels_t.hpp"
#include "lcmtypes/channels.hpp"
#include "runtime/process/identity.hpp"
#include "runtime/process/inbox.hpp"
#include "runtime/process/lcm_transport.hpp"

namespace floornav {
namespace {

using namespace std::chrono_literals;

template <class Clock>
std::int64_t now_us() {
  return std::chrono::duration_cast<std::chrono::microseconds>(Clock::now().time_since_epoch()).count();
}

double percentile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  const auto at = static_cast<std::size_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(at), values.end());
  return values[at];
}

/// Counts what comes over the bus.
class Watch {
 public:
  Watch(LcmTransport& bus, VirtualKinect& kinect, int period_us)
      : bus_(bus), kinect_(kinect), period_us_(period_us) {
    inbox_.subscribe<depth_cloud_t>(channel::kKinectCloud, Keep::kAll,
                                    [this](const auto& m, Micros) { see(m); });
    inbox_.subscribe<surfels_t>(channel::kSurfels, Keep::kAll, [this](const auto& m, Micros) { see(m); });
    inbox_.subscribe<grid_map_t>(channel::kGridMap, Keep::kAll, [](const auto&, Micros) {});
    inbox_.subscribe<path_t>(channel::kPath, Keep::kAll,
                             [this](const auto& m, Micros) { ++path_status_[m.status]; });
    inbox_.subscribe<health_t>(channel::kHealth, Keep::kAll,
                               [this](const auto& m, Micros) { health_[m.source] = m; });
    for (const auto& [name, keep] : inbox_.channels()) bus.subscribe(name);
  }

  void receive(std::chrono::milliseconds timeout) {
    bus_.receive(timeout, [this](std::string_view name, std::span<const std::uint8_t> bytes) {
      inbox_.deliver(name, bytes, Micros(now_us<std::chrono::steady_clock>()));
    });
  }

  [[nodiscard]] std::int64_t clouds() const { return clouds_; }
  [[nodiscard]] LiveReport report(std::int64_t raised, std::int64_t may_lose) const {
    LiveReport report;
    report.raised = raised;
    report.text =
        fmt::format("frames of the device {}, clouds {}, lost in the driver {}, lost on the bus {}\n", raised,
                    clouds_, frame_gaps_ - lost_on_bus(), lost_on_bus());
    report.text +=
        fmt::format("device's frame to message received: median {:.2f} ms, p99 {:.2f} ms, max {:.2f} ms\n",
                    percentile(latency_ms_, 0.5), percentile(latency_ms_, 0.99), percentile(latency_ms_, 1));
    report.text += fmt::format("frames with surfels {}\n", surfel_frames_);
    for (const auto& [name, counts] : inbox_.counts())
      report.text += fmt::format("{:14} received {:6}  lost {:4}  malformed {}\n", name, counts.received,
                                 counts.lost, counts.malformed);
    for (const auto& [status, count] : path_status_)
      report.text += fmt::format("PATH status {}: {}\n", status, count);
    for (const auto& [source, health] : health_) report.text += text_of(health);
    report.flaw = flaw(raised, may_lose);
    return report;
  }

 private:
  [[nodiscard]] std::int64_t lost_on_bus() const { return inbox_.counts().at(channel::kKinectCloud).lost; }

  /// frame_gaps_ has the clouds that were lost on the bus in it, and the device may be one frame ahead or
  /// behind at either end.
  [[nodiscard]] std::string flaw(std::int64_t raised, std::int64_t may_lose) const {
    for (const auto& [name, counts] : inbox_.counts())
      if (counts.received == 0) return fmt::format("nothing came on {}", name);
    for (const char* source : {"kinect", "perception", "mapper", "planner"})
      if (!health_.contains(source)) return fmt::format("nothing heard of {}", source);
    if (std::abs(raised - clouds_ - frame_gaps_) > 2)
      return fmt::format("{} frames of the device, but {} clouds and {} told as lost", raised, clouds_,
                         frame_gaps_);
    return frame_gaps_ > may_lose ? fmt::format("{} frames lost", frame_gaps_) : "";
  }

  static std::string text_of(const health_t& health) {
    std::string text = fmt::format("HEALTH of {}: state {} {}\n", health.source, health.state, health.reason);
    for (const drop_t& drop : health.drops) text += fmt::format("    {}: {}\n", drop.cause, drop.count);
    for (const latency_t& l : health.latencies)
      text += fmt::format("    {}: p50 {:.2f} ms, p99 {:.2f} ms, max {:.2f} ms\n", l.what, l.p50_ms, l.p99_ms,
                          l.max_ms);
    return text;
  }

  void see(const depth_cloud_t& cloud) {
    const std::int64_t now = now_us<std::chrono::steady_clock>();
    if (clouds_++ > 0) frame_gaps_ += cloud.frame - last_frame_ - 1;
    last_frame_ = cloud.frame;
    const std::int64_t exposure = cloud.utime - now_us<std::chrono::system_clock>() + now;
    const std::int64_t step = (exposure - kinect_->origin_us + period_us_ / 2) / period_us_;
    const RaisedFrame& raised = kinect_->records[static_cast<std::size_t>(step) % ControlBlock::kRecords];
    const double ms = static_cast<double>(now - raised.raised_us) * 1e-3;
    if (ms >= 0 && ms < 1000) latency_ms_.push_back(ms);
  }
  void see(const surfels_t& surfels) {
    if (surfels.frame != last_surfels_) ++surfel_frames_;
    last_surfels_ = surfels.frame;
  }

  LcmTransport& bus_;
  VirtualKinect& kinect_;
  int period_us_;
  Inbox inbox_;
  std::int64_t clouds_ = 0;
  std::int64_t last_frame_ = 0;
  std::int64_t frame_gaps_ = 0;
  std::int64_t surfel_frames_ = 0;
  std::int64_t last_surfels_ = 0;
  std::vector<double> latency_ms_;
  std::map<int, std::int64_t> path_status_;
  std::map<std::string, health_t> health_;
};

}  // namespace

LiveReport drive_live(VirtualKinect& kinect, const LogScene& scene, std::array<double, 2> goal_m,
                      double seconds, int may_lose, const std::string& lcm_url,
                      const std::atomic<bool>& stop) {
  LcmTransport bus(lcm_url);
  Watch watch(bus, kinect, scene.period_us);
  std::atomic<bool> ended = false;
  std::thread base([&] {
    LcmTransport own(lcm_url);
    Outbox out(random_identity("base"));
    std::int64_t ticks = 0;
    for (auto wake = std::chrono::steady_clock::now(); !ended; wake += 10ms, ++ticks) {
      std::this_thread::sleep_until(wake);
      pose_t pose{};
      const std::int64_t monotonic = now_us<std::chrono::steady_clock>();
      pose.utime = now_us<std::chrono::system_clock>();
      pose_to_arrays(scene.body_at(std::max<std::int64_t>(0, monotonic - kinect->origin_us)), pose.pos,
                     pose.orientation);
      out.publish(channel::kPose, pose);
      if (ticks % 100 == 0) {
        goal_t goal{};
        goal.utime = pose.utime;
        goal.id = 1;
        goal.command = goal_t::GO;
        goal.pos[0] = goal_m[0];
        goal.pos[1] = goal_m[1];
        goal.tolerance = 0.3F;
        out.publish(channel::kGoal, goal);
      }
      for (const EncodedMessage& message : out.take()) own.publish(message);
    }
  });
  const auto patience = std::chrono::steady_clock::now() + 20s;
  while (watch.clouds() == 0 && !stop && std::chrono::steady_clock::now() < patience) watch.receive(50ms);
  const std::int64_t raised = kinect->raised - 1;
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (!stop && std::chrono::steady_clock::now() < end) watch.receive(50ms);
  const std::int64_t raised_at_end = kinect->raised;
  watch.receive(100ms);
  ended = true;
  base.join();
  return watch.report(raised_at_end - raised, may_lose);
}

}  // namespace floornav
