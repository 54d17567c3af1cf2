#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mapping/map_tile.hpp"

namespace floornav {

/// A tile's memory in a few bytes a cell, for tiles far from the robot and for files: heights to 0.1 mm,
/// rises to 1/1024, variances to 9 %, times to 0.1 s; which vertices are the robot's floor. The rest of a
/// tile follows from these. Packing what was unpacked gives the same bytes.
std::vector<std::uint8_t> pack(const MapTile& tile);

/// The inverse, into a tile of `cells`; its vertices are left to be summarised. Throws std::invalid_argument
/// for bytes that pack() does not make.
void unpack(std::span<const std::uint8_t> bytes, std::size_t cells, MapTile& tile);

}  // namespace floornav
