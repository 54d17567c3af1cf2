#pragma once

#include <CLI/CLI.hpp>

namespace floornav {

/// `floornav-bench mapping`: what the map costs, and how right it is.
void add_mapping_command(CLI::App& app);

}  // namespace floornav
