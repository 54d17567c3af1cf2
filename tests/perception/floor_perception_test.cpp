#include "perception/floor_perception.hpp"

#include <algorithm>
#include <bit>
#include <thread>

#include <gtest/gtest.h>

#include "runtime/process/thread_pool.hpp"
#include "tests/perception/rendered_scene.hpp"

namespace floornav {
namespace {

bool admit_all(std::int64_t) {
  return true;
}

/// Runs pieces on threads, the last ones first: results must not depend on who does what when.
class Shuffled final : public Parallel {
 public:
  explicit Shuffled(int workers) : workers_(workers) {}
  [[nodiscard]] int workers() const override { return workers_; }
  void run(int count, const std::function<void(int, int)>& piece) override {
    static thread_local int outer_worker = -1;
    const auto run_each = [&](int first, int step, int worker) {
      for (int index = count - 1 - first; index >= 0; index -= step) piece(index, worker);
    };
    if (outer_worker >= 0) return run_each(0, 1, outer_worker);
    std::vector<std::jthread> threads;
    for (int worker = 0; worker < workers_; ++worker)
      threads.emplace_back([&, worker] {
        outer_worker = worker;
        run_each(worker, workers_, worker);
      });
  }

 private:
  int workers_;
};

/// A camera 0.9 m high and 25 degrees down, at a quarter of a Kinect's resolution.
RenderedScene small_scene() {
  RenderedScene scene;
  scene.camera = {262.5F, 262.5F, 159.5F, 119.5F, 320, 240};
  scene.baseline_m = 0.15F;  // the noise of a whole Kinect, in fewer pixels
  scene.mount(0.9, 25.0);
  scene.T_world_body.translation() = Eigen::Vector3d(3.017, -2.003, 0.0);
  return scene;
}

FloorEvidence perceive(RenderedScene& scene, const PerceptionSettings& settings = {}) {
  const DepthFrame frame = scene.render();
  Serial serial;
  return FloorPerception(settings, {}).process(frame, scene.T_world_body, serial, admit_all);
}

void add_box(RenderedScene& scene, double x, double y, double side, double height) {
  const Eigen::Vector3d body = scene.T_world_body.translation();
  scene.boxes.push_back({body + Eigen::Vector3d(x - side / 2, y - side / 2, -1.0),
                         body + Eigen::Vector3d(x + side / 2, y + side / 2, height)});
}

const CellEvidence* cell_at(const FloorEvidence& evidence, double x, double y) {
  const CellIndex wanted = evidence.lattice.cell_of(x, y);
  for (const CellEvidence& cell : evidence.cells)
    if (cell.cell == wanted) return &cell;
  return nullptr;
}

/// Compares bit by bit, NaN with NaN.
void expect_same(const FloorEvidence& a, const FloorEvidence& b) {
  const auto same = [](float x, float y) {
    return std::bit_cast<std::uint32_t>(x) == std::bit_cast<std::uint32_t>(y);
  };
  ASSERT_EQ(a.surfels.size(), b.surfels.size());
  for (std::size_t i = 0; i < a.surfels.size(); ++i) {
    EXPECT_EQ(a.surfels[i].centroid_m, b.surfels[i].centroid_m);
    EXPECT_EQ(a.surfels[i].normal, b.surfels[i].normal);
    EXPECT_EQ(a.surfels[i].points, b.surfels[i].points);
    EXPECT_TRUE(same(a.surfels[i].radius_m, b.surfels[i].radius_m) &&
                same(a.surfels[i].rms_m, b.surfels[i].rms_m));
  }
  ASSERT_EQ(a.cells.size(), b.cells.size());
  for (std::size_t i = 0; i < a.cells.size(); ++i) {
    const CellEvidence &p = a.cells[i], &q = b.cells[i];
    ASSERT_TRUE(p.cell == q.cell && p.surfel == q.surfel && p.points == q.points &&
                p.no_return == q.no_return && same(p.mean_z_m, q.mean_z_m) && same(p.var_z_m2, q.var_z_m2) &&
                same(p.top_z_m, q.top_z_m) && same(p.ray_z_m, q.ray_z_m))
        << "cell " << i;
  }
}

TEST(FloorPerception, FlatFloorIsFlatToMillimetres) {
  RenderedScene scene = small_scene();
  scene.missing_share = 0.05;
  const FloorEvidence evidence = perceive(scene);
  ASSERT_EQ(evidence.sections.size(), 12U);
  std::vector<int> dominant(12, 0);
  for (const Surfel& surfel : evidence.surfels) {
    EXPECT_TRUE(surfel.traversable);
    EXPECT_NEAR(surfel.centroid_m.z(), 0.0, 0.003);
    EXPECT_GT(surfel.normal.z(), 0.999F);
    dominant[static_cast<std::size_t>(surfel.section)] += surfel.dominant ? 1 : 0;
  }
  EXPECT_EQ(dominant, std::vector<int>(12, 1));
  int seen = 0;
  for (const CellEvidence& cell : evidence.cells) {
    EXPECT_FALSE(cell.no_return);
    if (cell.points == 0) continue;
    ++seen;
    EXPECT_NEAR(cell.mean_z_m, 0.0, 0.01);
    EXPECT_NEAR(cell.top_z_m, 0.0, 0.015);
  }
  EXPECT_GT(seen, 4000);
}

TEST(FloorPerception, BoxTopsAndTheFloorAroundThemHaveTheirHeights) {
  RenderedScene scene = small_scene();
  const Eigen::Vector3d body = scene.T_world_body.translation();
  add_box(scene, 1.2, 0.4, 0.3, 0.05);
  add_box(scene, 1.6, -0.4, 0.3, 0.10);
  add_box(scene, 2.2, 0.3, 0.3, 0.40);
  const FloorEvidence evidence = perceive(scene);
  for (const auto& [x, y, height] : {std::tuple{1.2, 0.4, 0.05}, {1.6, -0.4, 0.10}, {2.2, 0.3, 0.40}}) {
    const CellEvidence* top = cell_at(evidence, body.x() + x, body.y() + y);
    ASSERT_NE(top, nullptr);
    ASSERT_GE(top->surfel, 0) << "box at " << x << " top " << top->top_z_m << " mean " << top->mean_z_m
                              << " n " << top->points;
    EXPECT_NEAR(top->mean_z_m, height, 0.003) << "box at " << x;
    EXPECT_NEAR(top->top_z_m, height, 0.005) << "box at " << x;
    const CellEvidence* before = cell_at(evidence, body.x() + x - 0.25, body.y() + y);
    ASSERT_NE(before, nullptr);
    EXPECT_NEAR(before->top_z_m, 0.0, 0.005) << "box at " << x;
  }
}

TEST(FloorPerception, NothingIsPaintedWhereNothingWasSeen) {
  RenderedScene scene = small_scene();
  const Eigen::Vector3d body = scene.T_world_body.translation();
  add_box(scene, 1.5, 0.0, 0.4, 0.4);
  const FloorEvidence evidence = perceive(scene);
  const CellEvidence* shadow = cell_at(evidence, body.x() + 2.0, body.y());  // hidden by the box, 0.7 m long
  EXPECT_TRUE(shadow == nullptr || shadow->points == 0);
}

TEST(FloorPerception, ATwoCentimetreStepIsItsOwnSurfel) {
  RenderedScene scene = small_scene();
  const Eigen::Vector3d body = scene.T_world_body.translation();
  scene.boxes.push_back({{body.x() + 1.5, -50.0, -1.0}, {100.0, 50.0, 0.02}});
  const FloorEvidence evidence = perceive(scene);
  bool lower = false, upper = false;
  for (const Surfel& surfel : evidence.surfels) {
    if (surfel.section != 4) continue;  // 1.225 .. 2.45 m straight ahead
    lower = lower || std::abs(surfel.centroid_m.z()) < 0.002;
    upper = upper || std::abs(surfel.centroid_m.z() - 0.02) < 0.002;
  }
  EXPECT_TRUE(lower && upper);
  EXPECT_NEAR(cell_at(evidence, body.x() + 1.35, body.y())->mean_z_m, 0.0, 0.003);
  EXPECT_NEAR(cell_at(evidence, body.x() + 1.65, body.y())->mean_z_m, 0.02, 0.003);
}

TEST(FloorPerception, ARampIsFoundWithItsSlope) {
  RenderedScene scene = small_scene();
  scene.T_world_body.translation() = Eigen::Vector3d::Zero();
  scene.floor_slope = std::tan(5.0 * std::numbers::pi / 180.0);
  const FloorEvidence evidence = perceive(scene);
  int floors = 0;
  for (const Surfel& surfel : evidence.surfels) {
    if (!surfel.dominant) continue;
    ++floors;
    EXPECT_TRUE(surfel.traversable);
    EXPECT_NEAR(surfel.normal.x(), -std::sin(5.0 * std::numbers::pi / 180.0), 0.01);
    EXPECT_NEAR(surfel.centroid_m.z(), scene.floor_slope * surfel.centroid_m.x(), 0.005);
  }
  EXPECT_GE(floors, 9);
}

/// A wall hides the farther part of some cells: their heights are those of their middles all the same.
TEST(FloorPerception, ACellOfARampHasTheHeightOfItsMiddleHoweverLittleOfItIsSeen) {
  RenderedScene scene = small_scene();
  scene.T_world_body.translation() = Eigen::Vector3d::Zero();
  scene.floor_slope = std::tan(8.0 * std::numbers::pi / 180.0);
  scene.noise_px = 0.005;
  scene.boxes.push_back({{1.52, -0.3, 0.0}, {1.6, 0.3, 0.7}});
  const FloorEvidence evidence = perceive(scene);
  int cells = 0, in_part = 0;
  for (const CellEvidence& cell : evidence.cells) {
    if (cell.surfel < 0 || !evidence.surfels[static_cast<std::size_t>(cell.surfel)].dominant) continue;
    const double x_m = evidence.lattice.center_of(cell.cell.ix);
    EXPECT_NEAR(cell.mean_z_m, scene.floor_slope * x_m, 0.002) << x_m;
    ++cells;
    in_part += cell.partly_hidden ? 1 : 0;
  }
  EXPECT_GT(cells, 500);
  EXPECT_GT(in_part, 5);
}

TEST(FloorPerception, AHoleThatReturnsNothingIsExpectedFloorWithoutReturn) {
  RenderedScene scene = small_scene();
  const Eigen::Vector3d body = scene.T_world_body.translation();
  scene.missing_share = 0.05;
  scene.hole = Box{{body.x() + 1.5, body.y() - 0.5, 0}, {body.x() + 2.0, body.y() + 0.5, 0}};
  const FloorEvidence evidence = perceive(scene);
  int inside = 0;
  for (const CellEvidence& cell : evidence.cells) {
    const double x = evidence.lattice.center_of(cell.cell.ix) - body.x();
    const double y = evidence.lattice.center_of(cell.cell.iy) - body.y();
    const bool in_hole = x > 1.5 && x < 2.0 && std::abs(y) < 0.5;
    if (cell.no_return) {
      EXPECT_TRUE(in_hole) << x << " " << y;
      EXPECT_EQ(cell.points, 0);
      ++inside;
    }
  }
  EXPECT_GT(inside, 150);  // of 200
}

TEST(FloorPerception, TheShadowBesideAnObstacleIsNotMissingFloor) {
  RenderedScene scene = small_scene();
  add_box(scene, 1.5, 0.0, 0.3, 0.5);
  scene.noise_px = 0.0;
  DepthFrame frame = scene.render();
  const float per_inverse_depth = scene.camera.fx * scene.baseline_m;
  for (int v = 0; v < scene.camera.height;
       ++v)  // the projector does not reach what lies just left of the box
    for (int u = 1; u < scene.camera.width; ++u) {
      const std::size_t i = static_cast<std::size_t>(v * scene.camera.width + u);
      const float here = scene.pixels[i], before = scene.pixels[i - 1];
      if (here == 0.0F || before == 0.0F || here > 0.9F * before) continue;
      const int shadow = static_cast<int>(per_inverse_depth * (1000.0F / here - 1000.0F / before));
      for (int k = 1; k <= std::min(shadow, u); ++k) scene.pixels[i - static_cast<std::size_t>(k)] = 0;
    }
  Serial serial;
  const FloorEvidence evidence =
      FloorPerception({}, {}).process(frame, scene.T_world_body, serial, admit_all);
  ASSERT_GT(evidence.pixels.no_measurement, 300);
  int no_return = 0;
  for (const CellEvidence& cell : evidence.cells) no_return += cell.no_return ? 1 : 0;
  EXPECT_EQ(no_return, 0);
}

TEST(FloorPerception, SightLinesPassBetweenTheSensorAndWhatItSees) {
  RenderedScene scene = small_scene();
  const Eigen::Vector3d body = scene.T_world_body.translation();
  add_box(scene, 3.0, 0.0, 1.0, 0.7);
  const FloorEvidence evidence = perceive(scene);
  const CellEvidence* before = cell_at(evidence, body.x() + 2.2, body.y());
  ASSERT_NE(before, nullptr);
  EXPECT_LT(before->ray_z_m,
            0.1F);  // the ray to the box's foot at 2.5 m is 0.108 m high there, less the margin's
  for (const CellEvidence& cell : evidence.cells) {
    const double x = evidence.lattice.center_of(cell.cell.ix) - body.x();
    const double y = evidence.lattice.center_of(cell.cell.iy) - body.y();
    if (x > 2.6 && x < 3.4 && std::abs(y) < 0.4 && !std::isnan(cell.ray_z_m)) {
      EXPECT_GT(cell.ray_z_m, 0.68F) << "a ray through the box at " << x << " " << y;
    }
  }
}

TEST(FloorPerception, AnyNumberOfWorkersGivesTheSameBits) {
  RenderedScene scene = small_scene();
  scene.missing_share = 0.05;
  add_box(scene, 1.2, 0.4, 0.3, 0.05);
  add_box(scene, 2.2, -0.3, 0.3, 0.40);
  const DepthFrame frame = scene.render();
  const auto perceived = [&](Parallel& parallel) {
    FloorPerception perception({}, {});
    std::pair<FloorEvidence, FloorEvidence> told;
    told.second = perception.process(
        frame, scene.T_world_body, parallel, admit_all, [](PerceptionStage) {},
        [&](const FloorEvidence& evidence) { told.first = evidence; });
    return told;
  };
  Serial serial;
  const auto [near_row, whole] = perceived(serial);
  ASSERT_FALSE(near_row.cells.empty());
  const auto expect_no_difference = [&](Parallel& parallel) {
    const auto told = perceived(parallel);
    expect_same(near_row, told.first);
    expect_same(whole, told.second);
  };
  for (const int workers : {1, 2, 5}) {
    Shuffled shuffled(workers);
    expect_no_difference(shuffled);
    ThreadPool pool(workers);
    expect_no_difference(pool);
  }
}

/// Grants the nearest row, which is not asked for one by one, and so many sections more.
Admission grant(int sections, int& asked) {
  asked = 0;
  return [sections, &asked](std::int64_t work_ns) {
    EXPECT_GT(work_ns, 0);
    return asked++ <= sections;
  };
}

TEST(FloorPerception, NearSectionsComeFirstAndSkippedOnesCarryNoEvidence) {
  RenderedScene scene = small_scene();
  const DepthFrame frame = scene.render();
  Serial serial;
  FloorPerception perception({}, {});
  int asked = 0;
  perception.process(frame, scene.T_world_body, serial, grant(3, asked));
  const FloorEvidence evidence = perception.process(frame, scene.T_world_body, serial, grant(3, asked));
  EXPECT_EQ(asked, 10);
  for (const SectionReport& section : evidence.sections) {
    EXPECT_EQ(section.done, section.ix < 2);
    EXPECT_EQ(section.age, section.ix < 2 ? 0 : 2);
    EXPECT_GT(section.points, 0);
    EXPECT_FALSE(section.later);
  }
  EXPECT_FALSE(evidence.surfels.empty());
  for (const Surfel& surfel : evidence.surfels)
    EXPECT_TRUE(evidence.sections[static_cast<std::size_t>(surfel.section)].done);
  for (const CellEvidence& cell : evidence.cells)
    EXPECT_LT(evidence.lattice.center_of(cell.cell.ix) - scene.T_world_body.translation().x(), 2.45 + 0.1);
}

TEST(FloorPerception, TheNearestRowIsDoneWhateverTheTime) {
  RenderedScene scene = small_scene();
  const DepthFrame frame = scene.render();
  Serial serial;
  FloorPerception perception({}, {});
  const FloorEvidence evidence =
      perception.process(frame, scene.T_world_body, serial, [](std::int64_t) { return false; });
  for (const SectionReport& section : evidence.sections) EXPECT_EQ(section.done, section.ix == 0);
  EXPECT_NE(
      cell_at(evidence, scene.T_world_body.translation().x() + 1.0, scene.T_world_body.translation().y()),
      nullptr);
}

/// With time for three sections of nine beside the nearest row, the far ones have their turn too: each
/// section within kMaxAge frames and a few more; the nearest row in every frame.
TEST(FloorPerception, NoSectionStarvesWhenTimeIsAlwaysShort) {
  RenderedScene scene = small_scene();
  const DepthFrame frame = scene.render();
  Serial serial;
  FloorPerception perception({}, {});
  std::vector<int> done(12, 0);
  int asked = 0;
  for (int i = 0; i < 3 * FloorPerception::kMaxAge; ++i) {
    const FloorEvidence& evidence = perception.process(frame, scene.T_world_body, serial, grant(3, asked));
    for (std::size_t s = 0; s < evidence.sections.size(); ++s) {
      EXPECT_LE(evidence.sections[s].age, FloorPerception::kMaxAge + 3);
      EXPECT_TRUE(evidence.sections[s].done || evidence.sections[s].ix > 0);
      done[s] += evidence.sections[s].done ? 1 : 0;
    }
  }
  EXPECT_GE(*std::min_element(done.begin(), done.end()), 2);
}

TEST(FloorPerception, SectionsOnThePathComeBeforeNearerOnes) {
  RenderedScene scene = small_scene();
  const DepthFrame frame = scene.render();
  Serial serial;
  FloorPerception perception({}, {});
  const Eigen::Vector2d body = scene.T_world_body.translation().head<2>();
  const std::vector<Eigen::Vector2d> path{body + Eigen::Vector2d(0.3, 0.0), body + Eigen::Vector2d(1.5, -1.5),
                                          body + Eigen::Vector2d(4.5, -1.5)};
  perception.set_path(path);
  int asked = 0;
  const FloorEvidence evidence = perception.process(frame, scene.T_world_body, serial, grant(3, asked));
  for (const SectionReport& section : evidence.sections)
    EXPECT_EQ(section.done, section.ix == 0 || section.iy == 0) << section.ix << ", " << section.iy;
}

/// What is told of the nearest row is final, and no cell is told twice.
TEST(FloorPerception, TheNearestRowIsToldFirst) {
  RenderedScene scene = small_scene();
  add_box(scene, 1.0, 0.2, 0.2, 0.1);
  add_box(scene, 1.22, -0.4, 0.3, 0.2);  // across the first border
  const DepthFrame frame = scene.render();
  Serial serial;
  FloorPerception perception({}, {});
  FloorEvidence near_row;
  const FloorEvidence whole = perception.process(
      frame, scene.T_world_body, serial, admit_all, [](PerceptionStage) {},
      [&](const FloorEvidence& evidence) { near_row = evidence; });
  for (const SectionReport& section : near_row.sections) {
    EXPECT_EQ(section.done, section.ix == 0);
    EXPECT_EQ(section.later, section.ix > 0);
  }
  ASSERT_GT(near_row.cells.size(), 100U);
  ASSERT_LT(near_row.cells.size(), whole.cells.size());
  FloorEvidence begin = whole;
  begin.surfels.resize(near_row.surfels.size());
  begin.cells.resize(near_row.cells.size());
  expect_same(begin, near_row);
  for (const CellEvidence& cell : near_row.cells)
    EXPECT_LT(whole.lattice.center_of(cell.cell.ix) - scene.T_world_body.translation().x(), 4.9 / 4);
  std::vector<CellIndex> cells;
  for (const CellEvidence& cell : whole.cells) cells.push_back(cell.cell);
  std::sort(cells.begin(), cells.end());
  EXPECT_EQ(std::adjacent_find(cells.begin(), cells.end()), cells.end());
}

/// Height of a surfel's plane at a place.
double height_at(const Surfel& surfel, double x, double y) {
  const Eigen::Vector3d n = surfel.normal.cast<double>(), c = surfel.centroid_m;
  return c.z() - (n.x() * (x - c.x()) + n.y() * (y - c.y())) / n.z();
}

struct Borders {
  const char* name;
  double slope;
  const char* layout;
};

/// One floor across sections comes out as one floor: on both sides of every border it is equally high.
class SectionBorders : public testing::TestWithParam<Borders> {};

TEST_P(SectionBorders, AreNoSteps) {
  RenderedScene scene = small_scene();
  scene.floor_slope = GetParam().slope;
  scene.T_world_body.translation() = Eigen::Vector3d::Zero();
  PerceptionSettings settings;
  settings.sections.layout = GetParam().layout;
  const FloorEvidence evidence = perceive(scene, settings);
  const SectionGrid grid(settings.roi, settings.sections);
  std::vector<const Surfel*> floors(12, nullptr);
  for (const Surfel& surfel : evidence.surfels)
    if (surfel.dominant) floors[static_cast<std::size_t>(surfel.section)] = &surfel;
  int compared = 0;
  const auto compare = [&](int section, int other, double x, double y) {
    const Surfel* a = floors[static_cast<std::size_t>(section)];
    const Surfel* b = floors[static_cast<std::size_t>(other)];
    if (a == nullptr || b == nullptr) return;
    ++compared;
    EXPECT_NEAR(height_at(*a, x, y), height_at(*b, x, y), 0.0025 * std::max(1.0, x))
        << "at " << x << ", " << y;
    EXPECT_NEAR(height_at(*a, x, y), GetParam().slope * x, 0.0025 * std::max(1.0, x))
        << "at " << x << ", " << y;
  };
  for (int ix = 0; ix < 4; ++ix)
    for (int iy = 0; iy < 3; ++iy) {
      const double x = 0.5 * static_cast<double>(grid.x_axis().border_m(ix) + grid.x_axis().border_m(ix + 1));
      const double y = 0.5 * static_cast<double>(grid.y_axis().border_m(iy) + grid.y_axis().border_m(iy + 1));
      if (ix > 0) compare(3 * (ix - 1) + iy, 3 * ix + iy, static_cast<double>(grid.x_axis().border_m(ix)), y);
      if (iy > 0) compare(3 * ix + iy - 1, 3 * ix + iy, x, static_cast<double>(grid.y_axis().border_m(iy)));
    }
  EXPECT_GE(compared, 14);
}

INSTANTIATE_TEST_SUITE_P(Floors, SectionBorders,
                         testing::Values(Borders{"Flat", 0.0, "uniform"}, Borders{"Uphill", 0.08, "uniform"},
                                         Borders{"Downhill", -0.06, "uniform"},
                                         Borders{"FlatByErrorGrowth", 0.0, "error_growth"},
                                         Borders{"UphillByErrorGrowth", 0.08, "error_growth"}),
                         [](const auto& info) { return info.param.name; });

/// Eq. (5): the sensor's error, which grows with the square of the distance, grows equally much in each
/// section.
TEST(SectionGrid, ByErrorGrowthEachSectionSpansTheSameGrowth) {
  SectionSettings sections;
  sections.layout = "error_growth";
  const SectionGrid grid(RoiSettings{}, sections);
  for (int k = 0; k < 4; ++k) {
    const auto from = static_cast<double>(grid.x_axis().border_m(k)),
               to = static_cast<double>(grid.x_axis().border_m(k + 1));
    EXPECT_NEAR(to * to - from * from, 4.9 * 4.9 / 4, 1e-4);
    EXPECT_EQ(grid.at(static_cast<float>(from + 1e-3), 0.0F), 3 * k + 1);
    EXPECT_EQ(grid.at(static_cast<float>(to - 1e-3), 0.0F), 3 * k + 1);
  }
}

TEST(FloorPerception, RecursionToTheEndPutsEveryPointOnAPlane) {
  RenderedScene scene = small_scene();
  add_box(scene, 1.2, 0.4, 0.3, 0.05);
  add_box(scene, 2.2, -0.3, 0.3, 0.40);
  PerceptionSettings settings;
  settings.planes.max_planes = 2000;
  settings.planes.min_points = 3;
  const FloorEvidence evidence = perceive(scene, settings);
  double on_planes = 0;
  for (const Surfel& surfel : evidence.surfels) on_planes += surfel.points;
  EXPECT_GE(on_planes / static_cast<double>(evidence.pixels.in_roi - evidence.pixels.outliers), 0.98);
}

TEST(FloorPerception, ObstaclePlanesHaveTheirPlaceAndOrientation) {
  RenderedScene scene = small_scene();
  add_box(scene, 1.9, 0.3, 0.6, 0.6);
  const Eigen::Vector3d body = scene.T_world_body.translation();
  const FloorEvidence evidence = perceive(scene);
  int fronts = 0;
  for (const Surfel& surfel : evidence.surfels) {
    if (surfel.traversable || surfel.normal.x() > -0.9F) continue;
    ++fronts;
    EXPECT_NEAR(surfel.centroid_m.x() - body.x(), 1.6, 0.01);
    EXPECT_NEAR(surfel.centroid_m.y() - body.y(), 0.3, 0.3);
    EXPECT_GT(surfel.normal.dot(Eigen::Vector3f(-1, 0, 0)), 0.999F);
    EXPECT_FALSE(surfel.dominant);
  }
  EXPECT_GE(fronts, 1);
}

/// Where a cloud tells how uncertain each pixel is, the floor follows the certain ones.
TEST(FloorPerception, AnUncertaintyPlaneIsHeeded) {
  RenderedScene scene = small_scene();
  const Eigen::Vector3d body = scene.T_world_body.translation();
  DepthFrame frame = scene.render();
  std::vector<std::uint8_t> uncertainty(scene.pixels.size(), 0);
  // Every second block of 16 columns lies 2 cm too low, and says that it may.
  std::vector<std::uint16_t> pixels = scene.pixels;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    if (i % 320 / 16 % 2 == 0 || pixels[i] == 0) continue;
    pixels[i] = static_cast<std::uint16_t>(1.03 * pixels[i]);
    uncertainty[i] = 50;
  }
  frame.pixels = pixels;
  const auto error_at = [&](double x) {
    Serial serial;
    const FloorEvidence evidence =
        FloorPerception({}, {}).process(frame, scene.T_world_body, serial, admit_all);
    double worst = 0;
    for (const Surfel& surfel : evidence.surfels)
      if (surfel.dominant && std::abs(surfel.centroid_m.x() - body.x() - x) < 0.6)
        worst = std::max(worst, std::abs(height_at(surfel, body.x() + x, surfel.centroid_m.y())));
    return worst;
  };
  const double not_told = error_at(1.0);
  frame.uncertainty = uncertainty;
  frame.uncertainty_scale = 0.05F;
  const double told = error_at(1.0);
  EXPECT_LT(told, 0.003);
  EXPECT_LT(told, 0.5 * not_told);
}

TEST(FloorPerception, TheMapDoesNotDependOnHowTheBodyIsTurned) {
  RenderedScene scene = small_scene();
  scene.T_world_body.linear() = Eigen::AngleAxisd(2.1, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const FloorEvidence evidence = perceive(scene);
  const Eigen::Vector3d ahead = scene.T_world_body * Eigen::Vector3d(1.5, 0.0, 0.0);
  const CellEvidence* cell = cell_at(evidence, ahead.x(), ahead.y());
  ASSERT_NE(cell, nullptr);
  EXPECT_GT(cell->points, 0);
  EXPECT_NEAR(cell->mean_z_m, 0.0, 0.003);
}

TEST(FloorPerception, DisparityPixelsGiveTheSameFloorAsDepthPixels) {
  RenderedScene scene = small_scene();
  const DepthFrame depth = scene.render();
  std::vector<std::uint16_t> disparity(depth.pixels.size(), 0);
  const float per_inverse_depth = scene.camera.fx * scene.baseline_m;
  for (std::size_t i = 0; i < disparity.size(); ++i)
    if (depth.pixels[i] != 0)
      disparity[i] = static_cast<std::uint16_t>(
          std::lround(256.0F * per_inverse_depth / (0.001F * static_cast<float>(depth.pixels[i]))));
  DepthFrame frame = depth;
  frame.meaning = PixelMeaning::kDisparity;
  frame.scale = 1.0F / 256.0F;
  frame.pixels = disparity;
  Serial serial;
  const FloorEvidence evidence =
      FloorPerception({}, {}).process(frame, scene.T_world_body, serial, admit_all);
  ASSERT_EQ(evidence.surfels.size(), 12U);
  for (const Surfel& surfel : evidence.surfels) EXPECT_NEAR(surfel.centroid_m.z(), 0.0, 0.003);
}

struct Degenerate {
  const char* name;
  int width, height;
  std::uint16_t fill;
};

class DegenerateFrames : public testing::TestWithParam<Degenerate> {};

TEST_P(DegenerateFrames, GiveNoFloorAndNoCrash) {
  const auto& [name, width, height, fill] = GetParam();
  const std::vector<std::uint16_t> pixels(static_cast<std::size_t>(width * height), fill);
  RenderedScene mounted = small_scene();
  DepthFrame frame;
  frame.camera = {262.5F, 262.5F, static_cast<float>(width) / 2, static_cast<float>(height) / 2,
                  width,  height};
  frame.pixels = pixels;
  frame.T_body_sensor = mounted.T_body_sensor;
  Serial serial;
  FloorPerception perception({}, {});
  for (int repeat = 0; repeat < 2; ++repeat) {
    const FloorEvidence evidence = perception.process(frame, Pose::Identity(), serial, admit_all);
    EXPECT_EQ(evidence.sections.size(), 12U);
    for (const Surfel& surfel : evidence.surfels) EXPECT_FALSE(surfel.dominant);
    const PixelCounts& c = evidence.pixels;
    EXPECT_EQ(c.no_measurement + c.too_near + c.too_uncertain + c.outside_roi + c.in_roi,
              static_cast<std::int64_t>(pixels.size()));
    for (const CellEvidence& cell : evidence.cells) {
      EXPECT_FALSE(std::isinf(cell.ray_z_m));
      EXPECT_TRUE(cell.points == 0 || (std::isfinite(cell.mean_z_m) && std::isfinite(cell.var_z_m2)));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Frames, DegenerateFrames,
    testing::Values(Degenerate{"AllInvalid", 320, 240, 0}, Degenerate{"AllTooNear", 320, 240, 100},
                    Degenerate{"AllTooFar", 320, 240, 65535}, Degenerate{"OneDepth", 320, 240, 1200},
                    Degenerate{"SingleRow", 320, 1, 1000}, Degenerate{"SingleColumn", 1, 240, 1000},
                    Degenerate{"OnePixel", 1, 1, 1000}),
    [](const auto& info) { return info.param.name; });

TEST(FloorPerception, ASensorOnTheFloorOrUpsideDownDoesNotCrash) {
  RenderedScene scene = small_scene();
  const DepthFrame upright = scene.render();
  Serial serial;
  for (const double height : {0.0, -0.5, 0.001}) {
    for (const double pitch : {0.0, 90.0, 180.0, -90.0}) {
      scene.mount(height, pitch);
      DepthFrame frame = upright;
      frame.T_body_sensor = scene.T_body_sensor;
      const FloorEvidence evidence =
          FloorPerception({}, {}).process(frame, Pose::Identity(), serial, admit_all);
      for (const Surfel& surfel : evidence.surfels)
        EXPECT_TRUE(surfel.centroid_m.allFinite() && surfel.normal.allFinite());
    }
  }
}

TEST(FloorPerception, AnEmptyRoiIsRefused) {
  PerceptionSettings settings;
  settings.roi.x_max_m = settings.roi.x_min_m;
  EXPECT_THROW(FloorPerception(settings, {}), std::invalid_argument);
}

}  // namespace
}  // namespace floornav
