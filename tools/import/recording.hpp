#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "drivers/bumblebee/stereo_matcher.hpp"
#include "floornav/depth_cloud_t.hpp"
#include "runtime/geometry/pinhole.hpp"
#include "runtime/geometry/pose.hpp"
#include "runtime/process/log_writer.hpp"
#include "tools/import/depth_image.hpp"
#include "tools/import/imported_sensor.hpp"

namespace floornav {

/// A log of clouds and poses in the making. It appears under its name when finish() is called and not before;
/// without it nothing stays behind.
class Recording {
 public:
  /// Throws LogError where the file cannot be made.
  Recording(std::filesystem::path file, const ImportedSensor& sensor);
  ~Recording();
  Recording(const Recording&) = delete;
  Recording& operator=(const Recording&) = delete;

  /// The body in the local frame. A time that is not after the last pose's is left out.
  void pose(std::int64_t utime_us, const Pose& T_world_body);
  /// One frame of depths; `scale_m` is m a count. Throws std::runtime_error where its size is not the first
  /// one's, or the camera does not go with it.
  void cloud(std::int64_t utime_us, const DepthImage& image, const Pinhole& camera, double scale_m,
             const Pose& T_body_sensor);
  /// One frame of disparities of a camera with this baseline, each with its uncertainty. Throws likewise.
  void cloud(std::int64_t utime_us, const DisparityImage& image, const Pinhole& camera, double baseline_m,
             const Pose& T_body_sensor);
  void finish();

  [[nodiscard]] std::int64_t clouds() const { return clouds_; }
  [[nodiscard]] std::int64_t poses() const { return poses_; }

 private:
  depth_cloud_t begin_cloud(std::int64_t utime_us, int width, int height, const Pinhole& camera,
                            const Pose& T_body_sensor);
  void check_size(int width, int height);
  void write(const depth_cloud_t& cloud);

  std::filesystem::path file_;
  std::filesystem::path unfinished_;
  ImportedSensor sensor_;
  LogWriter log_;
  std::int64_t session_ = 0;  ///< the first cloud's utime: a recording imported twice gives the same bytes
  std::int64_t clouds_ = 0;
  std::int64_t poses_ = 0;
  std::optional<std::int64_t> last_pose_utime_;
  int width_ = 0;
  int height_ = 0;
};

}  // namespace floornav
