#pragma once

#include <cstdint>
#include <span>

#include "floornav/depth_cloud_t.hpp"
#include "mapping/node/grid_map_message.hpp"
#include "mapping/node/mapper_node.hpp"
#include "mapping/node/terrain_map_message.hpp"
#include "perception/node/perception_node.hpp"
#include "runtime/process/replay_executor.hpp"
#include "tools/simulator/depth_sensor.hpp"

namespace floornav {

/// Perception and mapper on the messages of a simulated sensor, exactly as on the wire, and the map as a
/// subscriber of GRID_MAP holds it.
class FrameStack {
 public:
  FrameStack(const PerceptionSettings& perception, const MappingSettings& mapping,
             const RobotSettings& robot);

  /// One more frame, its body pose told exactly.
  void see(const DepthSensor& sensor, std::span<const std::uint16_t> pixels, const Pose& T_world_body);
  /// The same for a cloud, but for its time and number.
  void see(depth_cloud_t cloud, const Pose& T_world_body);

  [[nodiscard]] const GridMap& published() const { return receiver_.map(); }
  [[nodiscard]] const TerrainMap& terrain() const { return terrain_.map(); }
  /// Of all SURFELS and of all clouds so far, as encoded.
  [[nodiscard]] std::size_t surfel_bytes() const { return surfel_bytes_; }
  [[nodiscard]] std::size_t cloud_bytes() const { return cloud_bytes_; }

 private:
  void deliver(const EncodedMessage& message, std::int64_t utime_us);
  void hear(const EncodedMessage& message);

  Serial serial_;
  PerceptionNode perception_;
  MapperNode mapper_;
  GridMapReceiver receiver_;
  TerrainMapReceiver terrain_;
  std::size_t surfel_bytes_ = 0;
  std::size_t cloud_bytes_ = 0;
  ReplayExecutor executor_;
  Outbox out_;
  std::int64_t frames_ = 0;
};

}  // namespace floornav
