#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <string>

#include "tests/devices/kinect/log_scene.hpp"
#include "tests/devices/kinect/virtual_kinect.hpp"

namespace floornav {

/// What a live stack did.
struct LiveReport {
  std::int64_t raised = 0;  ///< frames that the virtual Kinect handed to OpenNI2
  std::string text;         ///< a table for a person
  std::string flaw;         ///< why the run is no good; empty: it is
};

/// The base of a robot that drives as a log's did: sends its POSE at 100 Hz, in step with what the virtual
/// Kinect sees, and a GOAL once a second, and watches what the stack says, for so long. Not before the first
/// cloud. A flaw: a process that says nothing, a frame that nobody accounts for, more than `may_lose` lost.
LiveReport drive_live(VirtualKinect& kinect, const LogScene& scene, std::array<double, 2> goal_m,
                      double seconds, int may_lose, const std::string& lcm_url,
                      const std::atomic<bool>& stop);

}  // namespace floornav
