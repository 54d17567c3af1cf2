#pragma once

#include <cstdint>
#include <vector>

#include "mapping/grid_map.hpp"
#include "mapping/map_judge.hpp"
#include "mapping/map_memory.hpp"
#include "mapping/map_tiles.hpp"
#include "mapping/settings.hpp"
#include "mapping/terrain_builder.hpp"
#include "mapping/terrain_map.hpp"
#include "mapping/world_memory.hpp"
#include "perception/evidence.hpp"
#include "runtime/geometry/robot.hpp"

namespace floornav {

/// The world's memory: fuses the evidence of frames into a grid-map (sections 3.1, 3.2, 4.6) and a terrain
/// map.
///
/// A vertex is *blocked* where what decides in it - the highest surface below the robot's clearance - is no
/// plane, is steeper than the robot drives, has a belief under what its robot asks for, has an edge going
/// through it, or is cut off from the robot's floor by eq. (2); so is a place beside the floor where rays
/// should have found a floor and brought nothing back. The rest of what was seen is *free*; what was never
/// seen is *unknown*. The robot's floor is what open edges join to the level ground near the robot.
///
/// The result depends on the evidence and its order alone. The cost of an update follows the tiles with new
/// evidence. What lies farther from the robot than it can see is kept packed until it comes back.
class WorldMap {
 public:
  WorldMap(const MappingSettings& settings, const RobotSettings& robot);

  /// Remembers a frame, aligned to what is remembered; the maps follow with refresh() and refresh_terrain().
  /// Throws std::invalid_argument, and nothing changes, where the evidence's lattice does not divide the
  /// map's resolutions or is not that of the evidence before.
  WorldMemory::Taken integrate(const FloorEvidence& evidence);

  /// Judges anew what was touched since the last refresh. Returns the tiles of the grid-map that changed,
  /// sorted.
  std::vector<CellIndex> refresh();
  /// The same for the terrain. Now and then: packs what the robot has left behind.
  std::vector<CellIndex> refresh_terrain();

  /// All that is remembered.
  [[nodiscard]] MapMemory memory() const;
  /// Begins a new epoch with what was remembered before, judged by this robot. Throws std::invalid_argument,
  /// and nothing changes, for another lattice or resolution, or bytes that are no tile's.
  void restore(const MapMemory& memory);

  /// Forgets everything, because the pose has jumped. The epoch counts up.
  void start_epoch();

  [[nodiscard]] const GridMap& grid() const { return grid_; }
  [[nodiscard]] const TerrainMap& terrain() const { return terrain_; }
  [[nodiscard]] std::int64_t utime_us() const { return utime_us_; }  ///< of the newest evidence, 0: none yet
  [[nodiscard]] const Pose& T_world_body() const { return T_world_body_; }  ///< of the newest evidence
  [[nodiscard]] float max_step_m() const { return judge_.max_step_m(); }    ///< T of eq. (2)
  /// Of all that the mapper keeps.
  [[nodiscard]] std::int64_t memory_bytes() const;

 private:
  void take_lattice(double pitch_m);
  void wake_around(const Pose& T_world_body);
  /// What is taken off the first frame of an epoch, that lies so far off a level floor.
  [[nodiscard]] HeightError begin_level(const HeightError& error);
  /// Which part of a frame's error is the frame's own. The rest is the map's: it is moved.
  [[nodiscard]] HeightError split_error(const HeightError& error);
  [[nodiscard]] double tile_side_m() const { return grid_.lattice().pitch_m * MapTile::kSide; }

  AlignmentSettings alignment_;
  double max_range_m_;
  WorldMemory memory_;
  MapJudge judge_;
  MapTiles tiles_;
  GridMap grid_;
  TerrainMap terrain_;
  TerrainBuilder terrain_builder_;
  double pitch_m_ = 0;  ///< of the evidence's lattice, 0: none yet
  std::int32_t cells_per_height_ = 1;
  int settled_frames_ = 0;   ///< of this epoch, up to kFramesToSettle
  double level_frames_ = 0;  ///< that the level floor, on which this epoch began, counts for
  std::int64_t utime_us_ = 0;
  Pose T_world_body_ = Pose::Identity();
};

}  // namespace floornav
