#include <algorithm>
#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "perception/floor_perception.hpp"
#include "tests/perception/rendered_scene.hpp"

namespace floornav {
namespace {

/// A camera 0.9 m high and 25 degrees down, as a whole Kinect has it, and a box that hides floor behind it.
RenderedScene scene_with_box(unsigned seed) {
  RenderedScene scene;
  scene.seed = seed;
  scene.missing_share = 0.05;
  scene.mount(0.9, 25.0);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-0.3, 0.3);
  const Eigen::Vector3d low(1.4 + place(random), place(random) - 0.2, -1.0);
  scene.boxes.push_back({low, low + Eigen::Vector3d(0.3, 0.4, 1.0 + 0.3 + place(random) / 2)});
  return scene;
}

/// Which share of a cell of floor can be seen, by rays to a hundred places in it.
double visible_share(const RenderedScene& scene, const Lattice& lattice, CellIndex cell) {
  constexpr int kSide = 10;
  const Eigen::Vector3d eye = (scene.T_world_body * scene.T_body_sensor).translation();
  int seen = 0;
  for (int i = 0; i < kSide * kSide; ++i) {
    const Eigen::Vector3d place(
        lattice.center_of(cell.ix) + lattice.pitch_m * ((i % kSide + 0.5) / kSide - 0.5),
        lattice.center_of(cell.iy) + lattice.pitch_m * ((i / kSide + 0.5) / kSide - 0.5), 0);
    seen += scene.depth_along(eye, place - eye) > 1 - 1e-6 ? 1 : 0;
  }
  return static_cast<double>(seen) / (kSide * kSide);
}

class HiddenParts : public testing::TestWithParam<unsigned> {};

TEST_P(HiddenParts, AreToldOfCellsThroughWhichTheShadowsBorderGoesAndOfNoOthers) {
  constexpr double kFarthest_m = 3.0;
  RenderedScene scene = scene_with_box(GetParam());
  const DepthFrame frame = scene.render();
  Serial serial;
  const FloorEvidence evidence =
      FloorPerception({}, {}).process(frame, scene.T_world_body, serial, [](std::int64_t) { return true; });
  int cut = 0, cut_told = 0, whole = 0, whole_told = 0;
  for (const CellEvidence& cell : evidence.cells) {
    const bool is_floor =
        cell.surfel >= 0 && evidence.surfels[static_cast<std::size_t>(cell.surfel)].dominant;
    if (!is_floor || evidence.lattice.center_of(cell.cell.ix) > kFarthest_m) continue;
    double least = 1.0;
    for (int d = 0; d < 9; ++d) {
      const CellIndex around{cell.cell.ix + d % 3 - 1, cell.cell.iy + d / 3 - 1};
      const double share = visible_share(scene, evidence.lattice, around);
      least = std::min(least, share);
    }
    const double own = visible_share(scene, evidence.lattice, cell.cell);
    if (own > 0.1 && own < 0.9) {
      ++cut;
      cut_told += cell.partly_hidden ? 1 : 0;
    } else if (least == 1.0) {
      ++whole;
      whole_told += cell.partly_hidden ? 1 : 0;
    }
  }
  EXPECT_GT(cut, 20);
  EXPECT_GE(cut_told, 0.9 * cut);
  EXPECT_GT(whole, 500);
  EXPECT_LE(whole_told, 0.02 * whole);  // by noise, for a frame
}

INSTANTIATE_TEST_SUITE_P(Seeds, HiddenParts, testing::Range(1U, 6U));

}  // namespace
}  // namespace floornav
