#pragma once

#include <CLI/CLI.hpp>

namespace floornav {

/// Adds `closed-loop`: the stack drives a simulated robot through random worlds.
void add_closed_loop_command(CLI::App& app);

}  // namespace floornav
