#pragma once

#include <CLI/CLI.hpp>

namespace floornav {

/// Adds `outliers`: the search in the image window against nanoflann on the same points in one run.
void add_outliers_command(CLI::App& app);

}  // namespace floornav
