// A real Kinect's recording through driver and perception.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <vector>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "drivers/camera/mounting.hpp"
#include "drivers/kinect/node/openni_device.hpp"
#include "perception/floor_perception.hpp"
#include "tests/real_data.hpp"
#include "tools/import/depth_image.hpp"

namespace floornav {
namespace {

using Image = std::vector<std::uint16_t>;

struct Recording {
  DepthStream stream;
  std::vector<Image> images;
};

Recording play(const std::filesystem::path& file) {
  KinectSettings settings;
  settings.device = file.string();
  OpenNiDevice device(settings, {Playback::kByHand, ""});
  Recording recording{device.open(), {}};
  for (DepthDevice::Event event;
       (event = device.wait(std::chrono::seconds(1))) != DepthDevice::Event::kGone;) {
    recording.images.emplace_back();
    EXPECT_EQ(copy_depths(device.frame(), recording.stream.shape, recording.images.back()), FrameFlaw::kNone);
  }
  return recording;
}

struct Shadows {
  int left = 0;  ///< of what casts them
  int right = 0;
};

/// Runs of missing depth as wide as the shadow that a near thing throws on a far one where the light comes
/// from `baseline_m` beside the camera. A Kinect's projector stands to the right of its camera, as the camera
/// sees it: its shadows lie to the left of what casts them, unless the image is mirrored.
Shadows shadows_in(const Image& image, int width, double count_m, double fx) {
  constexpr double kBaseline_m = 0.075;
  constexpr double kLeastWidth_px = 8;
  Shadows shadows;
  for (auto row = image.begin(); row != image.end(); row += width)
    for (auto begin = row; begin != row + width;) {
      begin = std::find(begin, row + width, 0);
      const auto end = std::find_if(begin, row + width, [](std::uint16_t depth) { return depth != 0; });
      if (begin != row && begin != row + width && end != row + width) {
        const double left_m = *(begin - 1) * count_m;
        const double right_m = *end * count_m;
        const double wide_px = fx * kBaseline_m * std::abs(1 / left_m - 1 / right_m);
        const double off_px = std::abs(static_cast<double>(end - begin) - wide_px);
        if (wide_px > kLeastWidth_px && off_px < 2 + 0.35 * wide_px)
          ++(right_m < left_m ? shadows.left : shadows.right);
      }
      begin = end;
    }
  return shadows;
}

class RealRecording : public testing::Test {
 protected:
  void SetUp() override {
    file = real_data("kinect_oni") / "test.oni";
    if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is absent";
  }
  std::filesystem::path file;
};

TEST_F(RealRecording, ShowsTheProjectorsShadowsOnTheSideWhereTheyBelong) {
  const Recording recording = play(file);
  const double fx = static_cast<double>(recording.stream.camera.fx);
  for (const Image& image : recording.images) {
    const Shadows shadows = shadows_in(image, 640, 0.001, fx);
    EXPECT_GT(shadows.left, 50);
    EXPECT_LT(shadows.right, shadows.left / 10);
  }
}

/// The same rule on frames of a Kinect that are known not to be mirrored.
TEST(ProjectorsShadows, LieToTheLeftInTumsFrames) {
  const std::filesystem::path folder = real_data("tum_fr1_rpy") / "depth";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is absent";
  Shadows all;
  int frames = 0;
  for (const auto& file : depth_images_in(folder)) {
    if (frames++ % 20 != 0) continue;
    const Shadows shadows = shadows_in(read_depth_image(file).pixels, 640, 1 / 5000.0, 517.3);
    all.left += shadows.left;
    all.right += shadows.right;
  }
  EXPECT_GT(all.left, 200);
  EXPECT_LT(all.right, all.left / 4);
}

/// Height, pitch and roll of a camera above the plane of its own points that fits an image's window best, by
/// least squares with those left out that lie more than 2 cm off.
struct FloorFit {
  double height_m = 0;
  double pitch_deg = 0;
  double roll_deg = 0;
};

FloorFit fit_floor(const Image& image, const Pinhole& camera, int left, int top, int right, int bottom) {
  std::vector<Eigen::Vector3d> points;
  for (int row = top; row < bottom; ++row)
    for (int column = left; column < right; ++column) {
      const double z = image[static_cast<std::size_t>(row * camera.width + column)] * 1e-3;
      if (z > 0)
        points.push_back(camera.ray(static_cast<float>(column), static_cast<float>(row)).cast<double>() * z);
    }
  Eigen::Vector3d plane = Eigen::Vector3d::Zero();  // y = plane . (1, x, z)
  double inside_m = 1e9;
  for (int round = 0; round < 8; ++round, inside_m = 0.02) {
    Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
    Eigen::Vector3d sums = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& p : points) {
      const Eigen::Vector3d terms(1, p.x(), p.z());
      if (std::abs(p.y() - plane.dot(terms)) > inside_m) continue;
      squares += terms * terms.transpose();
      sums += terms * p.y();
    }
    plane = squares.ldlt().solve(sums);
  }
  constexpr double kDegree = M_PI / 180;
  const Eigen::Vector3d down = Eigen::Vector3d(-plane[1], 1, -plane[2]).normalized();
  return {plane[0] * down.y(), std::asin(down.z()) / kDegree, std::atan2(down.x(), down.y()) / kDegree};
}

/// The recording shows a strip of floor at the image's lower edge. Mounted as a fit by hand says, perception
/// must find it at height 0, and level.
TEST_F(RealRecording, PerceptionFindsTheStripOfFloor) {
  constexpr int kLeft = 255;
  constexpr int kTop = 440;
  constexpr int kRight = 395;
  constexpr int kBottom = 478;
  const Recording recording = play(file);
  PerceptionSettings settings;
  settings.roi.z_min_m = -0.1;
  FloorPerception perception(settings, RobotSettings{});
  Serial serial;
  for (const Image& image : recording.images) {
    const FloorFit fit = fit_floor(image, recording.stream.camera, kLeft, kTop, kRight, kBottom);
    EXPECT_NEAR(fit.height_m, 0.45, 0.02);
    MountingSettings mounting;
    mounting.height_m = fit.height_m;
    mounting.pitch_deg = fit.pitch_deg;
    mounting.roll_deg = fit.roll_deg;
    DepthFrame frame;
    frame.camera = recording.stream.camera;
    frame.pixels = image;
    frame.T_body_sensor = sensor_in_body(mounting);
    const FloorEvidence evidence =
        perception.process(frame, Pose::Identity(), serial, [](std::int64_t) { return true; });
    const auto is_floor = [](const Surfel& s) {
      return s.traversable && s.points > 1000 && std::abs(s.centroid_m.z()) < 0.02 &&
             static_cast<double>(s.normal.z()) > std::cos(3 * M_PI / 180);
    };
    EXPECT_TRUE(std::any_of(evidence.surfels.begin(), evidence.surfels.end(), is_floor));
  }
}

}  // namespace
}  // namespace floornav
