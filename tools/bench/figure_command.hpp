#pragma once

#include <CLI/CLI.hpp>

namespace floornav {

/// Adds `figure`: the paper's figures 1, 2 and 7, drawn from what the stack does here.
void add_figure_command(CLI::App& app);

}  // namespace floornav
