#include "drivers/bumblebee/node/bumblebee_node.hpp"

#include <span>
#include <utility>

#include "drivers/bumblebee/node/stereo_cloud.hpp"
#include "drivers/camera/node/capture_thread.hpp"
#include "runtime/process/health.hpp"

namespace floornav {
namespace {

constexpr const char* kSparse = "is a lens covered, the light out, or all nearer than nearest_m?";

/// Of the ideal left camera of a pair.
Pose sensor_pose(const MountingSettings& mounting, const EyePair& pair) {
  return sensor_in_body(mounting) * Eigen::Translation3d(pair.left_shift_m, 0, 0) *
         pair.rectification.T_left_ideal();
}

}  // namespace

BumblebeeNode::BumblebeeNode(const BumblebeeSettings& settings, const MatchedRegion& region,
                             std::unique_ptr<FrameSource<StereoFrame>> source, Parallel& parallel,
                             std::function<void()> give_up)
    : settings_(settings),
      region_(region),
      source_(std::move(source)),
      parallel_(parallel),
      give_up_(std::move(give_up)),
      content_(settings.least_valid, settings.stuck_after) {}

std::vector<std::string> BumblebeeNode::outputs() const {
  if (settings_.pair == "both") return {settings_.channel, settings_.narrow_channel};
  return {settings_.channel};
}

bool BumblebeeNode::step(Micros now, Budget&, Outbox& out) {
  now_ = now;
  if (!source_->take(frame_)) return false;
  if (frame_.stream != stream_) begin(frame_.stream);
  const FrameCount::Counted counted =
      count_.count({frame_.number, frame_.stamp, frame_.arrival, frame_.dropped_before});
  if (counted.lost > 0) frames_.last_loss = now;
  if (!trouble_.empty()) return true;
  match(counted);
  if (frames_.verdict == FrameContent::Verdict::kStuck)
    ++frames_.withheld;
  else
    publish(out);
  return true;
}

void BumblebeeNode::tick(Micros, Outbox&) {
  if (give_up_ && source_->status().doing_us > kHopeless_us) std::exchange(give_up_, {})();
}

void BumblebeeNode::begin(std::shared_ptr<const StereoStream> stream) {
  stream_ = std::move(stream);
  count_.begin(stream_->shortest_way_us, stream_->period_us);
  pairs_.clear();
  trouble_.clear();
  try {
    eyes_.emplace(stream_->layout);
    for (const EyePair& pair : stream_->pairs) pairs_.push_back(matched(pair));
  } catch (const std::runtime_error& error) {
    trouble_ = error.what();
  }
}

BumblebeeNode::Matched BumblebeeNode::matched(const EyePair& pair) const {
  const Rectification& rectification = pair.rectification;
  const Pinhole& camera = rectification.camera();
  const double baseline_m = rectification.baseline_m();
  const Pose T_body_sensor = sensor_pose(settings_.mounting, pair);
  const double nearest_m = settings_.stereo.nearest_m;
  std::vector<RowSearch> search = settings_.only_roi
                                      ? search_of(region_, camera, baseline_m, T_body_sensor, nearest_m)
                                      : search_everywhere(camera, baseline_m, nearest_m);
  const bool first = &pair == &stream_->pairs.front();
  return {pair.left,
          pair.right,
          first ? settings_.channel : settings_.narrow_channel,
          StereoPipeline(settings_.stereo, rectification, std::move(search)),
          {},
          stereo_cloud(camera, baseline_m, T_body_sensor)};
}

void BumblebeeNode::match(const FrameCount::Counted& counted) {
  const std::int64_t began_us = monotonic_us();
  const std::vector<cv::Mat>& eyes = eyes_->split(frame_.bytes);
  for (Matched& pair : pairs_) {
    pair.pipeline.match(eyes[pair.left], eyes[pair.right], parallel_, pair.image);
    pair.cloud.utime = counted.utime_us;
    pair.cloud.frame = counted.frame;
  }
  matching_.add(Micros(monotonic_us() - began_us));
  const Matched& pair = pairs_.front();
  const cv::Range rows = pair.pipeline.rows();
  const auto width = static_cast<std::size_t>(pair.image.width);
  frames_.verdict = content_.look_at(std::span(pair.image.pixels)
                                         .subspan(static_cast<std::size_t>(rows.start) * width,
                                                  static_cast<std::size_t>(rows.size()) * width));
}

void BumblebeeNode::publish(Outbox& out) {
  for (Matched& pair : pairs_) {
    set_disparities(pair.image, pair.cloud);
    out.publish(pair.channel, pair.cloud);
  }
  latency_.add(Micros(monotonic_us() - frame_.arrival.monotonic_us));
}

void BumblebeeNode::report(health_t& health) const {
  FrameHealth frames = frames_;
  frames.lost = count_.lost();
  if (!trouble_.empty()) worsen(health, health_t::FAULT, trouble_);
  report_capture(health, source_->status(), frames, now_, "libdc1394", kSparse);
  add_latency(health, "matching", matching_);
  add_latency(health, "frame to message", latency_);
}

}  // namespace floornav
