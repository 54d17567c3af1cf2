#include <array>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "drivers/bumblebee/calibration/calibration_files.hpp"
#include "drivers/bumblebee/rectification.hpp"
#include "tests/real/floor_oracle.hpp"
#include "tests/real/outputs.hpp"
#include "tests/real_data.hpp"
#include "tests/tools/run_program.hpp"

namespace floornav {
namespace {

constexpr double kDegree = M_PI / 180;

/// Tilt of the real left camera, degrees, from the up direction that a replay found in the rectified one.
double pitch_of_real_camera(const Row& frame, const cv::Matx33d& R_ideal_left) {
  const double pitch = frame.at("camera_pitch_deg") * kDegree;
  const double roll = frame.at("camera_roll_deg") * kDegree;
  const cv::Vec3d up_ideal(std::cos(pitch) * std::sin(roll), -std::cos(pitch) * std::cos(roll),
                           -std::sin(pitch));
  const cv::Vec3d up = R_ideal_left.t() * up_ideal;
  return std::asin(-up[2]) / kDegree;
}

/// A camera by plain reading of its file.
struct EurocCamera {
  cv::Matx33d K = cv::Matx33d::eye();
  cv::Mat distortion;
  Eigen::Isometry3d T_body_camera = Eigen::Isometry3d::Identity();

  explicit EurocCamera(const std::filesystem::path& file) {
    const cv::FileStorage yaml(file.string(), cv::FileStorage::READ);
    std::vector<double> numbers;
    yaml["intrinsics"] >> numbers;
    K = {numbers.at(0), 0, numbers.at(2), 0, numbers.at(1), numbers.at(3), 0, 0, 1};
    yaml["distortion_coefficients"] >> numbers;
    distortion = cv::Mat(numbers, true);
    yaml["T_BS"]["data"] >> numbers;
    T_body_camera.matrix() = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(numbers.data());
  }
};

/// The left camera's height above a plane fitted to what OpenCV alone makes of the pairs: its rectification,
/// its matcher. It shares nothing with the project's.
class OpencvFloor {
 public:
  OpencvFloor(const EurocCamera& left, const EurocCamera& right) {
    const Eigen::Isometry3d T_right_left = right.T_body_camera.inverse() * left.T_body_camera;
    cv::Matx33d R, R_left, R_right;
    cv::Vec3d t;
    cv::Matx34d P_left, P_right;
    for (int i = 0; i < 3; ++i) {
      t[i] = T_right_left.translation()[i];
      for (int j = 0; j < 3; ++j) R(i, j) = T_right_left.linear()(i, j);
    }
    cv::stereoRectify(left.K, left.distortion, right.K, right.distortion, size_, R, t, R_left, R_right,
                      P_left, P_right, Q_, cv::CALIB_ZERO_DISPARITY, 0);
    cv::initUndistortRectifyMap(left.K, left.distortion, R_left, P_left, size_, CV_32FC1, map_left_[0],
                                map_left_[1]);
    cv::initUndistortRectifyMap(right.K, right.distortion, R_right, P_right, size_, CV_32FC1, map_right_[0],
                                map_right_[1]);
  }

  [[nodiscard]] double camera_height_m(const std::filesystem::path& left,
                                       const std::filesystem::path& right) const {
    const auto rectified = [](const std::filesystem::path& file, const std::array<cv::Mat, 2>& map) {
      cv::Mat image;
      cv::remap(cv::imread(file.string(), cv::IMREAD_GRAYSCALE), image, map[0], map[1], cv::INTER_LINEAR);
      return image;
    };
    cv::Mat counts, places;
    cv::StereoSGBM::create(0, 128, 5, 8 * 25, 32 * 25, 1, 63, 10, 100, 2)
        ->compute(rectified(left, map_left_), rectified(right, map_right_), counts);
    cv::Mat disparity;
    counts.convertTo(disparity, CV_32F, 1.0 / 16);
    cv::reprojectImageTo3D(disparity, places, Q_);
    std::vector<Eigen::Vector3d> points;
    for (int v = 0; v < size_.height; ++v)
      for (int u = 0; u < size_.width; ++u) {
        const auto& p = places.at<cv::Vec3f>(v, u);
        if (disparity.at<float>(v, u) > 1) points.emplace_back(p[0], p[1], p[2]);
      }
    const double pitch = 22.8 * kDegree;
    return -fit_floor(points, {{0, -std::cos(pitch), -std::sin(pitch)}, -0.95, 12, 0.15}).distance_m;
  }

 private:
  const cv::Size size_{752, 480};
  cv::Matx44d Q_;
  std::array<cv::Mat, 2> map_left_, map_right_;
};

/// All 19 pairs, matched by our matcher: the floor of a real room with a static stereo camera.
TEST(EurocFloor, GivesTheCamerasHeightAndPitchInEveryPair) {
  const auto data = real_data("euroc_floor");
  if (!std::filesystem::exists(data)) GTEST_SKIP() << "no recording at " << data;
  const std::string calibration =
      (data / "cam0_sensor.yaml").string() + "," + (data / "cam1_sensor.yaml").string();
  const TemporaryFolder folder;
  const Outcome import =
      run_program({"floornav-import", "stereo", data / "cam0", data / "cam1", "-o", folder / "log.lcm",
                   "--calibration", calibration, "--height", "0.95", "--pitch", "22.8", "--roll", "0"});
  ASSERT_EQ(import.exit_code, 0) << import.err;
  const Outcome replay =
      run_program({"floornav-replay", folder / "log.lcm", "--out", folder / "out", "--threads", "2"});
  ASSERT_EQ(replay.exit_code, 0) << replay.err;
  const Rectification rectification(read_stereo_calibration(calibration));
  const auto frames = read_csv(folder / "out/frames.csv");
  ASSERT_EQ(frames.size(), 19U);
  double sum_m = 0;
  double sum_squares = 0;
  double sum_pitch = 0;
  for (const Row& frame : frames) {
    EXPECT_GT(frame.at("floor_points"), 10000);
    EXPECT_NEAR(frame.at("camera_height"), 0.95, 0.02) << "frame " << frame.at("frame");
    const double pitch = pitch_of_real_camera(frame, rectification.R_ideal_left());
    EXPECT_NEAR(pitch, 22.8, 1.0) << "frame " << frame.at("frame");
    sum_m += frame.at("camera_height");
    sum_squares += frame.at("camera_height") * frame.at("camera_height");
    sum_pitch += pitch;
  }
  const double mean_m = sum_m / 19;
  const double spread_mm = 1000 * std::sqrt(std::max(0.0, sum_squares / 19 - mean_m * mean_m));
  std::printf("euroc: camera %.4f m high (1 sigma %.1f mm over 19 pairs), pitch %.2f degrees\n", mean_m,
              spread_mm, sum_pitch / 19);
  EXPECT_LT(spread_mm, 3);

  const OpencvFloor opencv(EurocCamera(data / "cam0_sensor.yaml"), EurocCamera(data / "cam1_sensor.yaml"));
  double opencv_m = 0;
  int pairs = 0;
  for (const auto& left : std::filesystem::directory_iterator(data / "cam0"))
    if (left.path().extension() == ".png") {
      opencv_m += opencv.camera_height_m(left, data / "cam1" / left.path().filename());
      ++pairs;
    }
  ASSERT_EQ(pairs, 19);
  std::printf("euroc: %.4f m by OpenCV's rectification and matcher and a plane fitted to its points\n",
              opencv_m / pairs);
  EXPECT_NEAR(mean_m, opencv_m / pairs, 0.01);
}

}  // namespace
}  // namespace floornav
