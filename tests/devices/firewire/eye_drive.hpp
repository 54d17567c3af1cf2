#pragma once

#include <filesystem>
#include <string>

#include "runtime/geometry/pose.hpp"
#include "tools/simulator/stereo/stereo_rig.hpp"
#include "tools/simulator/trajectory.hpp"

namespace floornav {

/// A drive through a scene as a virtual Bumblebee sees it, there and back.
class EyeDrive {
 public:
  /// The drive of a scene file. `period_us`: between frames. Throws std::invalid_argument for a scene without
  /// a drive.
  EyeDrive(const std::filesystem::path& scene_file, double seconds, int period_us);

  /// Renders the frames to a file.
  void write(const StereoRigSpec& spec, const std::filesystem::path& file) const;
  [[nodiscard]] int period_us() const { return period_us_; }
  /// The body so long after the first frame.
  [[nodiscard]] Pose body_at(std::int64_t since_first_us) const;

 private:
  [[nodiscard]] Pose body_in_drive(double time_s) const;

  Scene scene_;
  Trajectory trajectory_;
  int period_us_;
  int frames_;
};

}  // namespace floornav
