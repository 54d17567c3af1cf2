#pragma once

#include <map>
#include <vector>

#include <gtest/gtest.h>

#include "floornav/depth_cloud_t.hpp"
#include "floornav/pose_t.hpp"
#include "lcmtypes/channels.hpp"
#include "lcmtypes/depth_cloud.hpp"
#include "runtime/geometry/pose.hpp"
#include "runtime/process/log_reader.hpp"

namespace floornav {

/// A cloud of a log with the pose that stood in the log before it.
struct RecordedCloud {
  depth_cloud_t message;
  std::vector<std::uint16_t> pixels;
  Pose T_body_sensor;
  Pose T_world_body;  ///< of the POSE with the cloud's own utime
};

/// Every cloud of a log. A test fails here where an event is out of order or a cloud has no POSE of its utime
/// before it.
inline std::vector<RecordedCloud> recorded_clouds(const std::filesystem::path& log) {
  LogReader reader(log);
  LogEvent event;
  std::int64_t last_us = 0;
  std::map<std::int64_t, Pose> poses;
  std::vector<RecordedCloud> clouds;
  while (reader.next(event)) {
    EXPECT_GE(event.timestamp_us, last_us);
    last_us = event.timestamp_us;
    const int size = static_cast<int>(event.bytes.size());
    if (event.channel == channel::kPose) {
      pose_t pose{};
      EXPECT_EQ(pose.decode(event.bytes.data(), 0, size), size);
      poses[pose.utime] = pose_from_arrays(pose.pos, pose.orientation);
      continue;
    }
    RecordedCloud cloud{};
    EXPECT_EQ(cloud.message.decode(event.bytes.data(), 0, size), size);
    unpack_pixels(cloud.message, cloud.pixels);
    EXPECT_TRUE(poses.contains(cloud.message.utime));
    cloud.T_world_body = poses[cloud.message.utime];
    cloud.T_body_sensor = pose_from_arrays(cloud.message.sensor_pos, cloud.message.sensor_orientation);
    clouds.push_back(std::move(cloud));
  }
  return clouds;
}

}  // namespace floornav
