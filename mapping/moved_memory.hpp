#pragma once

#include "mapping/map_memory.hpp"

namespace floornav {

/// The map in another frame: every cell of the new lattice takes what the old one remembers at its centre,
/// heights moved along the cell's rise. Only the heading and the translation of `T_new_old` count: both
/// frames have z up.
MapMemory moved(const MapMemory& memory, const Pose& T_new_old);

}  // namespace floornav
