#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "floornav/map_request_t.hpp"
#include "floornav/pose_t.hpp"
#include "floornav/surfels_t.hpp"
#include "mapping/node/grid_map_message.hpp"
#include "mapping/node/map_keeper.hpp"
#include "mapping/node/tile_schedule.hpp"
#include "mapping/pose_jumps.hpp"
#include "mapping/settings.hpp"
#include "mapping/world_map.hpp"
#include "perception/node/surfels_message.hpp"
#include "runtime/geometry/robot.hpp"
#include "runtime/process/node.hpp"

namespace floornav {

/// SURFELS, POSE, LOCAL_TO_GLOBAL and MAP_REQUEST in, GRID_MAP and TERRAIN_MAP out.
///
/// A frame is fused when its last part is there, or when the rest is taken for lost: the next frame begins,
/// or 0.3 s pass. Then the tiles that changed go out, and those that the robot could reach before it stands;
/// every tick (0.1 s) a share of the tiles within 20 m, so that all have come round in less than 2 s, and
/// what was asked for. Once a second the terrain within 20 m. A tick's message comes even when nothing
/// changed. The map depends on the evidence alone, never on when ticks fall.
class MapperNode final : public Node {
 public:
  /// Throws std::runtime_error for a map that cannot be loaded.
  MapperNode(const MappingSettings& settings, const RobotSettings& robot, MapFiles files = {});

  [[nodiscard]] std::string name() const override { return "mapper"; }
  [[nodiscard]] std::vector<std::string> outputs() const override;
  void subscribe(Inbox& inbox) override;
  bool step(Micros now, Budget& budget, Outbox& out) override;
  void tick(Micros now, Outbox& out) override;
  void stop(Micros now, Outbox& out) override;
  void report(health_t& health) const override;

 private:
  /// A frame of which not all parts have come yet.
  struct OpenFrame {
    EvidenceSource source;
    FloorEvidence evidence;
    Micros begun{0};
  };

  void accept_part(const surfels_t& message);
  void accept_pose(const pose_t& pose);
  void accept_request(const map_request_t& request);
  void start_epoch_if_jumped(Outbox& out);
  void place_loaded_map(Outbox& out);
  void finish_frame(Outbox& out);
  void publish_tiles(const std::vector<CellIndex>& tiles, Outbox& out);
  void publish_terrain(Outbox& out);
  [[nodiscard]] Eigen::Vector2d robot_m() const;

  WorldMap world_;
  MapKeeper keeper_;
  PoseJumps jumps_;
  TileSchedule schedule_;
  double stopping_distance_m_;
  std::deque<EvidencePart> waiting_;
  std::optional<OpenFrame> open_;
  std::optional<std::int64_t> newest_jump_us_;  ///< evidence from before it belongs to no map
  std::optional<Pose> newest_pose_;             ///< T_world_body
  bool jumped_ = false;                         ///< and the epoch is still to be started
  std::int64_t ticks_ = 0;
  std::int64_t ticks_without_evidence_ = 0;
  std::string trouble_;  ///< with the last evidence; empty: it was taken
  std::map<std::string, std::int64_t> drops_;
};

}  // namespace floornav
