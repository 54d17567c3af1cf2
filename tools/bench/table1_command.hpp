#pragma once

#include <CLI/CLI.hpp>

namespace floornav {

/// Adds `table1`: the paper's Table 1, measured here and printed beside the paper's.
void add_table1_command(CLI::App& app);

}  // namespace floornav
