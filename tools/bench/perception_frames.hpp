#pragma once

#include <filesystem>
#include <vector>

#include "perception/node/perception_node.hpp"
#include "runtime/geometry/pose.hpp"
#include "tools/simulator/sensor_spec.hpp"

namespace floornav {

/// A frame's cloud messages and the body's pose at its time.
struct TimedFrame {
  CloudStrips strips;
  Pose T_world_body;
};

/// The clouds of both cameras in a log that have a pose. Throws std::runtime_error where there are none.
std::vector<TimedFrame> frames_of_log(const std::filesystem::path& log);

/// Frames of a sensor that looks at bench_scene(), each with noise of its own.
std::vector<TimedFrame> rendered_frames(SensorKind sensor, int frames);

}  // namespace floornav
