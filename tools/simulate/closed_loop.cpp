#include "tools/simulate/closed_loop.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "lcmtypes/channels.hpp"
#include "mapping/node/mapper_node.hpp"
#include "perception/node/perception_node.hpp"
#include "planner/node/planner_node.hpp"
#include "runtime/process/replay_executor.hpp"
#include "tools/simulate/drive_base.hpp"
#include "tools/simulate/errand.hpp"
#include "tools/simulate/path_follower.hpp"
#include "tools/simulate/true_map.hpp"
#include "tools/simulate/walkers.hpp"
#include "tools/simulator/depth_sensor.hpp"
#include "tools/simulator/drive.hpp"
#include "tools/simulator/messages.hpp"
#include "tools/simulator/random.hpp"
#include "tools/simulator/true_route.hpp"

namespace floornav {
namespace {

using namespace std::chrono_literals;

enum Stream : std::uint64_t { kSensor = 21, kOdometry = 22, kJitter = 23 };

constexpr Micros kStep = 10ms;  ///< of the robot's motion
constexpr Micros kPosePeriod = 20ms;
constexpr Micros kGoalPeriod = 500ms;
constexpr Micros kControlPeriod = 50ms;
constexpr Micros kLookPeriod = 50ms;  ///< at collisions
constexpr double kGoalTolerance_m = 0.2;
constexpr double kGoalSlack_m = 0.1;      ///< for the noise of what the robot believes
constexpr double kEndTolerance_m = 0.05;  ///< as the place where a run ended
constexpr double kSecondsPerMetre = 8.0;
constexpr double kSecondsAtLeast = 60.0;
constexpr double kElsewhere_m = 0.15;  ///< beside the path before: another way

double seconds_of(Micros time) {
  return static_cast<double>(time.count()) * 1e-6;
}
Micros micros_of(double seconds) {
  return Micros(static_cast<std::int64_t>(seconds * 1e6 + 0.5));
}

/// Whether a path strays from the one before, as far as that one went.
bool leads_elsewhere(const path_t& path, const path_t& before) {
  if (path.points.empty() || before.points.empty()) return false;
  const auto place = [](const path_point_t& p) { return Eigen::Vector2f(p.x, p.y); };
  const Eigen::Vector2f end = place(before.points.back());
  for (const path_point_t& point : path.points) {
    float nearest = std::numeric_limits<float>::infinity();
    for (const path_point_t& other : before.points)
      nearest = std::min(nearest, (place(other) - place(point)).norm());
    if (nearest <= static_cast<float>(kElsewhere_m)) continue;
    return (place(before.points.front()) - place(point)).norm() < (place(before.points.front()) - end).norm();
  }
  return false;
}

class ClosedLoop {
 public:
  ClosedLoop(const RandomWorld& world, const RobotSettings& robot, const ClosedLoopSettings& settings,
             std::uint64_t seed, RunRecord* record)
      : world_(world),
        robot_(robot),
        settings_(settings),
        record_(record),
        perception_({}, robot, serial_),
        mapper_({}, robot),
        planner_({}, robot),
        executor_(settings.known_map ? std::vector<Node*>{&planner_}
                                     : std::vector<Node*>{&perception_, &mapper_, &planner_},
                  [this](const EncodedMessage& message, Micros now) { hear(message, now); }),
        sensor_(settings.sensor, random_key({seed, kSensor})),
        odometry_(settings.pose_noise, random_key({seed, kOdometry})),
        jitter_(random_key({seed, kJitter})),
        base_(robot, {}),
        follower_(robot),
        out_({"simulate", 1}),
        shortest_m_(shortest_way_m(world.truth, robot.radius_m, {0, 0}, *world.scene.goal_m, kGoalTolerance_m)
                        .value_or(world.scene.goal_m->norm())),
        walkers_(world.scene),
        errand_(*world.scene.goal_m, kGoalTolerance_m) {}

  ClosedLoopResult run() {
    ClosedLoopResult result;
    for (const Micros limit = time_limit(); now_ < limit; now_ += kStep) {
      sense();
      deliver();
      control();
      base_.move(command_, seconds_of(kStep));
      if (moves()) last_motion_ = now_;
      walkers_.walk(base_.state().position_m, seconds_of(kStep));
      if (now_ % kLookPeriod == Micros(0)) {
        result.reason = look_for_trouble();
        if (!result.reason.empty()) return finish(result, Outcome::kCollided);
      }
      const bool says_reached = follower_.path() && errand_.done(*follower_.path());
      if (says_reached && base_.speed_mps() == 0.0) return finish(result, outcome_at_rest());
      if (now_ - last_motion_ > micros_of(settings_.patience_s)) break;
    }
    return finish(result, Outcome::kStopped);
  }

 private:
  [[nodiscard]] Micros time_limit() const {
    return micros_of(settings_.most_s > 0 ? settings_.most_s
                                          : kSecondsAtLeast + kSecondsPerMetre * shortest_m_);
  }

  [[nodiscard]] bool moves() const { return base_.speed_mps() > 0.01 || std::abs(base_.turn_radps()) > 0.01; }

  [[nodiscard]] Pose body() const { return body_on_floor(world_.scene.fixed, base_.state()); }

  std::string look_for_trouble() {
    if (record_ != nullptr) record_->driven_m.push_back(base_.state().position_m);
    std::string trouble = base_.trouble(world_.scene.fixed);
    return trouble.empty() ? walkers_.meeting(base_) : trouble;
  }

  /// The planner's word is checked: reached is where the robot truly is near the goal, the odometry's noise
  /// allowed for.
  [[nodiscard]] Outcome outcome_at_rest() const {
    const double distance = (base_.state().position_m - *world_.scene.goal_m).norm();
    return distance <= kGoalTolerance_m + kGoalSlack_m ? Outcome::kReached : Outcome::kStopped;
  }

  ClosedLoopResult finish(ClosedLoopResult result, Outcome outcome) const {
    if (record_ != nullptr) {
      record_->end = base_.state();
      for (const path_point_t& p : last_path_.points) record_->path_m.emplace_back(p.x, p.y);
    }
    result.outcome = outcome;
    if (result.reason.empty() && follower_.path()) result.reason = follower_.path()->reason;
    result.seconds = seconds_of(now_);
    result.travelled_m = base_.travelled_m();
    result.replans = replans_;
    result.end_m = base_.state().position_m;
    result.shortest_m = shortest_m_;
    if (outcome == Outcome::kReached)
      result.shortest_m = shortest_way_m(world_.truth, robot_.radius_m, {0, 0}, result.end_m, kEndTolerance_m)
                              .value_or(shortest_m_);
    return result;
  }

  /// What the robot's sensors say now arrives later.
  void sense() {
    const std::int64_t utime_us = kDriveStart_us + now_.count();
    if (now_ % kPosePeriod == Micros(0)) {
      const Pose measured = odometry_.measure(body());
      out_.publish(channel::kPose, pose_message(utime_us, measured, measured, measured, 1.0));
      send(settings_.pose_latency_s);
    }
    if (now_ % micros_of(1.0 / settings_.sensor.rate_hz) == Micros(0)) {
      settings_.known_map ? tell_map(utime_us) : render(utime_us);
      send(settings_.cloud_latency_s);
    }
    if (now_ % kGoalPeriod == Micros(0)) {
      out_.publish(channel::kGoal, errand_.goal(utime_us));
      send(0.0);
    }
  }

  void render(std::int64_t utime_us) {
    const auto pixels = sensor_.measure(walkers_.world(), body(), frame_);
    const bool is_kinect = settings_.sensor.kind == SensorKind::kKinect;
    out_.publish(is_kinect ? channel::kKinectCloud : channel::kBumblebeeCloud,
                 cloud_message(sensor_, pixels, utime_us, frame_++));
  }

  /// The true map once, then a sign of life.
  void tell_map(std::int64_t utime_us) {
    const GridMap map = true_map(world_.truth);
    const auto tiles = frame_++ == 0 ? map.sorted_tiles() : std::vector<CellIndex>{};
    const auto step_m = static_cast<float>(robot_.max_step_m);
    for (grid_map_t& message : to_messages(map, tiles, {utime_us, step_m, body()})) {
      if (record_ != nullptr) record_->map.apply(message);
      out_.publish(channel::kGridMap, message);
    }
  }

  /// Messages of one channel keep their order, whatever the jitter.
  void send(double latency_s) {
    for (EncodedMessage& message : out_.take()) {
      Micros arrival = now_ + micros_of(latency_s + jitter_.uniform(0, settings_.jitter_s));
      Micros& last = last_arrival_[message.channel];
      arrival = last = std::max(arrival, last);
      on_the_way_.emplace(arrival, std::move(message));
    }
  }

  void deliver() {
    while (!on_the_way_.empty() && on_the_way_.begin()->first <= now_) {
      const auto first = on_the_way_.begin();
      const std::int64_t stamp_us = kDriveStart_us + first->first.count();
      const LogEvent event{stamp_us, first->second.channel, first->second.bytes};
      on_the_way_.erase(first);
      if (event.channel == channel::kPose) believe(event);
      write(event.timestamp_us, event.channel, event.bytes);
      executor_.deliver(event);
    }
  }

  void write(std::int64_t stamp_us, const std::string& channel, const std::vector<std::uint8_t>& bytes) {
    if (record_ != nullptr && record_->log != nullptr) record_->log->write(stamp_us, channel, bytes);
  }

  void believe(const LogEvent& event) {
    pose_t message;
    message.decode(event.bytes.data(), 0, static_cast<int>(event.bytes.size()));
    const Pose pose = pose_from_arrays(message.pos, message.orientation);
    believed_ = {pose.translation().head<2>(), pose.linear().col(0).head<2>().normalized()};
  }

  void hear(const EncodedMessage& message, Micros) {
    write(kDriveStart_us + now_.count(), message.channel, message.bytes);
    if (record_ != nullptr && message.channel == channel::kGridMap) {
      grid_map_t map;
      map.decode(message.bytes.data(), 0, static_cast<int>(message.bytes.size()));
      record_->map.apply(map);
    }
    if (message.channel != channel::kPath) return;
    path_t path;
    path.decode(message.bytes.data(), 0, static_cast<int>(message.bytes.size()));
    if (leads_elsewhere(path, last_path_)) ++replans_;
    if (!path.points.empty()) last_path_ = path;
    paths_on_the_way_.emplace(
        now_ + micros_of(settings_.command_latency_s + jitter_.uniform(0, settings_.jitter_s)),
        std::move(path));
  }

  void control() {
    while (!paths_on_the_way_.empty() && paths_on_the_way_.begin()->first <= now_) {
      follower_.accept(paths_on_the_way_.begin()->second, now_);
      paths_on_the_way_.erase(paths_on_the_way_.begin());
    }
    if (now_ % kControlPeriod != Micros(0)) return;
    if (follower_.path()) errand_.follow(*follower_.path(), believed_.position_m, moves(), now_);
    command_ = errand_.looks_around() ? look_around() : follower_.command(believed_, base_.speed_mps(), now_);
  }

  DriveCommand look_around() {
    const std::optional<DriveCommand> command = follower_.look_around(believed_, base_.speed_mps());
    if (!command) errand_.has_looked();
    return command.value_or(DriveCommand{});
  }

  const RandomWorld& world_;
  const RobotSettings& robot_;
  const ClosedLoopSettings& settings_;
  RunRecord* record_;
  Serial serial_;
  PerceptionNode perception_;
  MapperNode mapper_;
  PlannerNode planner_;
  ReplayExecutor executor_;
  DepthSensor sensor_;
  Odometry odometry_;
  RandomStream jitter_;
  DriveBase base_;
  PathFollower follower_;
  Outbox out_;
  double shortest_m_;

  Walkers walkers_;
  Errand errand_;
  Micros now_{0};
  Micros last_motion_{0};
  std::int64_t frame_ = 0;
  int replans_ = 0;
  path_t last_path_{};
  PlanarState believed_;
  DriveCommand command_;
  std::multimap<Micros, EncodedMessage> on_the_way_;
  std::multimap<Micros, path_t> paths_on_the_way_;
  std::map<std::string, Micros> last_arrival_;
};

}  // namespace

ClosedLoopResult drive_world(const RandomWorld& world, const RobotSettings& robot,
                             const ClosedLoopSettings& settings, std::uint64_t seed, RunRecord* record) {
  return ClosedLoop(world, robot, settings, seed, record).run();
}

}  // namespace floornav
