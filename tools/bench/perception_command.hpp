#pragma once

#include <CLI/CLI.hpp>

namespace floornav {

/// Adds `perception`: time of each stage over the clouds of a log.
void add_perception_command(CLI::App& app);

}  // namespace floornav
