#include "tools/simulator/raycaster.hpp"

#include <cmath>
#include <optional>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "tools/simulator/random.hpp"
#include "tools/simulator/sensor_spec.hpp"

namespace floornav {
namespace {

Pinhole small_camera() {
  return kinect(160).camera;
}

std::vector<float> cast(const Shapes& shapes, const Pinhole& camera, const Pose& T_world_sensor) {
  std::vector<float> depth(static_cast<std::size_t>(camera.width * camera.height));
  cast_depth(shapes, camera, T_world_sensor, depth);
  return depth;
}

Eigen::Vector3d ray_of(const Pinhole& camera, const Pose& T_world_sensor, int u, int v) {
  return T_world_sensor.linear() *
         Eigen::Vector3d((u - static_cast<double>(camera.cx)) / static_cast<double>(camera.fx),
                         (v - static_cast<double>(camera.cy)) / static_cast<double>(camera.fy), 1.0);
}

class RaycasterSeeds : public ::testing::TestWithParam<std::uint64_t> {};

TEST_P(RaycasterSeeds, ATiltedPlanesDepthIsTheClosedFormToFloatAccuracy) {
  RandomStream random(random_key({GetParam(), 1}));
  const Pinhole camera = kinect().camera;
  Shapes shapes;
  shapes.ground.slope = {random.uniform(-0.15, 0.15), random.uniform(-0.15, 0.15)};
  const Pose T = mounted(random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(0.6, 1.5),
                         random.uniform(0, 50), random.uniform(-20, 20));
  const Eigen::Vector3d normal(-shapes.ground.slope.x(), -shapes.ground.slope.y(), 1.0);
  const std::vector<float> depth = cast(shapes, camera, T);
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const float measured = depth[static_cast<std::size_t>(v * camera.width + u)];
      const double rate = normal.dot(ray_of(camera, T, u, v));
      const double exact = -normal.dot(T.translation()) / rate;
      // a ray's direction is good to a few units in the last place of a float
      const double tolerance = 4e-7 * (1.0 + 1.0 / std::fabs(rate));
      if (exact <= 0 || exact > 1000.0) continue;
      ASSERT_NEAR(static_cast<double>(measured) / exact, 1.0, tolerance) << u << " " << v;
    }
  }
}

/// Whether a point lies in something solid, straight from the definitions of the shapes.
bool solid_at(const Shapes& shapes, const Eigen::Vector3d& p) {
  const Eigen::Vector2d xy = p.head<2>();
  bool in_hole = false;
  for (const Hole& hole : shapes.holes)
    if (hole.footprint.contains(hole.footprint.local(xy))) in_hole = p.z() > hole.bottom_m;
  if (!in_hole && p.z() < shapes.ground.slope.dot(xy)) return true;
  for (const Block& b : shapes.blocks) {
    const Eigen::Vector2d q = b.footprint.local(xy);
    if (b.footprint.contains(q) && p.z() > b.bottom_m && p.z() < b.top_m + b.slope.dot(q)) return true;
  }
  for (const Cylinder& c : shapes.cylinders)
    if ((xy - c.center_m).norm() < c.radius_m && p.z() > c.bottom_m && p.z() < c.top_m) return true;
  for (const Waves& w : shapes.waves) {
    const Eigen::Vector2d q = w.footprint.local(xy);
    if (!w.footprint.contains(q) || p.z() < w.base_m) continue;
    const double turns = (q.x() / w.footprint.half_m.x() + 1.0) / 2.0 * w.count;
    const double s = turns - std::floor(turns);
    if (p.z() < w.base_m + w.amplitude_m * 16.0 * s * s * (1 - s) * (1 - s)) return true;
  }
  return false;
}

Footprint random_footprint(RandomStream& random, double least_m, double most_m) {
  const Eigen::Vector2d axis = Eigen::Vector2d(random.uniform(-1, 1), random.uniform(-1, 1)).normalized();
  return {{random.uniform(1.2, 5.0), random.uniform(-2, 2)},
          axis,
          {random.uniform(least_m, most_m), random.uniform(least_m, most_m)}};
}

Shapes random_shapes(RandomStream& random) {
  Shapes shapes;
  for (int i = 0; i < 3; ++i)
    shapes.blocks.push_back({random_footprint(random, 0.1, 0.4),
                             0.0,
                             random.uniform(0.2, 0.6),
                             {random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2)}});
  shapes.blocks.push_back({random_footprint(random, 0.2, 0.4), 0.4, 0.45, {0, 0}});
  for (int i = 0; i < 3; ++i)
    shapes.cylinders.push_back({{random.uniform(1.2, 5), random.uniform(-2, 2)},
                                random.uniform(0.02, 0.3),
                                0.0,
                                random.uniform(0.1, 1.0)});
  shapes.waves.push_back({random_footprint(random, 0.4, 0.8), 0.0, 0.05, 3});
  shapes.holes.push_back({random_footprint(random, 0.3, 0.6), -0.5});
  return shapes;
}

TEST_P(RaycasterSeeds, EveryRayIsFreeUpToItsDepthAndEndsInASolid) {
  RandomStream random(random_key({GetParam(), 2}));
  const Pinhole camera = small_camera();
  const Shapes shapes = random_shapes(random);
  const Pose T = mounted(0, 0, random.uniform(0.5, 1.2), random.uniform(10, 35), random.uniform(-10, 10));
  const std::vector<float> depth = cast(shapes, camera, T);
  constexpr double kMargin_m = 1e-4;
  for (int k = 0; k < 3000; ++k) {
    const int u = random.below(camera.width);
    const int v = random.below(camera.height);
    const auto z = static_cast<double>(depth[static_cast<std::size_t>(v * camera.width + u)]);
    if (z > 8.0) continue;
    const Eigen::Vector3d d = ray_of(camera, T, u, v);
    // grazing rays leave a solid again within the margin: both sides must differ only where the ray goes in
    // for good
    const double past = 20 * kMargin_m;
    if (!solid_at(shapes, T.translation() + (z + kMargin_m) * d)) {
      ASSERT_TRUE(solid_at(shapes, T.translation() + (z + 1e-6) * d) ||
                  solid_at(shapes, T.translation() + (z + past) * d))
          << "pixel " << u << ", " << v << " ends in the air at " << z;
    }
    for (double t = 0.05; t < z - kMargin_m; t += 0.004)
      ASSERT_FALSE(solid_at(shapes, T.translation() + t * d))
          << "pixel " << u << ", " << v << " misses a solid at " << t;
  }
}

TEST_P(RaycasterSeeds, WhatStandsPartlyBehindTheCameraIsSeen) {
  RandomStream random(random_key({GetParam(), 3}));
  Shapes shapes;  // a platform that begins behind the camera, and a wall along the way
  shapes.blocks.push_back({{{0, 0}, {1, 0}, {3, 3}}, 0.0, 0.1, {0, 0}});
  shapes.blocks.push_back({{{0, 0.5}, {1, 0}, {4, 0.05}}, 0.0, 2.0, {0, 0}});
  const Pose T = mounted(0, 0, random.uniform(0.5, 1.0), random.uniform(15, 30));
  const Pinhole camera = small_camera();
  const std::vector<float> depth = cast(shapes, camera, T);
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const Eigen::Vector3d d = ray_of(camera, T, u, v);
      double exact = d.z() < 0 ? -T.translation().z() / d.z() : 1e9;
      const double to_top = (0.1 - T.translation().z()) / d.z();
      if (to_top > 0 && (to_top * d.head<2>()).cwiseAbs().maxCoeff() < 2.999) exact = to_top;
      const double to_wall = 0.45 / d.y();
      if (to_wall > 0 && to_wall * d.x() < 3.999 && T.translation().z() + to_wall * d.z() < 1.999)
        exact = std::min(exact, to_wall);
      if (exact > 3.9) continue;
      ASSERT_NEAR(static_cast<double>(depth[static_cast<std::size_t>(v * camera.width + u)]), exact,
                  2e-5 * exact);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, RaycasterSeeds, ::testing::Range<std::uint64_t>(1, 13));

TEST(Raycaster, ALevelCameraSeesABoxInItsMiddleRow) {
  Shapes shapes;
  shapes.blocks.push_back({{{2.5, 0}, {1, 0}, {0.5, 0.5}}, 0.0, 1.0, {0, 0}});
  Pinhole camera = small_camera();
  camera.cx = 80;
  camera.cy = 60;  // a row exactly on the horizon: its rays are parallel to the box's top
  const std::vector<float> depth = cast(shapes, camera, mounted(0, 0, 0.5, 0));
  EXPECT_FLOAT_EQ(depth[60 * 160 + 80], 2.0F);
  EXPECT_FLOAT_EQ(depth[60 * 160 + 85], 2.0F);
  EXPECT_EQ(depth[60 * 160 + 5], kNoHit);
  EXPECT_EQ(depth[5 * 160 + 80], kNoHit);
}

TEST(Raycaster, AThinLegKeepsItsWidth) {
  Shapes shapes;
  shapes.cylinders.push_back({{4.0, 0.0}, 0.01, 0.0, 2.0});
  const Pinhole camera = kinect().camera;
  const std::vector<float> depth = cast(shapes, camera, mounted(0, 0, 0.5, 0));
  int hits = 0;
  for (int v = 150; v < 250; ++v)
    for (int u = 0; u < 640; ++u)
      if (depth[static_cast<std::size_t>(v * 640 + u)] < 4.1F) ++hits;
  EXPECT_NEAR(hits / 100.0, 575.0 * 0.02 / 4.0, 1.0);
}

}  // namespace
}  // namespace floornav
