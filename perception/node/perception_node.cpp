#include "perception/node/perception_node.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "lcmtypes/channels.hpp"
#include "lcmtypes/depth_codec.hpp"
#include "perception/node/surfels_message.hpp"
#include "runtime/process/health.hpp"
#include "runtime/process/pose_message.hpp"

namespace floornav {

namespace {

using namespace std::chrono_literals;

constexpr Micros kPoseWait = 100ms;
/// Poses further apart, or a utime that steps back further, do not belong together: the sender's clock has
/// stepped.
constexpr std::int64_t kMaxPoseGap_us = 1'000'000;
/// A cloud's utime further from the newest pose's is absurd.
constexpr std::int64_t kMaxCloudGap_us = 10'000'000;
constexpr std::size_t kMaxWaiting = 32;
constexpr Micros kShortestPeriod = 10ms;
constexpr Micros kLongestPeriod = 1s;
/// Of a section's work: what is done with its cells after all sections were searched.
constexpr double kShareOfCells = 0.3;

}  // namespace

PerceptionNode::PerceptionNode(const PerceptionSettings& settings, const RobotSettings& robot,
                               Parallel& parallel)
    : time_(settings.time),
      parallel_(parallel),
      cameras_{
          Camera{channel::kKinectCloud, FloorPerception(settings, robot), {}, {}, {}, kLongestPeriod, 0, {}},
          Camera{channel::kBumblebeeCloud,
                 FloorPerception(settings, robot),
                 {},
                 {},
                 {},
                 kLongestPeriod,
                 0,
                 {}}} {}

std::optional<Micros> PerceptionNode::deadline() const {
  return Micros(std::llround(time_.deadline_ms * 1000.0));
}

std::vector<std::string> PerceptionNode::outputs() const {
  return {channel::kSurfels};
}

void PerceptionNode::subscribe(Inbox& inbox) {
  for (std::size_t camera = 0; camera < cameras_.size(); ++camera)
    inbox.subscribe<depth_cloud_t>(
        cameras_[camera].channel, Keep::kAll,
        [this, camera](const depth_cloud_t& cloud, Micros now) { accept_cloud(camera, cloud, now); });
  inbox.subscribe<pose_t>(channel::kPose, Keep::kAll,
                          [this](const pose_t& pose, Micros) { accept_pose(pose); });
  inbox.subscribe<path_t>(channel::kPath, Keep::kLatest,
                          [this](const path_t& path, Micros) { accept_path(path); });
}

void PerceptionNode::accept_cloud(std::size_t camera, const depth_cloud_t& cloud, Micros now) {
  auto frame = cameras_[camera].assembly.add(cloud);
  if (!frame) return;
  const std::int64_t utime_us = frame->front().utime;
  std::optional<std::int64_t>& last_us = cameras_[camera].last_utime_us;
  if (last_us && utime_us > *last_us)
    cameras_[camera].period = std::clamp(Micros(utime_us - *last_us), kShortestPeriod, kLongestPeriod);
  last_us = utime_us;
  waiting_.push_back({camera, std::move(*frame), now});
  if (waiting_.size() > kMaxWaiting) drop(0, "overtaken");
}

void PerceptionNode::accept_pose(const pose_t& pose) {
  const Pose T_world_body = body_pose(pose);
  if (const auto newest = poses_.newest_utime()) {
    const bool stepped = pose.utime > *newest + kMaxPoseGap_us || pose.utime < *newest - kMaxPoseGap_us;
    if (stepped) {
      poses_.clear();
      ++drops_["pose stream interrupted"];
    }
  }
  if (!poses_.insert(pose.utime, T_world_body)) ++drops_["pose out of order"];
}

void PerceptionNode::accept_path(const path_t& path) {
  std::vector<Eigen::Vector2d> points;
  for (const path_point_t& point : path.points)
    if (std::isfinite(point.x) && std::isfinite(point.y)) points.emplace_back(point.x, point.y);
  for (Camera& camera : cameras_) camera.perception.set_path(points);
}

bool PerceptionNode::step(Micros now, Budget& budget, Outbox& out) {
  for (std::size_t i = 0; i < waiting_.size();) {
    const auto pose = poses_.at(waiting_[i].utime_us());
    if (pose && !is_overtaken(i, now, budget)) {
      const WaitingCloud cloud = std::move(waiting_[i]);
      waiting_.erase(waiting_.begin() + static_cast<std::ptrdiff_t>(i));
      process(cloud, *pose, budget, out);
      return true;
    }
    if (pose) {
      drop(i, "overtaken");
    } else if (has_absurd_time(waiting_[i])) {
      drop(i, "absurd utime");
    } else if (now - waiting_[i].arrival > kPoseWait) {
      drop(i, "no body pose around its time");
    } else {
      ++i;
    }
  }
  return false;
}

/// True where the cloud is past its deadline, or has waited long, and a newer one of its camera could be
/// processed instead.
bool PerceptionNode::is_overtaken(std::size_t waiting, Micros now, Budget& budget) const {
  const WaitingCloud& cloud = waiting_[waiting];
  budget.begin(cloud.arrival, cameras_[cloud.camera].period);
  if (now - cloud.arrival <= kPoseWait && budget.left_ns() > 0) return false;
  for (std::size_t i = waiting + 1; i < waiting_.size(); ++i)
    if (waiting_[i].camera == cloud.camera && poses_.at(waiting_[i].utime_us())) return true;
  return false;
}

bool PerceptionNode::has_absurd_time(const WaitingCloud& cloud) const {
  const auto newest = poses_.newest_utime();
  return newest &&
         (cloud.utime_us() > *newest + kMaxCloudGap_us || cloud.utime_us() < *newest - kMaxCloudGap_us);
}

void PerceptionNode::drop(std::size_t waiting, const std::string& cause) {
  const std::string& channel = cameras_[waiting_[waiting].camera].channel;
  ++drops_[channel + " " + cause];
  if (cause != "overtaken") trouble_ = "a cloud of " + channel + " was dropped: " + cause;
  waiting_.erase(waiting_.begin() + static_cast<std::ptrdiff_t>(waiting));
}

void PerceptionNode::process(const WaitingCloud& cloud, const Pose& T_world_body, Budget& budget,
                             Outbox& out) {
  Camera& camera = cameras_[cloud.camera];
  DepthFrame frame;
  try {
    frame = unpack_frame(cloud.strips, memory_);
  } catch (const CorruptDepth& error) {
    ++drops_[camera.channel + " corrupt"];
    trouble_ = error.what();
    return;
  }
  trouble_.clear();
  budget.begin(cloud.arrival, camera.period);
  choose_compromise(camera, frame, budget);
  const depth_cloud_t& first = cloud.strips.front();
  FrameMessages messages({first.source, first.session, first.frame, first.sensor});
  const auto tell = [&](const FloorEvidence& evidence, bool is_last) {
    for (surfels_t& message : messages.next(evidence, is_last))
      out.publish(channel::kSurfels, std::move(message));
  };
  std::int64_t put_off_ns = 0;
  bool is_near_row = true;
  const Admission admit = [&](std::int64_t work_ns) {
    const bool must = std::exchange(is_near_row, false);
    if (must) budget.charge(work_ns);
    if (!must && !budget.spend(work_ns, put_off_ns)) return false;
    if (!must) put_off_ns += static_cast<std::int64_t>(kShareOfCells * static_cast<double>(work_ns));
    return true;
  };
  const FloorEvidence& evidence = camera.perception.process(
      frame, T_world_body, parallel_, admit, [](PerceptionStage) {},
      [&](const FloorEvidence& near_row) {
        tell(near_row, false);
        out.hurry();
      });
  tell(evidence, true);
  budget.end();
  ++compromises_[static_cast<std::size_t>(camera.compromise.level)];
  const int density = camera.compromise.point_stride * camera.compromise.point_stride;
  camera.points = density * evidence.pixels.in_roi;
  for (const SectionReport& section : evidence.sections) skipped_sections_ += section.done ? 0 : 1;
}

void PerceptionNode::choose_compromise(Camera& camera, const DepthFrame& frame, const Budget& budget) const {
  camera.compromise = {};
  if (time_.compromise == "auto")
    camera.compromise = camera.control.choose(budget.left_ns(), camera.points,
                                              static_cast<std::int64_t>(frame.pixels.size()));
  camera.compromise.point_stride *= time_.point_stride;
  camera.perception.set_compromise(camera.compromise);
}

void PerceptionNode::report(health_t& health) const {
  for (const auto& [cause, count] : drops_) add_drop(health, cause, count);
  for (const Camera& camera : cameras_)
    add_drop(health, camera.channel + " incomplete", camera.assembly.incomplete());
  add_drop(health, "sections skipped for time", skipped_sections_);
  for (int level = 1; level < Compromise::kLevels; ++level)
    add_drop(health, "frames in time by " + Compromise::at(level).text(),
             compromises_[static_cast<std::size_t>(level)]);
  if (!trouble_.empty()) worsen(health, health_t::DEGRADED, trouble_);
}

}  // namespace floornav
