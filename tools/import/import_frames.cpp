#include <stdexcept>

#include <fmt/format.h>

#include "tools/import/depth_image.hpp"
#include "tools/import/frame_place.hpp"
#include "tools/import/import.hpp"
#include "tools/import/pcd_file.hpp"
#include "tools/import/pinhole_fit.hpp"
#include "tools/import/recording.hpp"

namespace floornav {

namespace {

/// One file's image with what it takes to read it.
struct Frame {
  DepthImage image;
  Pinhole camera;
  double scale_m = 0.001;
};

/// Writes one frame a file, each at its own place.
template <class Read>
ImportReport import_each(const std::vector<std::filesystem::path>& files, const FixedMounting& mounting,
                         const ImportTarget& target, Read read) {
  Recording recording(target.log, target.sensor);
  const auto total = static_cast<std::int64_t>(files.size());
  for (std::int64_t i = 0; i < total; ++i) {
    target.before_each(i, total);
    const std::filesystem::path& file = files[static_cast<std::size_t>(i)];
    const std::int64_t utime_us = 1'000'000 + i * FixedMounting::period_us;
    try {
      const Frame frame = read(file);
      recording.pose(utime_us, place_of(i, mounting));
      recording.cloud(utime_us, frame.image, frame.camera, frame.scale_m, sensor_pose(mounting));
    } catch (const std::runtime_error& error) {
      const std::string why = error.what();
      throw std::runtime_error(why.starts_with(file.string()) ? why
                                                              : fmt::format("{}: {}", file.string(), why));
    }
  }
  recording.finish();
  return {recording.clouds(), recording.poses(), (total - 1) * FixedMounting::period_us, {}};
}

/// A cloud as an image, where its points lie on the camera's rays.
Frame frame_of(const OrganisedCloud& cloud, const std::optional<Pinhole>& given) {
  constexpr double kMostOffRay_px = 0.5;
  const Pinhole camera = given.value_or(fit_pinhole(cloud));
  const RayResidual off = ray_residual(cloud, camera);
  if (off.rms_px > kMostOffRay_px) {
    const Pinhole best = fit_pinhole(cloud);
    throw std::runtime_error(fmt::format(
        "its points lie {:.2f} px rms off the rays of {:.1f},{:.1f},{:.1f},{:.1f}; the best camera is "
        "{:.1f},{:.1f},{:.1f},{:.1f} with {:.2f} px",
        off.rms_px, camera.fx, camera.fy, camera.cx, camera.cy, best.fx, best.fy, best.cx, best.cy,
        ray_residual(cloud, best).rms_px));
  }
  ScaledDepth depth = depth_of(cloud);
  return {std::move(depth.image), camera, depth.scale_m};
}

}  // namespace

ImportReport import_depth(const DepthImport& what, const ImportTarget& target) {
  std::vector<std::filesystem::path> files;
  for (const auto& folder : what.folders) {
    const auto found = depth_images_in(folder);
    files.insert(files.end(), found.begin(), found.end());
  }
  return import_each(files, what.mounting, target, [&](const std::filesystem::path& file) {
    constexpr std::uint16_t kSaturated = 65535;
    Frame frame{read_depth_image(file), what.camera, 1 / what.counts_per_m};
    std::ranges::replace(frame.image.pixels, kSaturated, std::uint16_t{0});
    return frame;
  });
}

ImportReport import_pcd(const PcdImport& what, const ImportTarget& target) {
  std::vector<std::string> notes;
  ImportReport report =
      import_each(what.files, what.mounting, target, [&](const std::filesystem::path& file) {
        const OrganisedCloud cloud = read_pcd(file);
        Frame frame = frame_of(cloud, what.camera);
        const RayResidual off = ray_residual(cloud, frame.camera);
        notes.push_back(
            fmt::format("{}: camera {:.2f},{:.2f},{:.2f},{:.2f}, rays within {:.3f} px, {} mm a count",
                        file.filename().string(), frame.camera.fx, frame.camera.fy, frame.camera.cx,
                        frame.camera.cy, off.worst_px, frame.scale_m * 1000));
        return frame;
      });
  report.notes = std::move(notes);
  return report;
}

}  // namespace floornav
