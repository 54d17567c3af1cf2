#include "drivers/kinect/node/kinect_node.hpp"

#include <utility>

#include "drivers/camera/node/host_time.hpp"
#include "drivers/kinect/node/cloud_message.hpp"
#include "drivers/kinect/node/image_message.hpp"
#include "lcmtypes/depth_cloud.hpp"
#include "runtime/process/health.hpp"

namespace floornav {
namespace {

constexpr const char* kSparse = "is the sensor covered, nearer than 0.5 m, or in the sun?";

std::int64_t shortest_way_us(const KinectSettings& settings) {
  return static_cast<std::int64_t>(settings.exposure_to_arrival_ms * 1e3);
}

}  // namespace

KinectNode::KinectNode(const KinectSettings& settings, std::unique_ptr<FrameSource<CapturedFrame>> source,
                       std::function<void()> give_up)
    : settings_(settings),
      source_(std::move(source)),
      give_up_(std::move(give_up)),
      count_(shortest_way_us(settings)),
      content_(settings.least_valid, settings.stuck_after) {}

bool KinectNode::step(Micros now, Budget&, Outbox& out) {
  now_ = now;
  if (!source_->take(frame_)) return false;
  if (frame_.stream != stream_) begin(frame_.stream);
  const FrameCount::Counted counted =
      count_.count({frame_.number, frame_.stamp, frame_.arrival, frame_.dropped_before});
  cloud_.utime = counted.utime_us;
  cloud_.frame = counted.frame;
  if (counted.lost > 0) frames_.last_loss = now;
  frames_.verdict = content_.look_at(frame_.pixels);
  if (frames_.verdict == FrameContent::Verdict::kStuck)
    ++frames_.withheld;
  else
    publish(out);
  if (!frame_.color.rgb.empty()) publish_color(out);
  return true;
}

void KinectNode::tick(Micros, Outbox&) {
  if (give_up_ && source_->status().doing_us > kHopeless_us) std::exchange(give_up_, {})();
}

void KinectNode::begin(std::shared_ptr<const DepthStream> stream) {
  stream_ = std::move(stream);
  cloud_ = cloud_of(*stream_, settings_);
  count_.begin(shortest_way_us(settings_), stream_->counts_by_clock ? stream_->period_us : 0);
}

void KinectNode::publish(Outbox& out) {
  pack_pixels(frame_.pixels, cloud_);
  out.publish(settings_.channel, cloud_);
  latency_.add(Micros(host_time().monotonic_us - frame_.arrival.monotonic_us));
}

void KinectNode::publish_color(Outbox& out) {
  out.publish(settings_.color_channel,
              image_message(frame_.color, count_.clock().utime_near_last(frame_.color.stamp),
                            settings_.jpeg_quality));
}

void KinectNode::report(health_t& health) const {
  FrameHealth frames = frames_;
  frames.lost = count_.lost();
  report_capture(health, source_->status(), frames, now_, "OpenNI2", kSparse);
  add_latency(health, "frame to message", latency_);
}

}  // namespace floornav
