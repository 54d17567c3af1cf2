#pragma once

#include <filesystem>

namespace floornav {

/// Prints what the planner takes on large maps, with costs and after changes: a line a goal with what was
/// measured beside it. `movingai_folder` has the maps that are upscaled.
void print_planner_goals(const std::filesystem::path& movingai_folder);

}  // namespace floornav
