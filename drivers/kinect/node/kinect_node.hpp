#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "drivers/camera/frame_content.hpp"
#include "drivers/camera/frame_count.hpp"
#include "drivers/camera/node/capture_health.hpp"
#include "drivers/kinect/node/captured_frame.hpp"
#include "drivers/kinect/settings.hpp"
#include "floornav/depth_cloud_t.hpp"
#include "runtime/process/latency.hpp"
#include "runtime/process/node.hpp"

namespace floornav {

/// Frames of a Kinect in, KINECT_CLOUD and, where colour is on, KINECT_IMAGE out. A stuck image is not
/// published: it would keep an old floor alive. An empty one is: it says that nothing is seen.
class KinectNode final : public Node {
 public:
  /// `give_up` is called, once, where OpenNI2 has not come back from a call for 10 s: only a new process
  /// helps.
  KinectNode(const KinectSettings& settings, std::unique_ptr<FrameSource<CapturedFrame>> source,
             std::function<void()> give_up);

  [[nodiscard]] std::string name() const override { return settings_.name; }
  [[nodiscard]] std::vector<std::string> outputs() const override {
    return {settings_.channel, settings_.color_channel};
  }
  void set_wake(std::function<void()> wake) override { source_->notify(std::move(wake)); }
  void subscribe(Inbox&) override {}
  bool step(Micros now, Budget& budget, Outbox& out) override;
  void tick(Micros now, Outbox& out) override;
  void report(health_t& health) const override;

 private:
  void begin(std::shared_ptr<const DepthStream> stream);
  void publish(Outbox& out);
  void publish_color(Outbox& out);

  KinectSettings settings_;
  std::unique_ptr<FrameSource<CapturedFrame>> source_;
  std::function<void()> give_up_;
  CapturedFrame frame_;
  std::shared_ptr<const DepthStream> stream_;
  FrameCount count_;
  FrameContent content_;
  FrameHealth frames_;
  depth_cloud_t cloud_;
  Micros now_{0};
  LatencyHistogram latency_;  ///< from a frame's arrival to its message
};

}  // namespace floornav
