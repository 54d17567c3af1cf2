#include "perception/section_planes.hpp"

#include <numbers>
#include <random>

#include <gtest/gtest.h>

namespace floornav {
namespace {

/// A horizontal piece of floor in front of a sensor, or a wall: z = height, or x = place.
struct Patch {
  double height;
  double x_min, x_max;
};

/// One section seen by a Kinect 0.9 m high, 25 degrees down: pixels with noise by eq. (3), written
/// for this test.
class SectionScene {
 public:
  explicit SectionScene(double x_min = 0.0, double x_max = 3.0) : x_min_(x_min), x_max_(x_max) {
    Eigen::Matrix3d axes;
    axes << 0, 0, 1, -1, 0, 0, 0, -1, 0;
    frame_.T_body_sensor.linear() =
        Eigen::AngleAxisd(25.0 * std::numbers::pi / 180.0, Eigen::Vector3d::UnitY()).toRotationMatrix() *
        axes;
    frame_.T_body_sensor.translation() = Eigen::Vector3d(0, 0, 0.9);
  }

  void render(const std::vector<Patch>& patches, double wall_x, unsigned seed) {
    std::mt19937 generator(seed);
    std::normal_distribution<double> noise(0.0, 1.0);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    const Eigen::Matrix3d R = frame_.T_body_sensor.linear();
    for (int v = 0; v < 480; v += 2)
      for (int u = 100; u < 540; u += 2) {
        const Eigen::Vector3f ray = frame_.camera.ray(static_cast<float>(u), static_cast<float>(v));
        const Eigen::Vector3d d = R * ray.cast<double>();
        double depth = d.x() > 0 ? wall_x / d.x() : 1e9;
        for (const Patch& patch : patches) {
          const double t = (patch.height - 0.9) / d.z();
          if (t > 0 && t * d.x() >= patch.x_min && t * d.x() <= patch.x_max) depth = std::min(depth, t);
        }
        if (depth > 5.0 || depth * d.x() < x_min_ || depth * d.x() > x_max_) continue;
        double inverse = 1.0 / depth + 0.067 / (525.0 * 0.075) * noise(generator);
        if (uniform(generator) < 0.02) inverse = 1.0 / (0.6 + 2.0 * uniform(generator));
        add(ray, static_cast<float>(inverse), v * 640 + u);
      }
    cloud_.section_end = {static_cast<std::int32_t>(cloud_.size())};
    label_.assign(cloud_.size(), kNoPlane);
  }

  std::vector<SectionPlane> find(std::uint64_t seed, const PlaneSettings& settings = {}) {
    const SensorView view(frame_, Pose::Identity());
    Serial serial;
    SectionScratch scratch;
    std::vector<SectionPlane> planes;
    SectionPlaneFinder(settings, {})
        .find(cloud_, 0, view, Eigen::Vector3d::UnitZ(), seed, label_, serial, scratch, planes);
    return planes;
  }

  /// Height of a plane above a place of the body frame.
  [[nodiscard]] double height_at(const InverseDepthPlane& plane, double x, double y) const {
    const Eigen::Vector3d n = normal(plane);
    const double d = n.z() * 0.9 - static_cast<double>(plane.distance_m());
    return (d - n.x() * x - n.y() * y) / n.z();
  }
  [[nodiscard]] Eigen::Vector3d normal(const InverseDepthPlane& plane) const {
    return frame_.T_body_sensor.linear() * plane.normal().cast<double>();
  }
  [[nodiscard]] std::int64_t labelled(std::int16_t index) const {
    return std::count(label_.begin(), label_.end(), index);
  }
  [[nodiscard]] std::size_t size() const { return cloud_.size(); }

 private:
  void add(const Eigen::Vector3f& ray, float inverse, int pixel) {
    cloud_.ray_x.push_back(ray.x());
    cloud_.ray_y.push_back(ray.y());
    cloud_.inverse_depth.push_back(inverse);
    cloud_.z.push_back(1.0F / inverse);
    cloud_.x.push_back(ray.x() / inverse);
    cloud_.y.push_back(ray.y() / inverse);
    cloud_.certainty.push_back(525.0F * 0.075F / 0.067F);
    cloud_.pixel.push_back(pixel);
    cloud_.block.push_back(pixel / 640 / 8 * 80 + pixel % 640 / 8);
  }

  double x_min_, x_max_;
  DepthFrame frame_;
  RoiCloud cloud_;
  std::vector<std::int16_t> label_;
};

double tilt_deg(const Eigen::Vector3d& normal) {
  return std::acos(std::min(1.0, normal.z())) * 180.0 / std::numbers::pi;
}

class PlanesOfSection : public testing::TestWithParam<unsigned> {};

TEST_P(PlanesOfSection, FloorAndWallAreFoundToMillimetres) {
  SectionScene scene;
  scene.render({{0.0, 0.0, 10.0}}, 2.0, GetParam());
  const auto planes = scene.find(GetParam());
  ASSERT_GE(planes.size(), 2U);
  EXPECT_TRUE(planes[0].dominant);
  EXPECT_LT(tilt_deg(scene.normal(planes[0].plane)), 0.2);
  EXPECT_NEAR(scene.height_at(planes[0].plane, 1.5, 0.0), 0.0, 0.001);
  EXPECT_FALSE(planes[1].dominant);
  const Eigen::Vector3d wall = scene.normal(planes[1].plane);
  EXPECT_LT(wall.x(), -0.9998);  // 1.1 degrees
  EXPECT_NEAR(static_cast<double>(planes[1].plane.distance_m()) / -wall.x(), 2.0, 0.01);
}

TEST_P(PlanesOfSection, TwoLevelsTwoCentimetresApartComeOutAsTwoPlanes) {
  SectionScene scene(0.6, 1.8);
  scene.render({{0.0, 0.0, 1.2}, {0.02, 1.2, 10.0}}, 1e9, GetParam());
  const auto planes = scene.find(GetParam());
  ASSERT_GE(planes.size(), 2U);
  EXPECT_TRUE(planes[0].dominant);
  const bool upper_first = scene.height_at(planes[0].plane, 1.2, 0.0) > 0.01;
  const auto& lower = planes[upper_first ? 1 : 0].plane;
  const auto& upper = planes[upper_first ? 0 : 1].plane;
  EXPECT_NEAR(scene.height_at(lower, 0.9, 0.0), 0.0, 0.001);
  EXPECT_NEAR(scene.height_at(upper, 1.5, 0.0), 0.02, 0.001);
}

TEST_P(PlanesOfSection, ADeskThatHidesMostOfTheFloorIsNotTheFloor) {
  SectionScene scene;
  scene.render({{0.6, 0.3, 1.0}, {0.0, 0.0, 10.0}}, 1e9, GetParam());
  const auto planes = scene.find(GetParam());
  ASSERT_GE(planes.size(), 2U);
  EXPECT_TRUE(planes[0].dominant);
  EXPECT_NEAR(scene.height_at(planes[0].plane, 2.0, 0.0), 0.0, 0.003);
  EXPECT_FALSE(planes[1].dominant);
  EXPECT_NEAR(scene.height_at(planes[1].plane, 0.6, 0.0), 0.6, 0.002);
  EXPECT_GT(scene.labelled(1), scene.labelled(0));
}

INSTANTIATE_TEST_SUITE_P(Seeds, PlanesOfSection, testing::Range(0U, 100U));

TEST(SectionPlanes, OutliersAndNoiseMakeNoPlanesOfTheirOwn) {
  SectionScene scene;
  scene.render({{0.0, 0.0, 10.0}}, 1e9, 5);
  EXPECT_EQ(scene.find(5).size(), 1U);
  EXPECT_GT(static_cast<double>(scene.labelled(0)), 0.95 * static_cast<double>(scene.size()));
}

TEST(SectionPlanes, NoFloorWhereNothingIsWithinTheNormalsTolerance) {
  SectionScene scene;
  scene.render({}, 1.5, 1);
  const auto planes = scene.find(1);
  ASSERT_EQ(planes.size(), 1U);
  EXPECT_FALSE(planes[0].dominant);
}

TEST(SectionPlanes, TheRecursionsLimitHolds) {
  SectionScene scene;
  scene.render({{0.0, 0.0, 1.2}, {0.1, 1.2, 1.6}, {0.2, 1.6, 2.0}, {0.3, 2.0, 10.0}}, 1e9, 1);
  PlaneSettings settings;
  EXPECT_GE(scene.find(1, settings).size(), 4U);
  settings.max_planes = 1;
  EXPECT_LE(scene.find(1, settings).size(), 2U);
}

TEST(SectionPlanes, TooFewPointsAreNoPlane) {
  SectionScene scene;
  scene.render({}, 1e9, 1);
  EXPECT_TRUE(scene.find(1).empty());
}

}  // namespace
}  // namespace floornav
