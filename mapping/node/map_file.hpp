#pragma once

#include <filesystem>

#include "mapping/map_memory.hpp"

namespace floornav {

/// Writes a map beside the file and moves it there when all of it is on the disk: whenever the process or the
/// machine ends, the file is the old map or the new one. Throws std::runtime_error, naming the file.
void save_map(const MapMemory& memory, const std::filesystem::path& file);

/// Throws std::runtime_error, naming the file and what is wrong with it.
MapMemory load_map(const std::filesystem::path& file);

}  // namespace floornav
