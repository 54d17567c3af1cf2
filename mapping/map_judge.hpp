#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mapping/edges.hpp"
#include "mapping/floor_height.hpp"
#include "mapping/floor_reach.hpp"
#include "mapping/grid_map.hpp"
#include "mapping/map_tiles.hpp"
#include "mapping/settings.hpp"
#include "runtime/geometry/pose.hpp"
#include "runtime/geometry/robot.hpp"

namespace floornav {

/// Makes the grid-map of what the tiles remember: who is free, who is blocked, which edges are open.
class MapJudge {
 public:
  MapJudge(const MappingSettings& settings, const RobotSettings& robot);

  /// Judges the tiles in `dirty` and those around them. Counts up the map's version, and returns the tiles of
  /// `map` that changed, sorted.
  std::vector<CellIndex> refresh(const std::vector<CellIndex>& dirty, const Pose& T_world_body,
                                 MapTiles& tiles, GridMap& map);

  [[nodiscard]] const FloorHeight& floor() const { return floor_; }
  [[nodiscard]] float max_step_m() const { return rule_.max_step_m; }
  void clear() { floor_.clear(); }

 private:
  /// Both: false where nothing that matters differs from before.
  bool summarise_touched(MapTile& tile, std::int32_t cells_per_vertex) const;
  bool take_summary(std::span<const CellMemory> cells, std::int32_t side, MapTile& tile, std::size_t i) const;
  [[nodiscard]] Surface told(const VertexRef& place) const;
  bool judge(MapTile& tile, const Pose& T_world_body);
  bool judge_vertex(const VertexRef& place, float floor_m);
  static bool publish_edges(MapTile& tile);

  MappingSettings settings_;
  StepRule rule_;
  FloorReach reach_;
  FloorHeight floor_;
  float min_belief_;  ///< section 4.6
  float max_rise_;    ///< rise per metre of the steepest floor that the robot drives
  std::vector<float> floor_heights_m_;
  std::array<std::int16_t, GridTile::kVertices> heights_{};  ///< of a tile's vertices, as it is sent
};

}  // namespace floornav
