#pragma once

#include <CLI/CLI.hpp>

namespace floornav {

/// Adds `drive`: a robot driven through a scene, as a log with its truth beside it.
void add_drive_command(CLI::App& app);

}  // namespace floornav
