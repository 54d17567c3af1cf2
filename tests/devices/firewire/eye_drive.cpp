#include "tests/devices/firewire/eye_drive.hpp"

#include <algorithm>
#include <stdexcept>

#include "runtime/geometry/robot.hpp"
#include "tests/devices/firewire/eye_scene_writer.hpp"
#include "tools/simulator/scene_file.hpp"
#include "tools/simulator/sensor_spec.hpp"
#include "tools/simulator/vehicle.hpp"

namespace floornav {
namespace {

Scene driven(const std::filesystem::path& file) {
  Scene scene = load_scene(file.string());
  if (!scene.drive) throw std::invalid_argument(file.string() + ": the scene has no drive");
  return scene;
}

}  // namespace

EyeDrive::EyeDrive(const std::filesystem::path& scene_file, double seconds, int period_us)
    : scene_(driven(scene_file)),
      trajectory_(*scene_.drive, RobotSettings{}.max_acceleration_mps2),
      period_us_(period_us),
      frames_(std::max(2, static_cast<int>(seconds * 1e6 / period_us))) {}

Pose EyeDrive::body_in_drive(double time_s) const {
  return body_on_floor(scene_.fixed, trajectory_.at(time_s));
}

Pose EyeDrive::body_at(std::int64_t since_first_us) const {
  const std::int64_t length = std::int64_t{frames_ - 1} * period_us_;
  const std::int64_t phase = since_first_us % (2 * length);
  return body_in_drive(1e-6 * static_cast<double>(std::min(phase, 2 * length - phase)));
}

void EyeDrive::write(const StereoRigSpec& spec, const std::filesystem::path& file) const {
  StereoRig rig(spec, 1);
  EyeSceneWriter writer(file, rig, period_us_, true);
  for (int frame = 0; frame < frames_; ++frame) {
    const double time_s = 1e-6 * frame * period_us_;
    writer.add(rig.see(scene_.at(time_s), body_in_drive(time_s) * mounted(0.0, 0.0, 0.72, 20.0), frame));
  }
  writer.close();
}

}  // namespace floornav
