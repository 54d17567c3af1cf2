#include "tools/simulator/drive.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "lcmtypes/channels.hpp"
#include "runtime/process/outbox.hpp"
#include "tools/simulator/depth_sensor.hpp"
#include "tools/simulator/messages.hpp"
#include "tools/simulator/random.hpp"
#include "tools/simulator/vehicle.hpp"

namespace floornav {
namespace {

enum Stream : std::uint64_t { kSession = 11, kOdometry = 12, kSensor = 13 };

constexpr double kVelocitySpan_s = 0.02;

std::int64_t micros(double seconds) {
  return static_cast<std::int64_t>(std::floor(seconds * 1e6 + 0.5));
}

/// Makes the messages of a drive in order of time.
class Recorder {
 public:
  Recorder(const Scene& scene, const RobotSettings& robot, const DriveSettings& settings, LogWriter& log)
      : scene_(scene),
        settings_(settings),
        log_(log),
        trajectory_(*scene.drive, robot.max_acceleration_mps2),
        odometry_(settings.pose_noise, random_key({settings.seed, kOdometry})),
        sensor_(settings.sensor, random_key({settings.seed, kSensor})),
        outbox_({"simulate", static_cast<std::int64_t>(random_key({settings.seed, kSession}) >> 2) + 1}) {}

  DriveSummary record() {
    DriveSummary summary;
    summary.seconds = settings_.seconds > 0 ? settings_.seconds : trajectory_.duration_s();
    const double pose_step_s = 1.0 / settings_.pose_rate_hz;
    const double frame_step_s = 1.0 / settings_.sensor.rate_hz;
    // the last frame, too, gets a pose after it
    const double last_pose_s = summary.seconds + 2.0 * pose_step_s;
    double pose_s = 0;
    double frame_s = 0;
    while (pose_s <= last_pose_s || frame_s <= summary.seconds) {
      const bool frame_left = frame_s <= summary.seconds;
      if (!frame_left || (pose_s <= last_pose_s &&
                          pose_s + settings_.pose_latency_s <= frame_s + settings_.cloud_latency_s)) {
        write_pose(pose_s);
        pose_s = ++summary.poses * pose_step_s;
      } else {
        write_frame(frame_s, summary.frames);
        frame_s = ++summary.frames * frame_step_s;
      }
    }
    summary.start = trajectory_.at(0);
    summary.end = trajectory_.at(summary.seconds);
    summary.length_m = trajectory_.length_m();
    return summary;
  }

 private:
  [[nodiscard]] Pose body_at(double time_s) const {
    return body_on_floor(scene_.fixed, trajectory_.at(time_s));
  }

  void write_pose(double time_s) {
    const double half_s = 0.5 * kVelocitySpan_s;
    outbox_.publish(channel::kPose,
                    pose_message(kDriveStart_us + micros(time_s), odometry_.measure(body_at(time_s)),
                                 body_at(time_s - half_s), body_at(time_s + half_s), kVelocitySpan_s));
    write(time_s + settings_.pose_latency_s);
  }

  void write_frame(double time_s, std::int64_t frame) {
    const auto pixels = sensor_.measure(scene_.at(time_s), body_at(time_s), frame);
    const char* name =
        settings_.sensor.kind == SensorKind::kKinect ? channel::kKinectCloud : channel::kBumblebeeCloud;
    outbox_.publish(name, cloud_message(sensor_, pixels, kDriveStart_us + micros(time_s), frame));
    write(time_s + settings_.cloud_latency_s);
  }

  void write(double time_s) {
    for (const EncodedMessage& message : outbox_.take())
      log_.write(kDriveStart_us + micros(time_s), message.channel, message.bytes);
  }

  const Scene& scene_;
  const DriveSettings& settings_;
  LogWriter& log_;
  Trajectory trajectory_;
  Odometry odometry_;
  DepthSensor sensor_;
  Outbox outbox_;
};

}  // namespace

DriveSummary record_drive(const Scene& scene, const RobotSettings& robot, const DriveSettings& settings,
                          LogWriter& log) {
  if (!scene.drive) throw std::invalid_argument("scene '" + scene.name + "' has no drive");
  return Recorder(scene, robot, settings, log).record();
}

}  // namespace floornav
