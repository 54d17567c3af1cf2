#include "drivers/bumblebee/rectification.hpp"

#include <random>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

namespace floornav {
namespace {

StereoCalibration bent_pair() {
  StereoCalibration pair;
  pair.left = {{640, 480}, {520, 0, 325, 0, 518, 236, 0, 0, 1}, {-0.35, 0.2, 0.0005, -0.0003, -0.08}};
  pair.right = {{640, 480}, {523, 0, 317, 0, 521, 243, 0, 0, 1}, {-0.34, 0.18, -0.0004, 0.0002, -0.07}};
  cv::Rodrigues(cv::Vec3d(0.004, -0.008, 0.003), pair.R_right_left);
  pair.t_right_left_m = {-0.12, 0.0007, -0.0004};
  return pair;
}

/// Where an eye sees a point, px: the lens model written out.
cv::Point2d seen(const Eye& eye, const cv::Vec3d& p) {
  const double x = p[0] / p[2];
  const double y = p[1] / p[2];
  const double r2 = x * x + y * y;
  const auto& k = eye.distortion;
  const double radial = 1 + r2 * (k[0] + r2 * (k[1] + r2 * k[4]));
  const double bent_x = x * radial + 2 * k[2] * x * y + k[3] * (r2 + 2 * x * x);
  const double bent_y = y * radial + k[2] * (r2 + 2 * y * y) + 2 * k[3] * x * y;
  return {eye.camera(0, 0) * bent_x + eye.camera(0, 2), eye.camera(1, 1) * bent_y + eye.camera(1, 2)};
}

/// A dot with a place finer than a pixel.
void draw_dot(cv::Mat& image, cv::Point2d at) {
  constexpr double kSigma_px = 2.0;
  for (int y = std::max(0, static_cast<int>(at.y) - 8); y < std::min(image.rows, static_cast<int>(at.y) + 9);
       ++y)
    for (int x = std::max(0, static_cast<int>(at.x) - 8);
         x < std::min(image.cols, static_cast<int>(at.x) + 9); ++x) {
      const double r2 = (x - at.x) * (x - at.x) + (y - at.y) * (y - at.y);
      image.at<std::uint8_t>(y, x) =
          cv::saturate_cast<std::uint8_t>(250 * std::exp(-r2 / (2 * kSigma_px * kSigma_px)));
    }
}

cv::Point2d center_of_light(const cv::Mat& image) {
  const cv::Moments moments = cv::moments(image);
  return {moments.m10 / moments.m00, moments.m01 / moments.m00};
}

class RectifiedPoint : public testing::TestWithParam<unsigned> {};

TEST_P(RectifiedPoint, IsWhereTheIdealPinholesSeeIt) {
  const StereoCalibration pair = bent_pair();
  const Rectification rectification(pair);
  EXPECT_NEAR(rectification.baseline_m(), cv::norm(pair.t_right_left_m), 1e-6);
  std::mt19937 random(GetParam());
  std::uniform_real_distribution<double> x(-0.4, 0.4);
  std::uniform_real_distribution<double> y(-0.3, 0.3);
  std::uniform_real_distribution<double> z(0.8, 6.0);
  const double depth_m = z(random);
  const cv::Vec3d p(x(random) * depth_m, y(random) * depth_m, depth_m);
  cv::Mat raw_left(480, 640, CV_8UC1, cv::Scalar(0));
  cv::Mat raw_right = raw_left.clone();
  draw_dot(raw_left, seen(pair.left, p));
  draw_dot(raw_right, seen(pair.right, pair.R_right_left * p + pair.t_right_left_m));
  cv::Mat left;
  cv::Mat right;
  rectification.apply(raw_left, raw_right, left, right);

  const cv::Vec3d ideal = rectification.R_ideal_left() * p;
  const Eigen::Vector2f at =
      rectification.camera().project(Eigen::Vector3d(ideal[0], ideal[1], ideal[2]).cast<float>());
  const double disparity =
      static_cast<double>(rectification.camera().fx) * rectification.baseline_m() / ideal[2];
  EXPECT_NEAR(center_of_light(left).x, static_cast<double>(at.x()), 0.15);
  EXPECT_NEAR(center_of_light(left).y, static_cast<double>(at.y()), 0.15);
  EXPECT_NEAR(center_of_light(right).y, static_cast<double>(at.y()), 0.15);
  EXPECT_NEAR(center_of_light(left).x - center_of_light(right).x, disparity, 0.15);
}

INSTANTIATE_TEST_SUITE_P(Seeds, RectifiedPoint, testing::Range(0U, 20U));

void expect_refused(const StereoCalibration& calibration, const char* cause) {
  try {
    const Rectification rectification(calibration);
    ADD_FAILURE() << "accepted";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr(cause));
  }
}

TEST(Rectification, RefusesWhatNoPairOfCamerasCouldBe) {
  StereoCalibration pair = bent_pair();
  pair.t_right_left_m[0] = 0.12;
  expect_refused(pair, "swapped");
  pair = bent_pair();
  pair.t_right_left_m = {-0.001, 0.12, 0};
  expect_refused(pair, "above");
  pair = bent_pair();
  pair.R_right_left(0, 0) = 2;
  expect_refused(pair, "rotation");
  pair = bent_pair();
  pair.right.size = {1024, 768};
  pair.right.camera(0, 2) = 500;
  expect_refused(pair, "same size");
  pair = bent_pair();
  pair.left.camera(0, 0) = std::nan("");
  expect_refused(pair, "left fx");
}

TEST(Rectification, RefusesImagesOfAnotherSizeOrKind) {
  const Rectification rectification(bent_pair());
  const cv::Mat good(480, 640, CV_8UC1, cv::Scalar(0));
  cv::Mat left;
  cv::Mat right;
  EXPECT_THROW(rectification.apply(good, cv::Mat(480, 320, CV_8UC1), left, right), std::runtime_error);
  EXPECT_THROW(rectification.apply(cv::Mat(480, 640, CV_8UC3), good, left, right), std::runtime_error);
}

}  // namespace
}  // namespace floornav
