#include "drivers/bumblebee/calibration/chessboards.hpp"

#include <stdexcept>
#include <string>

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include "tests/real_data.hpp"

namespace floornav {
namespace {

TEST(Chessboards, OfARealBumblebee2CalibrateItToAQuarterPixel) {
  const auto folder = real_data("bumblebee2_chessboards");
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no recording at " << folder;
  const Chessboard board{9, 6, 0.025};
  std::vector<CornerPair> pairs;
  for (int i = 0; i < 4; ++i) {
    const auto image = [&](const char* side) {
      return cv::imread((folder / (std::to_string(i) + "_" + side + ".jpg")).string(), cv::IMREAD_GRAYSCALE);
    };
    const CornerPair corners = find_corners(image("left"), image("right"), board);
    ASSERT_EQ(corners.left.size(), 54U) << "pair " << i;
    ASSERT_EQ(corners.right.size(), 54U) << "pair " << i;
    pairs.push_back(corners);
  }
  const CalibrationReport report = calibrate(pairs, {1024, 768}, board);
  std::printf("rms %.3f px, f %.1f px, baseline %.2f squares\n", report.rms_px,
              report.calibration.left.camera(0, 0), -report.calibration.t_right_left_m[0] / board.square_m);
  EXPECT_LE(report.rms_px, 0.25);
  EXPECT_NEAR(report.calibration.left.camera(0, 0), 836, 15);
  for (const double px : report.pair_epipolar_px) EXPECT_LT(px, 0.3);
}

TEST(Chessboards, ThatShowNoBoardGiveNoCorners) {
  const cv::Mat plain(480, 640, CV_8UC1, cv::Scalar(100));
  EXPECT_TRUE(find_corners(plain, plain, {}).left.empty());
  EXPECT_THROW((void)calibrate({}, {640, 480}, {}), std::runtime_error);
}

}  // namespace
}  // namespace floornav
