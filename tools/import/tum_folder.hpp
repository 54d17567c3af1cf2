#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "runtime/geometry/pose.hpp"

namespace floornav {

/// One line of depth.txt.
struct ListedImage {
  std::int64_t utime_us = 0;
  std::filesystem::path file;
};

/// One line of groundtruth.txt: the camera (x right, y down, z forward) in the world.
struct StampedPose {
  std::int64_t utime_us = 0;
  Pose T_world_camera = Pose::Identity();
};

/// Reads a TUM list "timestamp filename"; names are relative to the list's folder. Sorted by time. Throws
/// std::runtime_error naming file and line for what it cannot read.
std::vector<ListedImage> read_image_list(const std::filesystem::path& list);

/// Reads a TUM trajectory "timestamp tx ty tz qx qy qz qw". Sorted by time, equal times once. Throws
/// likewise.
std::vector<StampedPose> read_trajectory(const std::filesystem::path& file);

}  // namespace floornav
