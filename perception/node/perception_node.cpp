#include "perception/node/perception_node.hpp"

#include <cmath>
#include <stdexcept>

#include "lcmtypes/channels.hpp"
#include "lcmtypes/depth_codec.hpp"
#include "perception/node/surfels_message.hpp"
#include "runtime/process/health.hpp"

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
constexpr double kMaxPosition_m = 1e5;

}  // namespace

PerceptionNode::PerceptionNode(const PerceptionSettings& settings, const RobotSettings& robot,
                               Parallel& parallel)
    : parallel_(parallel),
      cameras_{Camera{channel::kKinectCloud, FloorPerception(settings, robot), {}},
               Camera{channel::kBumblebeeCloud, FloorPerception(settings, robot), {}}} {}

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
}

void PerceptionNode::accept_cloud(std::size_t camera, const depth_cloud_t& cloud, Micros now) {
  auto frame = cameras_[camera].assembly.add(cloud);
  if (!frame) return;
  waiting_.push_back({camera, std::move(*frame), now});
  if (waiting_.size() > kMaxWaiting) drop(0, "overtaken");
}

void PerceptionNode::accept_pose(const pose_t& pose) {
  const Pose T_world_body = pose_from_arrays(pose.pos, pose.orientation);
  if (T_world_body.translation().cwiseAbs().maxCoeff() > kMaxPosition_m)
    throw std::invalid_argument("pose: absurd position");
  if (const auto newest = poses_.newest_utime()) {
    const bool stepped = pose.utime > *newest + kMaxPoseGap_us || pose.utime < *newest - kMaxPoseGap_us;
    if (stepped) {
      poses_.clear();
      ++drops_["pose stream interrupted"];
    }
  }
  if (!poses_.insert(pose.utime, T_world_body)) ++drops_["pose out of order"];
}

bool PerceptionNode::step(Micros now, Budget& budget, Outbox& out) {
  for (std::size_t i = 0; i < waiting_.size();) {
    const auto pose = poses_.at(waiting_[i].utime_us());
    if (pose && !is_overtaken(i, now)) {
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

/// True where the cloud has waited long and a newer one of its camera could be processed instead.
bool PerceptionNode::is_overtaken(std::size_t waiting, Micros now) const {
  if (now - waiting_[waiting].arrival <= kPoseWait) return false;
  for (std::size_t i = waiting + 1; i < waiting_.size(); ++i)
    if (waiting_[i].camera == waiting_[waiting].camera && poses_.at(waiting_[i].utime_us())) return true;
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
  budget.begin(cloud.arrival);
  const FloorEvidence& evidence = camera.perception.process(
      frame, T_world_body, parallel_, [&](std::int64_t work_ns) { return budget.spend(work_ns); });
  const depth_cloud_t& first = cloud.strips.front();
  for (surfels_t& message : to_messages(evidence, {first.source, first.session, first.frame, first.sensor}))
    out.publish(channel::kSurfels, std::move(message));
}

void PerceptionNode::report(health_t& health) const {
  for (const auto& [cause, count] : drops_) add_drop(health, cause, count);
  for (const Camera& camera : cameras_)
    add_drop(health, camera.channel + " incomplete", camera.assembly.incomplete());
  if (!trouble_.empty()) worsen(health, health_t::DEGRADED, trouble_);
}

}  // namespace floornav
