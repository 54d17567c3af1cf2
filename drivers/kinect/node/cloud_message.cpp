#include "drivers/kinect/node/cloud_message.hpp"

#include "drivers/camera/mounting.hpp"

namespace floornav {

depth_cloud_t cloud_of(const DepthStream& stream, const KinectSettings& settings) {
  constexpr double k3m = 3.0;
  depth_cloud_t cloud{};
  cloud.sensor = depth_cloud_t::KINECT;
  cloud.width = static_cast<std::int16_t>(stream.camera.width);
  cloud.height = cloud.rows = static_cast<std::int16_t>(stream.camera.height);
  cloud.fx = stream.camera.fx;
  cloud.fy = stream.camera.fy;
  cloud.cx = stream.camera.cx;
  cloud.cy = stream.camera.cy;
  cloud.baseline = static_cast<float>(settings.baseline_m);
  const double fx = static_cast<double>(stream.camera.fx);
  cloud.disparity_sigma =
      static_cast<float>(settings.depth_sigma_at_3m_m / (k3m * k3m) * fx * settings.baseline_m);
  pose_to_arrays(sensor_in_body(settings.mounting), cloud.sensor_pos, cloud.sensor_orientation);
  cloud.meaning = depth_cloud_t::DEPTH;
  cloud.scale = stream.count_m;
  return cloud;
}

}  // namespace floornav
