#pragma once

#include <filesystem>

#include "runtime/geometry/robot.hpp"
#include "tools/simulator/drivable.hpp"
#include "tools/simulator/drive.hpp"
#include "tools/simulator/scene.hpp"

namespace floornav {

/// Writes the truth beside a log: LOG.truth.yaml (what was driven where, by which robot) and LOG.truth.csv
/// (one line a cell: ix, iy, height, highest point below the robot's height, 1 where the robot can get).
/// Throws std::runtime_error where a file cannot be written.
void write_truth(const std::filesystem::path& log, const Scene& scene, const RobotSettings& robot,
                 const DriveSettings& settings, const DriveSummary& drive, const TruthGrid& truth);

}  // namespace floornav
