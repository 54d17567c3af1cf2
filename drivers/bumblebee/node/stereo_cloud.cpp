#include "drivers/bumblebee/node/stereo_cloud.hpp"

#include "lcmtypes/depth_cloud.hpp"

namespace floornav {

depth_cloud_t stereo_cloud(const Pinhole& camera, double baseline_m, const Pose& T_body_sensor) {
  constexpr float kUsualSigma_px = 0.1F;  // for whoever does not read the uncertainties
  depth_cloud_t cloud{};
  cloud.sensor = depth_cloud_t::BUMBLEBEE;
  cloud.width = static_cast<std::int16_t>(camera.width);
  cloud.height = cloud.rows = static_cast<std::int16_t>(camera.height);
  cloud.fx = camera.fx;
  cloud.fy = camera.fy;
  cloud.cx = camera.cx;
  cloud.cy = camera.cy;
  cloud.baseline = static_cast<float>(baseline_m);
  cloud.disparity_sigma = kUsualSigma_px;
  pose_to_arrays(T_body_sensor, cloud.sensor_pos, cloud.sensor_orientation);
  cloud.meaning = depth_cloud_t::DISPARITY;
  cloud.scale = DisparityImage::kUnit_px;
  cloud.uncertainty_scale = DisparityImage::kSigmaUnit_px;
  return cloud;
}

void set_disparities(const DisparityImage& image, depth_cloud_t& cloud) {
  cloud.uncertainty = image.uncertainty;
  cloud.uncertainty_size = static_cast<std::int32_t>(image.uncertainty.size());
  pack_pixels(image.pixels, cloud);
}

}  // namespace floornav
