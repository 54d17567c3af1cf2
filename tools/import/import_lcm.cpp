#include <map>
#include <set>
#include <stdexcept>

#include <fmt/format.h>

#include "floornav/pose_t.hpp"
#include "kinect/frame_msg_t.hpp"
#include "lcmtypes/channels.hpp"
#include "runtime/process/log_reader.hpp"
#include "tools/import/frame_place.hpp"
#include "tools/import/import.hpp"
#include "tools/import/kinect_frame.hpp"
#include "tools/import/recording.hpp"

namespace floornav {
namespace {

template <class Message>
bool decode(const LogEvent& event, Message& message) {
  const int size = static_cast<int>(event.bytes.size());
  return message.decode(event.bytes.data(), 0, size) == size;
}

/// What a log holds, as far as the import needs it.
struct Contents {
  std::int64_t frames = 0;
  std::map<std::int64_t, Pose> poses;  ///< of the body, by utime
};

Contents look_through(const LcmImport& what) {
  Contents contents;
  std::set<std::string> channels;
  LogReader log(what.log);
  LogEvent event;
  kinect::frame_msg_t frame;
  pose_t pose;
  while (log.next(event)) {
    channels.insert(event.channel);
    if (event.channel == what.channel && decode(event, frame)) ++contents.frames;
    if (event.channel == channel::kPose && decode(event, pose))
      contents.poses.emplace(pose.utime, pose_from_arrays(pose.pos, pose.orientation));
  }
  if (contents.frames == 0)
    throw std::runtime_error(fmt::format("{}: no kinect.frame_msg_t on {}; its channels: {}",
                                         what.log.string(), what.channel, fmt::join(channels, ", ")));
  return contents;
}

/// The import while it goes on.
class LcmRecording {
 public:
  LcmRecording(const LcmImport& what, const ImportTarget& target, std::map<std::int64_t, Pose> poses)
      : what_(what),
        recording_(target.log, target.sensor),
        poses_(std::move(poses)),
        placed_(poses_.empty()) {}

  /// Throws std::runtime_error for a frame that cannot be taken.
  void add(const kinect::depth_msg_t& message, std::int64_t received_us) {
    const KinectDepth depth = depth_of(message, static_cast<double>(what_.camera.fx));
    const std::int64_t utime = message.timestamp > 0 ? message.timestamp : received_us;
    if (recording_.clouds() > 0 && utime <= last_us_) throw std::runtime_error("its time goes back");
    if (placed_) recording_.pose(utime, place_of(recording_.clouds(), what_.mounting));
    write_poses(poses_.upper_bound(utime));
    recording_.cloud(utime, depth.image, what_.camera, depth.scale_m, sensor_pose(what_.mounting));
    if (recording_.clouds() == 1) first_us_ = utime;
    last_us_ = utime;
  }

  ImportReport finish() {
    write_poses(poses_.end());
    recording_.finish();
    return {recording_.clouds(), recording_.poses(), last_us_ - first_us_, {}};
  }

  [[nodiscard]] bool is_empty() const { return recording_.clouds() == 0; }

 private:
  void write_poses(std::map<std::int64_t, Pose>::iterator end) {
    for (auto pose = poses_.begin(); pose != end; pose = poses_.erase(pose))
      recording_.pose(pose->first, pose->second);
  }

  const LcmImport& what_;
  Recording recording_;
  std::map<std::int64_t, Pose> poses_;  ///< those that are not written yet
  bool placed_;                         ///< the log has no poses: each frame gets a place of its own
  std::int64_t first_us_ = 0;
  std::int64_t last_us_ = 0;
};

}  // namespace

ImportReport import_lcm(const LcmImport& what, const ImportTarget& target) {
  const Contents contents = look_through(what);
  LcmRecording recording(what, target, contents.poses);
  std::map<std::string, std::int64_t> left_out;  // frames, by cause
  std::int64_t seen = 0;
  LogReader log(what.log);
  LogEvent event;
  kinect::frame_msg_t frame;
  while (log.next(event)) {
    if (event.channel != what.channel || !decode(event, frame)) continue;
    target.before_each(seen++, contents.frames);
    try {
      recording.add(frame.depth, event.timestamp_us);
    } catch (const std::runtime_error& error) {
      ++left_out[error.what()];
    }
  }
  if (recording.is_empty())
    throw std::runtime_error(fmt::format("{}: none of its {} frames can be read: {}", what.log.string(), seen,
                                         left_out.begin()->first));
  ImportReport report = recording.finish();
  for (const auto& [cause, count] : left_out)
    report.notes.push_back(fmt::format("{} frames left out: {}", count, cause));
  if (contents.poses.empty()) report.notes.push_back("no POSE in the log: each frame makes a map of its own");
  return report;
}

}  // namespace floornav
