#pragma once

#include <array>
#include <atomic>
#include <string>

#include "tests/devices/live/live_camera.hpp"

namespace floornav {

/// What a live stack is asked to do.
struct LiveTask {
  std::array<double, 2> goal_m = {3.0, 0.0};  ///< local frame
  double seconds = 0;
  double unplug_at_s = 0;  ///< the camera is unplugged then, for two seconds and a half; 0: never
  int may_lose = 0;        ///< frames
  std::string lcm_url;
};

/// What it did.
struct LiveReport {
  std::string text;  ///< a table for a person
  std::string flaw;  ///< why the run is no good; empty: it is
};

/// The base of a robot that drives as its camera shows: sends its POSE at 100 Hz, in step with what is seen,
/// and a GOAL once a second, and watches what the stack says. Begins with the first cloud.
LiveReport drive_live(const LiveCamera& camera, const LiveTask& task, const std::atomic<bool>& stop);

}  // namespace floornav
