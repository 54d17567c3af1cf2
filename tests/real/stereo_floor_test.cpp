#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "drivers/bumblebee/calibration/calibration_files.hpp"
#include "drivers/bumblebee/rectification.hpp"
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
}

}  // namespace
}  // namespace floornav
