#pragma once

#include <filesystem>
#include <string>

#include "tools/simulate/closed_loop.hpp"

namespace floornav {

/// The map that a run ended with, what truly stands there, what was driven and what was planned last. Throws
/// std::runtime_error where the file cannot be written.
void write_run_picture(const RandomWorld& world, const RobotSettings& robot, const RunRecord& record,
                       const std::string& title, const std::filesystem::path& file);

}  // namespace floornav
