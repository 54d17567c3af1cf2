#include "tools/bench/matched_pairs.hpp"

#include "drivers/bumblebee/eye_images.hpp"
#include "drivers/bumblebee/node/stereo_cloud.hpp"

namespace floornav {
namespace {

StereoRigSpec wide_pair() {
  StereoRigSpec spec = bumblebee_xb3_rig();
  spec.eyes_m = {0.0, spec.baseline_m()};
  return spec;
}

StereoPipeline pipeline_for(const StereoRig& rig, const RoiSettings& roi, const Pose& T_body_sensor) {
  const Pinhole& ideal = rig.spec().ideal;
  const StereoSettings settings;
  Rectification rectification =
      rectification_of(rig.calibration(), cv::Size(ideal.width, ideal.height), false, 1);
  const MatchedRegion region{roi.x_min_m, roi.x_max_m, roi.y_min_m, roi.y_max_m, roi.z_min_m, roi.z_max_m};
  auto search = search_of(region, rectification.camera(), rectification.baseline_m(), T_body_sensor,
                          settings.nearest_m);
  return {settings, std::move(rectification), std::move(search)};
}

/// As the driver gets them: right eye's byte, then left eye's, pixel by pixel.
std::vector<std::uint8_t> interleaved(const std::vector<cv::Mat>& raw) {
  cv::Mat both;
  cv::merge(raw, both);
  return {both.datastart, both.dataend};
}

}  // namespace

MatchedPairs::MatchedPairs(const SensorSpec& sensor, const RoiSettings& roi, std::uint64_t seed)
    : T_body_sensor_(sensor.T_body_sensor),
      rig_(wide_pair(), seed),
      pipeline_(pipeline_for(rig_, roi, T_body_sensor_)) {}

depth_cloud_t MatchedPairs::see(const Shapes& shapes, const Pose& T_world_body, std::int64_t frame) {
  const Pinhole& camera = rig_.spec().ideal;
  EyeImages eyes({camera.width, camera.height, 2, rig_.spec().bayer});
  const std::vector<cv::Mat>& grey =
      eyes.split(interleaved(rig_.see(shapes, T_world_body * T_body_sensor_, frame)));
  Serial serial;
  DisparityImage image;
  pipeline_.match(grey.back(), grey.front(), serial, image);
  const Rectification& rectification = pipeline_.rectification();
  depth_cloud_t cloud = stereo_cloud(rectification.camera(), rectification.baseline_m(), T_body_sensor_);
  set_disparities(image, cloud);
  return cloud;
}

}  // namespace floornav
