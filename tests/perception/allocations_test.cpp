#include <gtest/gtest.h>

#include "perception/floor_perception.hpp"
#include "runtime/geometry/parallel.hpp"
#include "tests/lcmtypes/allocation_meter.hpp"
#include "tests/perception/rendered_scene.hpp"

namespace floornav {
namespace {

RenderedScene scene_of(unsigned seed) {
  RenderedScene scene;
  scene.camera = {262.5F, 262.5F, 159.5F, 119.5F, 320, 240};
  scene.baseline_m = 0.15F;
  scene.mount(0.9, 25.0);
  scene.seed = seed;
  scene.missing_share = 0.05;
  scene.boxes.push_back({{1.2, 0.1, 0.0}, {1.5, 0.4, 0.1}});
  scene.boxes.push_back({{2.4, -0.8, 0.0}, {2.8, -0.2, 0.5}});
  return scene;
}

TEST(FloorPerceptionAllocations, ThereAreNoneOnceFramesOfAKindWereSeen) {
  Serial serial;
  FloorPerception perception({}, {});
  constexpr unsigned kFrames = 4;
  std::vector<RenderedScene> scenes;
  std::vector<DepthFrame> frames;
  for (unsigned i = 0; i < kFrames; ++i) scenes.push_back(scene_of(i));
  for (RenderedScene& scene : scenes) frames.push_back(scene.render());
  const Admission all = [](std::int64_t) { return true; };
  const StageEnd nobody = [](PerceptionStage) {};
  std::size_t cells = 0;
  take_allocated_bytes();
  for (int round = 0; round < 4; ++round) {
    const bool is_warm = round >= 2;  // in the first round normals are learnt, in the second vectors grow
    for (const DepthFrame& frame : frames) {
      cells += perception.process(frame, Pose::Identity(), serial, all, nobody).cells.size();
      const std::size_t allocated = take_allocated_bytes();
      if (is_warm) {
        EXPECT_EQ(allocated, 0U) << "bytes in round " << round;
      } else if (round == 0 && &frame == &frames.front()) {
        EXPECT_GT(allocated, 1'000'000U);  // the meter counts
      }
    }
  }
  EXPECT_GT(cells, 10'000U);
}

}  // namespace
}  // namespace floornav
