#pragma once

#include <filesystem>
#include <optional>

#include "floornav/path_t.hpp"

namespace floornav {

/// path.csv: x, y, z, heading and speed of each point; only the heading line where there is no path.
void write_path_table(const std::optional<path_t>& path, const std::filesystem::path& file);

}  // namespace floornav
