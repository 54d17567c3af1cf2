#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "runtime/geometry/lattice.hpp"
#include "runtime/geometry/pose.hpp"

namespace floornav {

/// All that a map remembers, apart from what follows from it: what is saved and loaded.
struct MapMemory {
  double pitch_m = 0;  ///< of the evidence's lattice, 0: nothing was ever seen
  std::int32_t cells_per_vertex = 1;
  std::int64_t utime_us = 0;             ///< of the newest evidence
  Pose T_world_body = Pose::Identity();  ///< where the robot was then
  std::optional<Pose> T_global_local;    ///< LOCAL_TO_GLOBAL then, where there was one
  std::vector<std::pair<CellIndex, std::vector<std::uint8_t>>> tiles;  ///< sorted; as pack() makes them
};

/// The bytes of a file: version, length and checksum first.
std::vector<std::uint8_t> to_bytes(const MapMemory& memory);

/// The inverse. Throws std::invalid_argument, saying what is wrong: no map, of another version, damaged.
MapMemory memory_from_bytes(std::span<const std::uint8_t> bytes);

}  // namespace floornav
