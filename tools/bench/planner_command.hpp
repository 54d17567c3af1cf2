#pragma once

#include <CLI/CLI.hpp>

namespace floornav {

/// Adds `planner`: path searches on the Moving AI maps, with Boost.Graph's A* beside them in the same run.
void add_planner_command(CLI::App& app);

}  // namespace floornav
