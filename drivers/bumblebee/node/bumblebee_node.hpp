#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "drivers/bumblebee/node/stereo_frame.hpp"
#include "drivers/bumblebee/roi_search.hpp"
#include "drivers/bumblebee/settings.hpp"
#include "drivers/bumblebee/stereo_pipeline.hpp"
#include "drivers/camera/frame_content.hpp"
#include "drivers/camera/frame_count.hpp"
#include "drivers/camera/node/capture_health.hpp"
#include "floornav/depth_cloud_t.hpp"
#include "runtime/geometry/parallel.hpp"
#include "runtime/process/latency.hpp"
#include "runtime/process/node.hpp"

namespace floornav {

/// Raw frames of a Bumblebee in, BUMBLEBEE_CLOUD out. A stuck image is not published: it would keep an old
/// floor alive. One in which nothing matches is: it says that nothing is seen.
class BumblebeeNode final : public Node {
 public:
  /// `region`: where anything is looked for. `give_up` is called, once, where libdc1394 has not come back
  /// from a call for 10 s: only a new process helps.
  BumblebeeNode(const BumblebeeSettings& settings, const MatchedRegion& region,
                std::unique_ptr<FrameSource<StereoFrame>> source, Parallel& parallel,
                std::function<void()> give_up);

  [[nodiscard]] std::string name() const override { return settings_.name; }
  [[nodiscard]] std::vector<std::string> outputs() const override;
  void set_wake(std::function<void()> wake) override { source_->notify(std::move(wake)); }
  void subscribe(Inbox&) override {}
  bool step(Micros now, Budget& budget, Outbox& out) override;
  void tick(Micros now, Outbox& out) override;
  void report(health_t& health) const override;

 private:
  /// What is done with a pair of eyes.
  struct Matched {
    std::size_t left;
    std::size_t right;
    std::string channel;
    StereoPipeline pipeline;
    DisparityImage image;
    depth_cloud_t cloud;
  };

  void begin(std::shared_ptr<const StereoStream> stream);
  [[nodiscard]] Matched matched(const EyePair& pair) const;
  void match(const FrameCount::Counted& counted);
  void publish(Outbox& out);

  BumblebeeSettings settings_;
  MatchedRegion region_;
  std::unique_ptr<FrameSource<StereoFrame>> source_;
  Parallel& parallel_;
  std::function<void()> give_up_;
  StereoFrame frame_;
  std::shared_ptr<const StereoStream> stream_;
  std::optional<EyeImages> eyes_;
  std::vector<Matched> pairs_;
  std::string trouble_;  ///< why the open camera's frames cannot be matched; empty: they can
  FrameCount count_{0};
  FrameContent content_;
  FrameHealth frames_;
  Micros now_{0};
  LatencyHistogram matching_;  ///< of a frame, all threads at work
  LatencyHistogram latency_;   ///< from a frame's arrival to its message
};

}  // namespace floornav
