#include "perception/compromise.hpp"

#include <gtest/gtest.h>

#include "perception/floor_perception.hpp"
#include "perception/thinned_frame.hpp"
#include "tests/perception/rendered_scene.hpp"

namespace floornav {
namespace {

constexpr std::int64_t kPoints = 260'000, kPixels = 640 * 480;

std::int64_t work_of(const Compromise& compromise) {
  return static_cast<std::int64_t>(compromise.work_per_point_ns() * kPoints + kWorkPerPixel_ns * kPixels);
}

TEST(Compromise, EachLevelIsLessWorkAndTellsWhatItGivesUp) {
  EXPECT_EQ(Compromise::at(0).text(), "");
  for (int level = 1; level < Compromise::kLevels; ++level) {
    EXPECT_LT(Compromise::at(level).work_per_point_ns(), Compromise::at(level - 1).work_per_point_ns());
    EXPECT_NE(Compromise::at(level).text(), Compromise::at(level - 1).text());
  }
}

TEST(Compromise, NothingIsGivenUpWhereTimeIsNotShort) {
  CompromiseControl control;
  EXPECT_EQ(control.choose(std::numeric_limits<std::int64_t>::max(), kPoints, kPixels).level, 0);
  EXPECT_EQ(control.choose(2 * work_of(Compromise::at(0)), kPoints, kPixels).level, 0);
}

TEST(Compromise, TheFirstLevelThatMeetsTheDeadlineIsTaken) {
  for (int level = 1; level < Compromise::kLevels; ++level) {
    CompromiseControl control;
    const std::int64_t budget = work_of(Compromise::at(level)) + 1000;
    EXPECT_EQ(control.choose(budget, kPoints, kPixels).level, level);
    EXPECT_EQ(control.choose(budget, kPoints, kPixels).level, level);
    EXPECT_EQ(control.choose(10 * budget, kPoints, kPixels).level, 0);
  }
}

TEST(Compromise, TheFourKnobsAreApplied) {
  const PlaneSettings settings;
  const PlaneSettings applied = Compromise::at(3).applied_to(settings);
  EXPECT_LT(applied.max_hypotheses, settings.max_hypotheses);
  EXPECT_LT(applied.max_planes, settings.max_planes);
  EXPECT_GT(applied.min_points, settings.min_points);
  EXPECT_EQ(Compromise::at(4).point_stride, 2);
}

/// The pixel that stands for n x n others looks along its own ray.
TEST(ThinnedFrame, EachPixelKeepsItsRayAndItsNoise) {
  RenderedScene scene;
  scene.mount(0.9, 25.0);
  const DepthFrame frame = scene.render();
  ThinnedFrame thinned_frame;
  for (const int stride : {2, 3, 4}) {
    const DepthFrame thinned = thinned_frame.thin(frame, stride);
    ASSERT_EQ(thinned.pixels.size(), static_cast<std::size_t>(thinned.camera.width) *
                                         static_cast<std::size_t>(thinned.camera.height));
    const int first = (stride - 1) / 2;
    for (const auto& [u, v] : {std::pair{0, 0}, std::pair{37, 50}, std::pair{thinned.camera.width - 1, 1}}) {
      const int whole_u = first + u * stride, whole_v = first + v * stride;
      ASSERT_LT(whole_u, frame.camera.width);
      EXPECT_EQ(thinned.pixels[static_cast<std::size_t>(v * thinned.camera.width + u)],
                frame.pixels[static_cast<std::size_t>(whole_v * frame.camera.width + whole_u)]);
      EXPECT_LT((thinned.camera.ray(static_cast<float>(u), static_cast<float>(v)) -
                 frame.camera.ray(static_cast<float>(whole_u), static_cast<float>(whole_v)))
                    .norm(),
                1e-5F);
    }
    // sigma of the inverse depth
    EXPECT_NEAR(thinned.disparity_sigma_px / thinned.camera.fx, frame.disparity_sigma_px / frame.camera.fx,
                1e-9F);
  }
}

TEST(Compromise, FloorAndBoxAreThereAtEveryLevel) {
  RenderedScene scene;
  scene.mount(0.9, 25.0);
  scene.boxes.push_back({{1.2, -0.2, -1.0}, {1.5, 0.2, 0.1}});
  const DepthFrame frame = scene.render();
  Serial serial;
  for (int level = 0; level < Compromise::kLevels; ++level) {
    FloorPerception perception({}, {});
    perception.set_compromise(Compromise::at(level));
    const FloorEvidence evidence =
        perception.process(frame, scene.T_world_body, serial, [](std::int64_t) { return true; });
    EXPECT_EQ(evidence.compromise.level, level);
    const auto mean_at = [&](double x, double y) {
      const CellIndex wanted = evidence.lattice.cell_of(x, y);
      for (const CellEvidence& cell : evidence.cells)
        if (cell.cell == wanted) return static_cast<double>(cell.mean_z_m);
      return std::numeric_limits<double>::quiet_NaN();
    };
    EXPECT_NEAR(mean_at(0.9, 0.0), 0.0, 0.005) << "level " << level;
    EXPECT_NEAR(mean_at(1.37, 0.02), 0.1, 0.01) << "level " << level;
  }
}

}  // namespace
}  // namespace floornav
