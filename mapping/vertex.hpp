#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "mapping/cell_memory.hpp"

namespace floornav {

/// What is known of a vertex of the map beside its surface.
struct Vertex {
  static constexpr std::uint8_t kSeen = 1;      ///< a surface decides
  static constexpr std::uint8_t kDrivable = 2;  ///< by its own slope and evenness
  static constexpr std::uint8_t kFloor = 4;     ///< joined to the robot's floor by open edges
  static constexpr std::uint8_t kCutOff = 8;    ///< every edge towards the robot's floor is closed by eq. (2)
  /// An edge goes through it; of one that was never seen: rays that should have found a floor went through.
  static constexpr std::uint8_t kFloorEnds = 16;
  static constexpr std::uint8_t kFree = 32;   ///< the verdict on a vertex that was seen
  static constexpr std::uint8_t kAsked = 64;  ///< the search for what is cut off has been here

  static constexpr std::uint8_t kStepped = 128;  ///< the edge of something goes through it
  std::uint8_t flags = 0;

  [[nodiscard]] bool is(std::uint8_t flag) const { return (flags & flag) != 0; }
  void set(std::uint8_t flag, bool value) {
    flags = static_cast<std::uint8_t>(value ? flags | flag : flags & ~flag);
  }
};

/// Steepest rise of a surface, degrees.
float slope_deg(const Surface& surface);

/// What decides in a square of lattice cells.
struct SquareSummary {
  bool seen = false;
  bool stepped = false;  ///< its cells, or the levels of one, are more than a step apart: the highest decides
  Surface surface;
};

/// The surface of `side` x `side` cells, row by row along x: their mean plane at the square's centre,
/// weighted by variance; but the highest cell (section 4.6: "the highest of them"), with its height in its
/// own place, where cells lie more than `step_m` and 3 sigma apart, or where none is more than a column.
/// Cells that are as high as that within their noise tell its height together.
SquareSummary summarise(std::span<const CellMemory> cells, std::int32_t side, float pitch_m, float step_m);

}  // namespace floornav
