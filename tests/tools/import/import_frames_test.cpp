#include <cmath>
#include <fstream>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "tests/real_data.hpp"
#include "tests/tools/import/recorded.hpp"
#include "tests/tools/temporary_folder.hpp"
#include "tools/import/import.hpp"

namespace floornav {
namespace {

ImportTarget target(const std::filesystem::path& log) {
  return {log, imported_sensor("kinect"), [](auto, auto) {}};
}

const Pinhole kSmallCamera{8.0F, 8.0F, 3.5F, 2.5F, 8, 6};

TEST(DepthImport, GivesEachFrameAPlaceOfItsOwnInTheOrderOfNames) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "depth");
  for (int i = 0; i < 23; ++i) {
    cv::Mat image(6, 8, CV_16UC1, cv::Scalar(1000 + i));
    image.at<std::uint16_t>(0, 0) = 65535;
    image.at<std::uint16_t>(0, 1) = 0;
    cv::imwrite((folder / ("depth/" + std::string(i < 10 ? "0" : "") + std::to_string(i) + ".png")).string(),
                image);
  }
  const ImportReport report =
      import_depth({{folder / "depth"}, kSmallCamera, 1000, {}}, target(folder / "out.lcm"));
  EXPECT_EQ(report.clouds, 23);
  const auto clouds = recorded_clouds(folder / "out.lcm");
  ASSERT_EQ(clouds.size(), 23U);
  for (std::size_t i = 0; i < clouds.size(); ++i) {
    EXPECT_EQ(clouds[i].pixels[0], 0);
    EXPECT_EQ(clouds[i].pixels[1], 0);
    EXPECT_EQ(clouds[i].pixels[47], 1000 + i);
    for (std::size_t k = 0; k < i; ++k)
      EXPECT_GE((clouds[i].T_world_body.translation() - clouds[k].T_world_body.translation()).norm(), 10);
  }
}

TEST(DepthImport, SetsTheNoiseOfTheSensor) {
  const TemporaryFolder folder;
  cv::imwrite((folder / "0.png").string(), cv::Mat(6, 8, CV_16UC1, cv::Scalar(1000)));
  const auto sigma_at_3m = [&](const char* sensor) {
    import_depth({{folder.path()}, kSmallCamera, 1000, {}},
                 {folder / "out.lcm", imported_sensor(sensor), [](auto, auto) {}});
    const depth_cloud_t cloud = recorded_clouds(folder / "out.lcm").front().message;
    return 9 * cloud.disparity_sigma / (cloud.fx * cloud.baseline);
  };
  EXPECT_NEAR(sigma_at_3m("kinect"), 0.014, 1e-4);      // eq. (3)
  EXPECT_NEAR(sigma_at_3m("bumblebee"), 0.0035, 1e-5);  // eq. (4)
}

/// A .pcd of 8 x 6 points on the small camera's rays at 2 m, each shifted sideways.
void write_pcd(const std::filesystem::path& file, float shift_m) {
  std::ofstream out(file);
  out << "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 80\nHEIGHT 60\nPOINTS 4800\nDATA ascii\n";
  for (int row = 0; row < 60; ++row)
    for (int column = 0; column < 80; ++column) {
      const float sign = column % 2 == 0 ? 1.0F : -1.0F;
      out << (static_cast<float>(column) - 39.5F) / 80 * 2 + sign * shift_m << " "
          << (static_cast<float>(row) - 29.5F) / 80 * 2 << " 2\n";
    }
}

TEST(PcdImport, FindsTheCameraFromTheCloud) {
  const TemporaryFolder folder;
  write_pcd(folder / "a.pcd", 0);
  import_pcd({{folder / "a.pcd"}, std::nullopt, {}}, target(folder / "out.lcm"));
  const depth_cloud_t cloud = recorded_clouds(folder / "out.lcm").front().message;
  EXPECT_NEAR(cloud.fx, 80, 0.01);
  EXPECT_NEAR(cloud.cx, 39.5, 0.01);
}

TEST(PcdImport, RefusesACloudOffTheRays) {
  const TemporaryFolder folder;
  write_pcd(folder / "a.pcd", 0.05F);
  EXPECT_THROW(import_pcd({{folder / "a.pcd"}, std::nullopt, {}}, target(folder / "out.lcm")),
               std::runtime_error);
  write_pcd(folder / "a.pcd", 0);
  const Pinhole other{90, 80, 39.5F, 29.5F, 80, 60};
  EXPECT_THROW(import_pcd({{folder / "a.pcd"}, other, {}}, target(folder / "out.lcm")), std::runtime_error);
  EXPECT_FALSE(std::filesystem::exists(folder / "out.lcm"));
}

TEST(PcdImport, TakesEveryRealCloud) {
  const auto data = real_data("pcl_clouds");
  if (!std::filesystem::exists(data)) GTEST_SKIP() << "no recording at " << data;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(data))
    if (entry.path().extension() == ".pcd") files.push_back(entry.path());
  ASSERT_EQ(files.size(), 6U);
  const TemporaryFolder folder;
  import_pcd({files, std::nullopt, {}}, target(folder / "out.lcm"));
  for (const RecordedCloud& cloud : recorded_clouds(folder / "out.lcm"))
    EXPECT_NEAR(cloud.message.fx, 525, 0.01);
}

}  // namespace
}  // namespace floornav
