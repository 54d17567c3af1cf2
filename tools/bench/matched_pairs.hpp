#pragma once

#include <cstdint>

#include "drivers/bumblebee/stereo_pipeline.hpp"
#include "floornav/depth_cloud_t.hpp"
#include "perception/settings.hpp"
#include "tools/simulator/sensor_spec.hpp"
#include "tools/simulator/stereo/stereo_rig.hpp"

namespace floornav {

/// The wide pair of a Bumblebee XB3 on textured surfaces: images rendered, rectified and matched as the
/// driver does it by default.
class MatchedPairs {
 public:
  /// `sensor`: how it is mounted. Matches what `roi` can hold.
  MatchedPairs(const SensorSpec& sensor, const RoiSettings& roi, std::uint64_t seed);

  /// The cloud of one pair; time and number are left to the caller. Another `frame`, another noise.
  depth_cloud_t see(const Shapes& shapes, const Pose& T_world_body, std::int64_t frame);

 private:
  Pose T_body_sensor_;
  StereoRig rig_;
  StereoPipeline pipeline_;
};

}  // namespace floornav
