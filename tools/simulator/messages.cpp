#include "tools/simulator/messages.hpp"

#include <Eigen/Geometry>

#include "lcmtypes/depth_cloud.hpp"

namespace floornav {

depth_cloud_t cloud_message(const DepthSensor& sensor, std::span<const std::uint16_t> pixels,
                            std::int64_t utime_us, std::int64_t frame) {
  const SensorSpec& model = sensor.model();
  const bool is_kinect = model.kind == SensorKind::kKinect;
  depth_cloud_t cloud{};
  cloud.utime = utime_us;
  cloud.sensor = is_kinect ? depth_cloud_t::KINECT : depth_cloud_t::BUMBLEBEE;
  cloud.frame = frame;
  cloud.width = static_cast<std::int16_t>(model.camera.width);
  cloud.height = static_cast<std::int16_t>(model.camera.height);
  cloud.rows = cloud.height;
  cloud.fx = model.camera.fx;
  cloud.fy = model.camera.fy;
  cloud.cx = model.camera.cx;
  cloud.cy = model.camera.cy;
  cloud.baseline = static_cast<float>(model.baseline_m);
  cloud.disparity_sigma = static_cast<float>(model.noise.sigma_px / model.decimation);
  pose_to_arrays(model.T_body_sensor, cloud.sensor_pos, cloud.sensor_orientation);
  cloud.meaning = is_kinect ? depth_cloud_t::DEPTH : depth_cloud_t::DISPARITY;
  cloud.scale = static_cast<float>(sensor.unit());
  pack_pixels(pixels, cloud);
  return cloud;
}

pose_t pose_message(std::int64_t utime_us, const Pose& T_world_body, const Pose& before, const Pose& after,
                    double span_s) {
  pose_t message{};
  message.utime = utime_us;
  pose_to_arrays(T_world_body, message.pos, message.orientation);
  const Eigen::Matrix3d R = T_world_body.linear();
  const Eigen::Vector3d velocity = R.transpose() * (after.translation() - before.translation()) / span_s;
  const Eigen::Matrix3d turn = R.transpose() * (after.linear() - before.linear()) / span_s;
  const Eigen::Vector3d rate(0.5 * (turn(2, 1) - turn(1, 2)), 0.5 * (turn(0, 2) - turn(2, 0)),
                             0.5 * (turn(1, 0) - turn(0, 1)));
  Eigen::Map<Eigen::Vector3d>{message.vel} = velocity;
  Eigen::Map<Eigen::Vector3d>{message.rotation_rate} = rate;
  return message;
}

}  // namespace floornav
