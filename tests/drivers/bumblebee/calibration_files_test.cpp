#include "drivers/bumblebee/calibration/calibration_files.hpp"

#include <fstream>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "tests/real_data.hpp"
#include "tests/tools/temporary_folder.hpp"

namespace floornav {
namespace {

TEST(BotParamCalibration, IsReadFromARealBumblebee2sFile) {
  const auto file = real_data("bumblebee_calibration") / "mit_sensor_rig.cfg";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no calibration at " << file;
  const StereoCalibration pair = read_stereo_calibration(file.string(), "bumblebee");
  EXPECT_EQ(pair.left.size, cv::Size(1024, 768));
  EXPECT_EQ(pair.left.camera(0, 0), 836.466);
  EXPECT_EQ(pair.right.camera(1, 2), 403.242);
  EXPECT_THAT(pair.right.distortion, testing::ElementsAre(-0.37464, 0.2336, 0, 0, -0.107056));
  EXPECT_EQ(pair.t_right_left_m[0], -0.119941);
  EXPECT_EQ(pair.R_right_left(0, 1), -0.00407631);
  EXPECT_THROW(read_stereo_calibration(file.string()), std::runtime_error) << "it holds three stereo cameras";
}

TEST(EurocCalibration, HasTheBaselineOfItsDataSet) {
  const auto folder = real_data("euroc_floor");
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no recording at " << folder;
  const StereoCalibration pair = read_stereo_calibration((folder / "cam0_sensor.yaml").string() + "," +
                                                         (folder / "cam1_sensor.yaml").string());
  EXPECT_NEAR(cv::norm(pair.t_right_left_m), 0.1101, 0.0001);
  EXPECT_EQ(pair.left.camera(0, 0), 458.654);
}

TEST(OpencvCalibration, ComesBackAsItWasWritten) {
  const TemporaryFolder folder;
  StereoCalibration pair;
  pair.left = {{640, 480}, {520.25, 0, 325, 0, 518, 236, 0, 0, 1}, {-0.35, 0.2, 0, 0, -0.08}};
  pair.right = {{640, 480}, {523, 0, 317, 0, 521, 243, 0, 0, 1}, {-0.34, 0.18, 0, 0}};
  pair.t_right_left_m = {-0.12, 0.0007, -0.0004};
  write_stereo_calibration(pair, folder / "pair.yaml");
  const StereoCalibration read = read_stereo_calibration((folder / "pair.yaml").string());
  EXPECT_EQ(read.left.size, pair.left.size);
  EXPECT_EQ(read.left.camera, pair.left.camera);
  EXPECT_EQ(read.left.distortion, pair.left.distortion);
  EXPECT_EQ(read.right.distortion, pair.right.distortion);
  EXPECT_EQ(read.t_right_left_m, pair.t_right_left_m);
  const cv::FileStorage by_opencv((folder / "pair.yaml").string(), cv::FileStorage::READ);
  cv::Mat camera;
  by_opencv["M1"] >> camera;
  EXPECT_EQ(camera.at<double>(0, 0), 520.25);
}

TEST(Calibration, NamesTheFileAndTheCause) {
  const TemporaryFolder folder;
  const auto expect = [&](const std::string& content, const char* cause) {
    const auto file = folder / "bad.yaml";
    std::ofstream(file) << content;
    try {
      (void)read_stereo_calibration(file.string());
      ADD_FAILURE() << "accepted: " << content;
    } catch (const std::runtime_error& error) {
      EXPECT_THAT(error.what(), testing::AllOf(testing::HasSubstr("bad.yaml"), testing::HasSubstr(cause)));
    }
  };
  expect("", "no ");
  expect("image_size: [640, 480]\n", "no M1");
  expect("image_size: [640, x]\n", "not a list of numbers");
  expect("a: [\n", "line");
  expect("cameras { }", "no stereo camera");
  EXPECT_THROW(read_stereo_calibration((folder / "none.yaml").string()), std::runtime_error);
}

}  // namespace
}  // namespace floornav
