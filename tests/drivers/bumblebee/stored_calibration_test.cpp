#include "drivers/bumblebee/calibration/stored_calibration.hpp"

#include <cmath>
#include <random>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace floornav {
namespace {

/// A spline whose coefficients are those of a straight line is that line; a parabola's differ by a constant.
TEST(SplineWarp, OfEvenCoefficientsIsALine) {
  SplineWarp warp{7, 5, std::vector<double>(35), std::vector<double>(35)};
  for (int i = 0; i < 7; ++i)
    for (int j = 0; j < 5; ++j) {
      warp.to_x[static_cast<std::size_t>(i * 5 + j)] = (i - 1) / 4.0;  // knots 0..1 lie at i = 1..5
      warp.to_y[static_cast<std::size_t>(i * 5 + j)] = (j - 1) / 2.0;
    }
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-0.05, 1.05);
  for (int i = 0; i < 100; ++i) {
    const cv::Point2d at(place(random), place(random));
    EXPECT_NEAR(warp.at(at.x, at.y).x, at.x, 1e-12);
    EXPECT_NEAR(warp.at(at.x, at.y).y, at.y, 1e-12);
  }
}

/// Against the definition of the uniform cubic B-spline by Cox and de Boor's recursion.
TEST(SplineWarp, IsTheBSplineOfItsCoefficients) {
  const std::function<double(int, int, double)> basis = [&](int i, int degree, double t) -> double {
    if (degree == 0) return t >= i && t < i + 1 ? 1 : 0;
    return (t - i) / degree * basis(i, degree - 1, t) +
           (i + degree + 1 - t) / degree * basis(i + 1, degree - 1, t);
  };
  std::mt19937 random(2);
  std::uniform_real_distribution<double> value(0, 1);
  SplineWarp warp{6, 8, {}, {}};
  for (int i = 0; i < 48; ++i) {
    warp.to_x.push_back(value(random));
    warp.to_y.push_back(value(random));
  }
  for (int n = 0; n < 50; ++n) {
    const double x = value(random);
    const double y = value(random);
    double expected = 0;
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 8; ++j)
        expected +=
            warp.to_x[static_cast<std::size_t>(i * 8 + j)] * basis(i, 3, 3 + x * 3) * basis(j, 3, 3 + y * 5);
    EXPECT_NEAR(warp.at(x, y).x, expected, 1e-12);
  }
}

std::string line_warp() {
  std::string text = "Warp 4 4";
  for (int i = 0; i < 16; ++i) text.append(" ").append(std::to_string(i / 4 - 1));
  for (int i = 0; i < 16; ++i) text.append(" ").append(std::to_string(i % 4 - 1));
  return text.append("\n");
}

TEST(StoredCalibration, GivesBackWhatWasWritten) {
  const std::string head =
      "Version \"X 3.0\" # a remark 12\nSerial 1234\nFocalLength 0.768 1.024\n"
      "ImageCenter 0.503, 0.5135\nBaseLine 0.24 0.12\n";
  const StoredCalibration stored = parse_stored_calibration(head + line_warp() + line_warp() + line_warp());
  EXPECT_EQ(stored.focal_length.x, 0.768);
  EXPECT_EQ(stored.image_center.y, 0.5135);
  ASSERT_EQ(stored.eyes.size(), 3U);
  EXPECT_EQ(stored_calibration_text(parse_stored_calibration(stored_calibration_text(stored))),
            stored_calibration_text(stored));
  const Rectification wide = rectification_of(stored, {1280, 960}, false, 1);
  EXPECT_FLOAT_EQ(wide.camera().fx, 0.768F * 1280);
  EXPECT_EQ(wide.baseline_m(), 0.24);
  EXPECT_EQ(rectification_of(stored, {1280, 960}, true, 1).baseline_m(), 0.12);
  EXPECT_FLOAT_EQ(rectification_of(stored, {1280, 960}, false, 2).camera().fx, 0.384F * 1280);
  EXPECT_EQ(rectification_of(stored, {1280, 960}, false, 2).camera().width, 640);
}

TEST(StoredCalibration, RefusesWhatItCannotBe) {
  const auto expect = [](const std::string& text, const char* cause) {
    try {
      (void)parse_stored_calibration(text);
      ADD_FAILURE() << "accepted: " << text;
    } catch (const std::runtime_error& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr(cause));
    }
  };
  const std::string good = "FocalLength 0.8 1.06 ImageCenter 0.5 0.5 BaseLine 0.12 ";
  expect("", "FocalLength");
  expect("FocalLength 0.8 ImageCenter 0.5 0.5", "FocalLength");
  expect("FocalLength 0.8 nan ImageCenter 0.5 0.5", "FocalLength");
  expect("FocalLength 0.8 1.06 BaseLine 0.12", "ImageCenter");
  expect("FocalLength 0.8 1.06 ImageCenter 0.5 0.5 BaseLine -1", "BaseLine");
  expect(good, "0 eyes");
  expect(good + "Warp 4 4 1 2 3", "coefficients");
  expect(good + "Warp 1e9 4", "columns and rows");
  expect(good + "Warp", "columns and rows");
  EXPECT_THROW(
      (void)rectification_of(parse_stored_calibration(good + line_warp() + line_warp()), {640, 480}, true, 1),
      std::runtime_error);
}

TEST(StoredCalibration, OfRandomTextNeverCrashes) {
  std::mt19937 random(3);
  const std::string letters = "FocalLengthImageCenterBaseLineWarp 0123456789.-e#\n\"\xff";
  for (int i = 0; i < 3000; ++i) {
    std::string text = i % 2 == 0 ? "FocalLength 1 1 ImageCenter .5 .5 BaseLine .1 Warp 4 4 " : "";
    for (auto n = random() % 200; n > 0; --n) text += letters[random() % letters.size()];
    try {
      (void)parse_stored_calibration(text);
    } catch (const std::runtime_error&) {
    }
  }
}

}  // namespace
}  // namespace floornav
