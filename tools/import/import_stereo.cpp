#include <array>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "drivers/bumblebee/calibration/calibration_files.hpp"
#include "drivers/bumblebee/stereo_pipeline.hpp"
#include "tools/import/frame_place.hpp"
#include "tools/import/image_file.hpp"
#include "tools/import/import.hpp"
#include "tools/import/recording.hpp"

namespace floornav {
namespace {

constexpr std::array<std::string_view, 7> kEndings{".png", ".tif", ".tiff", ".pgm", ".jpg", ".jpeg", ".bmp"};

struct PairOfFiles {
  std::filesystem::path left;
  std::filesystem::path right;
};

/// Images of equal names; where no name is in both folders, by their order.
std::vector<PairOfFiles> pairs_of(const StereoImport& what) {
  const auto left = images_in(what.left, kEndings);
  const auto right = images_in(what.right, kEndings);
  std::vector<PairOfFiles> pairs;
  for (const auto& file : left)
    if (const auto same = what.right / file.filename(); std::filesystem::exists(same))
      pairs.push_back({file, same});
  if (!pairs.empty()) return pairs;
  if (left.size() != right.size())
    throw std::runtime_error(fmt::format("{} has {} images and {} has {}, and no name is in both",
                                         what.left.string(), left.size(), what.right.string(), right.size()));
  for (std::size_t i = 0; i < left.size(); ++i) pairs.push_back({left[i], right[i]});
  return pairs;
}

}  // namespace

ImportReport import_stereo(const StereoImport& what, const ImportTarget& target) {
  const Rectification rectification(read_stereo_calibration(what.calibration, what.calibration_block));
  const Pinhole& camera = rectification.camera();
  StereoPipeline pipeline(what.matching, rectification,
                          search_everywhere(camera, rectification.baseline_m(), what.matching.nearest_m));
  const Pose T_body_sensor = sensor_pose(what.mounting) * rectification.T_left_ideal();
  Serial serial;
  const std::vector<PairOfFiles> pairs = pairs_of(what);
  Recording recording(target.log, target.sensor);
  const auto total = static_cast<std::int64_t>(pairs.size());
  DisparityImage image;
  std::int64_t matched = 0;
  for (std::int64_t i = 0; i < total; ++i) {
    target.before_each(i, total);
    const PairOfFiles& pair = pairs[static_cast<std::size_t>(i)];
    const std::int64_t utime_us = 1'000'000 + i * FixedMounting::period_us;
    try {
      pipeline.match(read_image(pair.left, ImageForm::kGrey), read_image(pair.right, ImageForm::kGrey),
                     serial, image);
    } catch (const std::runtime_error& error) {
      const std::string why = error.what();
      throw std::runtime_error(why.find(pair.left.filename().string()) != std::string::npos
                                   ? why
                                   : fmt::format("{}: {}", pair.left.string(), why));
    }
    for (const std::uint16_t pixel : image.pixels) matched += pixel != 0 ? 1 : 0;
    recording.pose(utime_us, place_of(i, what.mounting));
    recording.cloud(utime_us, image, camera, rectification.baseline_m(), T_body_sensor);
  }
  recording.finish();
  const double pixels = static_cast<double>(total) * camera.width * camera.height;
  return {
      recording.clouds(),
      recording.poses(),
      (total - 1) * FixedMounting::period_us,
      {fmt::format(
          "rectified camera {:.1f},{:.1f},{:.1f},{:.1f}, baseline {:.4f} m; {:.0f} % of the pixels matched",
          camera.fx, camera.fy, camera.cx, camera.cy, rectification.baseline_m(),
          100.0 * static_cast<double>(matched) / pixels)}};
}

}  // namespace floornav
