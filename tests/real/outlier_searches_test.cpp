#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "perception/outliers.hpp"
#include "perception/roi_cloud.hpp"
#include "tests/real_data.hpp"

namespace floornav {
namespace {

/// Some depth images of a recording.
struct Recording {
  const char* name;
  const char* folder;
  Pinhole camera;
  float scale_m;
  int every;  ///< n-th image
};

class OutlierSearches : public testing::TestWithParam<Recording> {};

/// The camera as if it looked ahead from half a metre: which points are inside of the region does not matter,
/// only that both searches get the same.
DepthFrame frame_of(const cv::Mat& image, const Recording& recording) {
  DepthFrame frame;
  frame.camera = recording.camera;
  frame.scale = recording.scale_m;
  frame.pixels = {image.ptr<std::uint16_t>(), image.total()};
  Eigen::Matrix3d axes;
  axes << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  frame.T_body_sensor.linear() = axes;
  return frame;
}

TEST_P(OutlierSearches, DecideTheSamePointForPoint) {
  const auto folder = real_data(GetParam().folder);
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no recording at " << folder;
  std::vector<cv::String> files;
  cv::glob((folder / "*.png").string(), files);
  RoiSettings roi;
  roi.z_min_m = -2.0;
  roi.z_max_m = 2.0;
  const SectionGrid grid(roi, {});
  Serial serial;
  std::int64_t points = 0, removed = 0;
  for (std::size_t f = 0; f < files.size(); f += static_cast<std::size_t>(GetParam().every)) {
    const cv::Mat image = cv::imread(files[f], cv::IMREAD_UNCHANGED);
    ASSERT_TRUE(image.isContinuous() && image.type() == CV_16UC1) << files[f];
    const DepthFrame frame = frame_of(image, GetParam());
    RoiCloud cloud;
    RoiClipper clipper(roi, grid);
    clipper.clip(frame, SensorView(frame, Pose::Identity()), serial, cloud);
    clipper.fill(0, grid.count(), serial, cloud);
    for (const int neighbors : {8, 20}) {
      OutlierRemover window({neighbors, 1.0, "window"}), nanoflann({neighbors, 1.0, "nanoflann"});
      for (int section = 0; section < grid.count(); ++section) {
        const auto begin = static_cast<std::size_t>(cloud.section_begin(section));
        const auto size = static_cast<std::size_t>(cloud.section_size(section));
        const auto part = [&](const auto& values) { return std::span(values).subspan(begin, size); };
        const ImagePoints section_points{
            {part(cloud.x), part(cloud.y), part(cloud.z)}, part(cloud.pixel), frame.camera};
        std::vector<std::uint8_t> a(size, 7), b(size, 8);
        removed += window.remove(section_points, serial, a);
        nanoflann.remove(section_points, serial, b);
        ASSERT_EQ(a, b) << files[f] << " section " << section << " K " << neighbors;
      }
      points += static_cast<std::int64_t>(cloud.size());
    }
  }
  EXPECT_GT(points, 500'000);
  EXPECT_GT(removed, 10'000);
  std::printf("%s: %ld points, %ld removed, none decided differently\n", GetParam().name, points, removed);
}

INSTANTIATE_TEST_SUITE_P(
    Recordings, OutlierSearches,
    testing::Values(
        Recording{"Kinect", "tum_fr1_rpy/depth", {517.3F, 516.5F, 318.6F, 255.3F, 640, 480}, 0.0002F, 40},
        Recording{"RealSense", "pepper_floor/depth", {381.4F, 381.4F, 321.7F, 236.9F, 640, 480}, 0.001F, 80}),
    [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace floornav
