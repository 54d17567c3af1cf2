#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "floornav/path_t.hpp"
#include "floornav/pose_t.hpp"
#include "perception/floor_perception.hpp"
#include "perception/node/cloud_assembly.hpp"
#include "runtime/geometry/parallel.hpp"
#include "runtime/geometry/pose_history.hpp"
#include "runtime/process/node.hpp"

namespace floornav {

/// KINECT_CLOUD, BUMBLEBEE_CLOUD and POSE in, SURFELS out; PATH only says which sections come first. A cloud
/// waits up to 100 ms for two body poses around its time; one that gets none is dropped and counted, as are
/// corrupt ones and those past their deadline that a newer one has overtaken. The nearest row of sections
/// leaves as soon as it is done.
class PerceptionNode final : public Node {
 public:
  /// `parallel` must outlive the node. Throws std::invalid_argument for an empty ROI.
  PerceptionNode(const PerceptionSettings& settings, const RobotSettings& robot, Parallel& parallel);

  [[nodiscard]] std::string name() const override { return "perception"; }
  [[nodiscard]] std::vector<std::string> outputs() const override;
  void subscribe(Inbox& inbox) override;
  bool step(Micros now, Budget& budget, Outbox& out) override;
  void tick(Micros /*now*/, Outbox& /*out*/) override {}
  [[nodiscard]] std::optional<Micros> deadline() const override;
  void report(health_t& health) const override;

 private:
  /// One camera's channel: its own last known normals.
  struct Camera {
    std::string channel;
    FloorPerception perception;
    CloudAssembly assembly;
    CompromiseControl control;
    std::optional<std::int64_t> last_utime_us;
    Micros period;            ///< between its last two frames
    std::int64_t points = 0;  ///< of the last frame, at full density
    Compromise compromise;    ///< of the last frame
  };
  struct WaitingCloud {
    std::size_t camera;
    CloudStrips strips;
    Micros arrival;
    [[nodiscard]] std::int64_t utime_us() const { return strips.front().utime; }
  };

  void accept_cloud(std::size_t camera, const depth_cloud_t& cloud, Micros now);
  void accept_pose(const pose_t& pose);
  void accept_path(const path_t& path);
  [[nodiscard]] bool is_overtaken(std::size_t waiting, Micros now, Budget& budget) const;
  [[nodiscard]] bool has_absurd_time(const WaitingCloud& cloud) const;
  void drop(std::size_t waiting, const std::string& cause);
  void process(const WaitingCloud& cloud, const Pose& T_world_body, Budget& budget, Outbox& out);
  void choose_compromise(Camera& camera, const DepthFrame& frame, const Budget& budget) const;

  TimeSettings time_;
  Parallel& parallel_;
  std::array<Camera, 2> cameras_;
  PoseHistory poses_;
  std::deque<WaitingCloud> waiting_;  ///< in the order of arrival
  FramePixels memory_;
  std::map<std::string, std::int64_t> drops_;  ///< by cause
  std::int64_t skipped_sections_ = 0;
  std::array<std::int64_t, Compromise::kLevels> compromises_{};  ///< frames at each level
  std::string trouble_;  ///< with the last cloud; empty: it was processed
};

}  // namespace floornav
