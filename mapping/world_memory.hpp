#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "mapping/evidence_reader.hpp"
#include "mapping/floor_height.hpp"
#include "mapping/frame_alignment.hpp"
#include "mapping/map_tiles.hpp"
#include "mapping/settings.hpp"
#include "mapping/view_coverage.hpp"
#include "perception/evidence.hpp"
#include "runtime/geometry/robot.hpp"

namespace floornav {

/// Fuses evidence into the lattice cells of the tiles.
class WorldMemory {
 public:
  WorldMemory(const MappingSettings& settings, const RobotSettings& robot);

  struct Taken {
    std::int64_t cells = 0;    ///< remembered
    std::int64_t refused = 0;  ///< impossible numbers, or out of range
  };
  /// `floor` tells what hangs above the robot.
  Taken take(const FloorEvidence& evidence, const FloorHeight& floor, MapTiles& tiles);

  /// Adds a plane of heights to all that is remembered and does not rest.
  void lift(const HeightError& by, const Lattice& lattice, MapTiles& tiles);
  /// A tile that has rested: all of it is to be judged.
  void take_woken(MapTile& tile);
  /// Tiles with evidence since the last call, sorted.
  std::vector<CellIndex> take_touched();
  void clear() { touched_.clear(); }

 private:
  using Entries = std::span<const std::uint32_t>;  ///< places in FloorEvidence::cells, all of one cell

  void sort_by_cell(const FloorEvidence& evidence, Taken& taken);
  void take_cell(const FloorEvidence& evidence, Entries entries, const FloorHeight& floor, MapTiles& tiles);
  [[nodiscard]] CellView view_of(const FloorEvidence& evidence, Entries entries);
  [[nodiscard]] float floor_z_m(const FloorEvidence& evidence, CellIndex cell, CellIndex vertex,
                                const FloorHeight& floor);
  bool split_overhead(CellMemory& memory, float limit_z_m);
  void touch(MapTile& tile, std::size_t vertex);
  void see_through_tops(const FloorEvidence& evidence, MapTiles& tiles);
  void see_through_tops(const FloorEvidence& evidence, const Eigen::Vector3d& sensor_m, MapTile& tile,
                        const MapTiles& tiles);
  [[nodiscard]] bool saw(const FloorEvidence& evidence, CellIndex cell, float z_m) const;

  MappingSettings settings_;
  EvidenceReader reader_;
  ViewCoverage coverage_;
  FusionLimits limits_;
  float drop_m_;                      ///< a sight line so far below the floor shows that there is none
  float overhead_m_;                  ///< above the floor, from where on nothing can be hit
  std::vector<std::uint32_t> order_;  ///< valid entries of the evidence, those of a cell together
  std::vector<Sighting> sightings_;
  std::vector<CellIndex> touched_;
  struct {
    CellIndex block;
    std::optional<float> height_m;
    bool known = false;
  } last_block_;  ///< the floor's height where the last cell was: neighbours ask again and again
};

}  // namespace floornav
