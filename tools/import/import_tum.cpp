#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "tools/import/depth_image.hpp"
#include "tools/import/ground_pose.hpp"
#include "tools/import/import.hpp"
#include "tools/import/recording.hpp"
#include "tools/import/tum_folder.hpp"

namespace floornav {

namespace {

constexpr std::int64_t kLongestGap_us = 100'000;  // a longer hole in the ground truth is not bridged
constexpr std::int64_t kMargin_us = 100'000;      // poses before the first and after the last cloud

/// The ground truth in order of time, with the body's poses that follow from it.
class Track {
 public:
  Track(std::vector<StampedPose> poses, double floor_z_m)
      : poses_(std::move(poses)), body_under_(floor_z_m) {}

  void skip_until(std::int64_t utime_us) {
    while (next_ < poses_.size() && poses_[next_].utime_us < utime_us) ++next_;
  }
  /// Writes the body's poses up to a time.
  void write_until(std::int64_t utime_us, Recording& recording) {
    for (; next_ < poses_.size() && poses_[next_].utime_us <= utime_us; ++next_)
      recording.pose(poses_[next_].utime_us, body_under_(poses_[next_].T_world_camera));
  }
  /// The camera at a time, where two poses bracket it closely.
  [[nodiscard]] std::optional<Pose> camera_at(std::int64_t utime_us) const {
    const auto after = std::ranges::lower_bound(poses_, utime_us, {}, &StampedPose::utime_us);
    if (after == poses_.end()) return std::nullopt;
    if (after->utime_us == utime_us) return after->T_world_camera;
    if (after == poses_.begin()) return std::nullopt;
    const auto before = std::prev(after);
    const std::int64_t gap_us = after->utime_us - before->utime_us;
    if (gap_us > kLongestGap_us) return std::nullopt;
    return interpolate(before->T_world_camera, after->T_world_camera,
                       static_cast<double>(utime_us - before->utime_us) / static_cast<double>(gap_us));
  }
  Pose body_under(const Pose& T_world_camera) { return body_under_(T_world_camera); }

 private:
  std::vector<StampedPose> poses_;
  BodyUnderCamera body_under_;
  std::size_t next_ = 0;
};

std::vector<ListedImage> present_images(const std::filesystem::path& folder, ImportReport& report) {
  const auto list = folder / "depth.txt";
  auto images = read_image_list(list);
  const std::size_t listed = images.size();
  std::erase_if(images, [](const ListedImage& image) { return !std::filesystem::exists(image.file); });
  if (images.empty())
    throw std::runtime_error(fmt::format("{}: none of its {} listed images is there", list.string(), listed));
  if (images.size() < listed)
    report.notes.push_back(fmt::format("{} of {} listed images are absent", listed - images.size(), listed));
  return images;
}

void write_cloud(Recording& recording, Track& track, const TumImport& what, const ListedImage& image,
                 const Pose& T_world_camera) {
  const Pose T_world_body = track.body_under(T_world_camera);
  recording.pose(image.utime_us, T_world_body);
  const DepthImage depth = read_depth_image(image.file);
  try {
    recording.cloud(image.utime_us, depth, what.camera, 1 / what.counts_per_m,
                    T_world_body.inverse(Eigen::Isometry) * T_world_camera);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(fmt::format("{}: {}", image.file.string(), error.what()));
  }
}

}  // namespace

ImportReport import_tum(const TumImport& what, const ImportTarget& target) {
  if (!std::filesystem::is_directory(what.folder))
    throw std::runtime_error(fmt::format("{}: is not a folder", what.folder.string()));
  ImportReport report;
  const auto images = present_images(what.folder, report);
  Track track(read_trajectory(what.folder / "groundtruth.txt"), what.floor_z_m);

  Recording recording(target.log, target.sensor);
  track.skip_until(images.front().utime_us - kMargin_us);
  std::int64_t without_pose = 0;
  for (std::size_t i = 0; i < images.size(); ++i) {
    target.before_each(static_cast<std::int64_t>(i), static_cast<std::int64_t>(images.size()));
    track.write_until(images[i].utime_us - 1, recording);
    const auto T_world_camera = track.camera_at(images[i].utime_us);
    if (T_world_camera) {
      write_cloud(recording, track, what, images[i], *T_world_camera);
    } else {
      ++without_pose;
    }
  }
  track.write_until(images.back().utime_us + kMargin_us, recording);
  if (recording.clouds() == 0)
    throw std::runtime_error(
        fmt::format("{}: brackets none of the images' times", (what.folder / "groundtruth.txt").string()));
  if (without_pose > 0)
    report.notes.push_back(
        fmt::format("{} images have no ground truth within 0.1 s and are left out", without_pose));
  report.clouds = recording.clouds();
  report.poses = recording.poses();
  report.span_us = images.back().utime_us - images.front().utime_us;
  recording.finish();
  return report;
}

}  // namespace floornav
