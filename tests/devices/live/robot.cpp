#include "tests/devices/live/robot.hpp"

#include <algorithm>
#include <chrono>
#include <thread>

#include "floornav/goal_t.hpp"
#include "floornav/pose_t.hpp"
#include "lcmtypes/channels.hpp"
#include "runtime/process/identity.hpp"
#include "runtime/process/lcm_transport.hpp"
#include "runtime/process/outbox.hpp"
#include "tests/devices/live/live_watch.hpp"

namespace floornav {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

template <class AnyClock>
std::int64_t now_us() {
  return std::chrono::duration_cast<std::chrono::microseconds>(AnyClock::now().time_since_epoch()).count();
}

pose_t pose_now(const LiveCamera& camera) {
  pose_t pose{};
  pose.utime = now_us<std::chrono::system_clock>();
  pose_to_arrays(camera.body_at(std::max<std::int64_t>(0, now_us<Clock>() - camera.origin_us)), pose.pos,
                 pose.orientation);
  return pose;
}

goal_t goal_at(const std::array<double, 2>& place_m) {
  goal_t goal{};
  goal.utime = now_us<std::chrono::system_clock>();
  goal.id = 1;
  goal.command = goal_t::GO;
  goal.pos[0] = place_m[0];
  goal.pos[1] = place_m[1];
  goal.tolerance = 0.3F;
  return goal;
}

/// Sends poses and goals until it is asked to stop.
void be_the_base(const LiveCamera& camera, const LiveTask& task, const std::stop_token& ended) {
  LcmTransport bus(task.lcm_url);
  Outbox out(random_identity("base"));
  std::int64_t ticks = 0;
  for (auto wake = Clock::now(); !ended.stop_requested(); wake += 10ms, ++ticks) {
    std::this_thread::sleep_until(wake);
    out.publish(channel::kPose, pose_now(camera));
    if (ticks % 100 == 0) out.publish(channel::kGoal, goal_at(task.goal_m));
    for (const EncodedMessage& message : out.take()) bus.publish(message);
  }
}

/// Watches for so long, or until `stop`.
void watch_for(double seconds, LiveWatch& watch, const std::atomic<bool>& stop) {
  const auto end = Clock::now() + std::chrono::duration<double>(seconds);
  while (!stop && Clock::now() < end) watch.receive(20ms);
}

/// Watches until something has come about; gives up on a machine that has stopped altogether.
template <class Condition>
void watch_until(LiveWatch& watch, const std::atomic<bool>& stop, const Condition& condition) {
  const auto patience = Clock::now() + 30s;
  while (!condition() && !stop && Clock::now() < patience) watch.receive(20ms);
}

}  // namespace

LiveReport drive_live(const LiveCamera& camera, const LiveTask& task, const std::atomic<bool>& stop) {
  constexpr double kUnpluggedFor_s = 2.5;
  LcmTransport bus(task.lcm_url);
  LiveWatch watch(bus, camera);
  const std::jthread base([&](const std::stop_token& ended) { be_the_base(camera, task, ended); });
  watch_until(watch, stop, [&] { return watch.clouds() > 0; });
  if (task.unplug_at_s > 0) {
    watch_for(task.unplug_at_s, watch, stop);
    camera.unplug();
    watch.unplugged();
    watch_for(kUnpluggedFor_s, watch, stop);
    camera.plug();
    watch.plugged();
    watch_for(task.seconds - task.unplug_at_s - kUnpluggedFor_s, watch, stop);
  } else {
    watch_for(task.seconds, watch, stop);
  }
  watch_until(watch, stop, [&] { return watch.settled(); });
  camera.stall();
  watch_for(0.2, watch, stop);  // what is on its way
  watch_until(watch, stop, [&] { return watch.all_told(); });
  return {watch.table(), watch.flaw(task.may_lose)};
}

}  // namespace floornav
