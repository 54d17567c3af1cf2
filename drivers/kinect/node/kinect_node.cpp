#include "drivers/kinect/node/kinect_node.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "drivers/kinect/node/cloud_message.hpp"
#include "drivers/kinect/node/host_time.hpp"
#include "drivers/kinect/node/image_message.hpp"
#include "lcmtypes/depth_cloud.hpp"
#include "runtime/process/health.hpp"

namespace floornav {
namespace {

using namespace std::chrono_literals;

constexpr Micros kLossRemembered = 2s;
constexpr std::int64_t kHanging_us = 2'000'000;
constexpr std::int64_t kHopeless_us = 10'000'000;

std::int64_t shortest_way_us(const KinectSettings& settings) {
  return static_cast<std::int64_t>(settings.exposure_to_arrival_ms * 1e3);
}

const char* name_of(FrameContent::Verdict verdict) {
  switch (verdict) {
    case FrameContent::Verdict::kSparse:
      return "few pixels measure anything: is the sensor too near, or in the sun?";
    case FrameContent::Verdict::kEmpty:
      return "no pixel measures anything: is the sensor covered, or nearer than 0.5 m?";
    case FrameContent::Verdict::kStuck:
      return "the same image again and again: nothing is published";
    default:
      return "";
  }
}

}  // namespace

KinectNode::KinectNode(const KinectSettings& settings, std::unique_ptr<FrameSource> source,
                       std::function<void()> give_up)
    : settings_(settings),
      source_(std::move(source)),
      give_up_(std::move(give_up)),
      clock_(shortest_way_us(settings)),
      content_(settings.least_valid, settings.stuck_after) {}

bool KinectNode::step(Micros now, Budget&, Outbox& out) {
  now_ = now;
  if (!source_->take(frame_)) return false;
  if (frame_.stream != stream_) begin(frame_.stream);
  cloud_.utime = clock_.utime_of(frame_.stamp, frame_.arrival);
  const std::int64_t missing = gaps_.missing_before(frame_.number, clock_.device_us());
  const std::int64_t lost = std::max<std::int64_t>(0, missing - frame_.dropped_before);
  if (lost > 0) last_loss_ = now;
  lost_ += lost;
  cloud_.frame += 1 + missing;
  verdict_ = content_.look_at(frame_.pixels);
  if (verdict_ == FrameContent::Verdict::kStuck)
    ++withheld_;
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
  const std::int64_t frame = cloud_.frame;
  cloud_ = cloud_of(*stream_, settings_);
  cloud_.frame = frame;
  clock_ = DeviceClock(shortest_way_us(settings_));
  gaps_ = FrameGaps(stream_->counts_by_clock ? stream_->period_us : 0);
}

void KinectNode::publish(Outbox& out) {
  pack_pixels(frame_.pixels, cloud_);
  out.publish(settings_.channel, cloud_);
  latency_.add(Micros(host_time().monotonic_us - frame_.arrival.monotonic_us));
}

void KinectNode::publish_color(Outbox& out) {
  out.publish(settings_.color_channel, image_message(frame_.color, clock_.utime_near_last(frame_.color.stamp),
                                                     settings_.jpeg_quality));
}

void KinectNode::report(health_t& health) const {
  const CaptureStatus status = source_->status();
  if (status.doing_us > kHanging_us)
    worsen(
        health, health_t::FAULT,
        fmt::format("OpenNI2 has not come back from {} for {} s", status.doing, status.doing_us / 1'000'000));
  if (!status.trouble.empty()) {
    worsen(health, health_t::FAULT, status.trouble);
  } else if (verdict_ != FrameContent::Verdict::kGood) {
    const bool stuck = verdict_ == FrameContent::Verdict::kStuck;
    worsen(health, stuck ? health_t::FAULT : health_t::DEGRADED, name_of(verdict_));
  }
  if (last_loss_ > 0us && now_ - last_loss_ < kLossRemembered)
    worsen(health, health_t::DEGRADED, "the device loses frames");
  add_drop(health, "frame lost by the device", lost_);
  add_drop(health, "frame stuck", withheld_);
  for (const auto& [cause, count] : status.drops) add_drop(health, cause, count);
  add_drop(health, "device opened anew", status.opened - 1);
  add_latency(health, "frame to message", latency_);
}

}  // namespace floornav
