#include "perception/node/surfels_message.hpp"

#include <bit>
#include <functional>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace floornav {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

FloorEvidence sample_evidence(int cells_per_surfel) {
  FloorEvidence e;
  e.utime_us = 1234567890123;
  e.T_world_body.translation() = Eigen::Vector3d(-17.3, 1204.7, 3.25);
  e.T_world_body.linear() =
      Eigen::AngleAxisd(2.0, Eigen::Vector3d(0.1, 0.2, 0.97).normalized()).toRotationMatrix();
  e.T_body_sensor.translation() = Eigen::Vector3d(0.1, 0.0, 0.9);
  for (std::int16_t s = 0; s < 12; ++s)
    e.sections.push_back({static_cast<std::int16_t>(s / 3), static_cast<std::int16_t>(s % 3), s < 9,
                          static_cast<std::int16_t>(s < 9 ? 0 : s), 1000 * s});
  std::mt19937 random(7);
  std::uniform_real_distribution<float> uniform(-1.0F, 1.0F);
  for (std::int16_t k = 0; k < 9; ++k) {
    Surfel surfel;
    surfel.centroid_m = e.T_world_body.translation() + Eigen::Vector3d(k, -k, 0.01 * k);
    surfel.normal = Eigen::Vector3f(0.1F * uniform(random), 0.1F * uniform(random), 1.0F).normalized();
    surfel.radius_m = 0.5F;
    surfel.rms_m = 0.004F;
    surfel.points = 60 + k;
    surfel.section = k;
    surfel.dominant = k % 2 == 0;
    surfel.traversable = k % 3 == 0;
    e.surfels.push_back(surfel);
    for (int c = 0; c < cells_per_surfel; ++c) {
      CellEvidence cell;
      cell.cell = {-400 + k, 24000 + c};
      cell.surfel = k;
      cell.points = 5 + c;
      cell.mean_z_m = 3.25F + 0.1F * uniform(random);
      cell.var_z_m2 = 1e-6F;
      cell.top_z_m = cell.mean_z_m + 0.01F;
      cell.ray_z_m = c % 2 == 0 ? 3.3F : kNan;
      cell.partly_hidden = c % 3 == 0;
      cell.on_edge = c % 5 == 0;
      e.cells.push_back(cell);
    }
  }
  CellEvidence empty;
  empty.cell = {-390, 24090};
  empty.ray_z_m = 3.4F;
  empty.no_return = true;
  e.cells.push_back(empty);
  return e;
}

EvidenceSource sample_source() {
  return {"kinect", 77, 42, 1};
}

/// As it goes over the wire.
surfels_t wired(surfels_t message) {
  message.source = "perception";
  message.session = 5;
  message.seq = 6;
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  EXPECT_EQ(message.encode(bytes.data(), 0, static_cast<int>(bytes.size())), static_cast<int>(bytes.size()));
  surfels_t decoded;
  EXPECT_EQ(decoded.decode(bytes.data(), 0, static_cast<int>(bytes.size())), static_cast<int>(bytes.size()));
  return decoded;
}

void expect_near_or_both_nan(float a, float b) {
  EXPECT_EQ(std::isnan(a), std::isnan(b));
  if (!std::isnan(a)) {
    EXPECT_NEAR(a, b, 1e-6);
  }
}

void expect_same_cell(const CellEvidence& a, const CellEvidence& b) {
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.no_return, b.no_return);
  EXPECT_EQ(a.partly_hidden, b.partly_hidden);
  EXPECT_EQ(a.on_edge, b.on_edge);
  expect_near_or_both_nan(a.mean_z_m, b.mean_z_m);
  expect_near_or_both_nan(a.var_z_m2, b.var_z_m2);
  expect_near_or_both_nan(a.top_z_m, b.top_z_m);
  expect_near_or_both_nan(a.ray_z_m, b.ray_z_m);
}

TEST(SurfelsMessage, EveryCellArrivesOnceWithItsSurfel) {
  for (const int cells_per_surfel : {0, 3, 700, 5000}) {
    const FloorEvidence sent = sample_evidence(cells_per_surfel);
    std::map<CellIndex, const CellEvidence*> expected;
    for (const CellEvidence& cell : sent.cells) expected[cell.cell] = &cell;
    const auto messages = to_messages(sent, sample_source());
    std::size_t cells = 0;
    for (std::size_t p = 0; p < messages.size(); ++p) {
      ASSERT_LE(messages[p].getEncodedSize(), kMaxSurfelsMessage_bytes);
      const EvidencePart part = to_evidence(wired(messages[p]));
      EXPECT_EQ(part.part, static_cast<int>(p));
      EXPECT_EQ(part.parts, static_cast<int>(messages.size()));
      EXPECT_EQ(part.source.cloud_source, "kinect");
      EXPECT_EQ(part.source.cloud_session, 77);
      EXPECT_EQ(part.source.frame, 42);
      const FloorEvidence& got = part.evidence;
      EXPECT_EQ(got.utime_us, sent.utime_us);
      EXPECT_TRUE(got.T_world_body.isApprox(sent.T_world_body, 1e-12));
      EXPECT_TRUE(got.T_body_sensor.isApprox(sent.T_body_sensor, 1e-12));
      EXPECT_EQ(got.lattice.pitch_m, sent.lattice.pitch_m);
      ASSERT_EQ(got.sections.size(), 12U);
      EXPECT_EQ(got.sections[10].age, 10);
      EXPECT_FALSE(got.sections[10].done);
      for (const CellEvidence& cell : got.cells) {
        ++cells;
        ASSERT_TRUE(expected.contains(cell.cell));
        const CellEvidence& original = *expected[cell.cell];
        expect_same_cell(cell, original);
        ASSERT_EQ(cell.surfel < 0, original.surfel < 0);
        if (cell.surfel < 0) continue;
        const Surfel& a = got.surfels[static_cast<std::size_t>(cell.surfel)];
        const Surfel& b = sent.surfels[static_cast<std::size_t>(original.surfel)];
        EXPECT_EQ(a.points, b.points);
        EXPECT_EQ(a.section, b.section);
        EXPECT_EQ(a.dominant, b.dominant);
        EXPECT_EQ(a.traversable, b.traversable);
        EXPECT_TRUE(a.centroid_m.isApprox(b.centroid_m, 1e-7));
        EXPECT_EQ(a.normal, b.normal);
      }
    }
    EXPECT_EQ(cells, sent.cells.size());
  }
}

TEST(SurfelsMessage, ASurfelComesOnceWhereItsCellsFitIntoOnePart) {
  const FloorEvidence sent = sample_evidence(700);
  std::size_t surfels = 0;
  const auto messages = to_messages(sent, sample_source());
  for (const surfels_t& message : messages) surfels += message.surfels.size();
  EXPECT_GT(messages.size(), 2U);
  EXPECT_EQ(surfels, sent.surfels.size());
}

/// A frame that is told in two goes: how many parts there are is known at its end only.
TEST(SurfelsMessage, AFrameCanBeToldAsItBecomesKnown) {
  const FloorEvidence whole = sample_evidence(3);
  FloorEvidence begin = whole;
  begin.surfels.resize(4);
  begin.cells.resize(12);
  for (std::size_t s = 3; s < begin.sections.size(); ++s) {
    begin.sections[s].done = s == 3;
    begin.sections[s].later = s != 3;
  }
  FrameMessages frame(sample_source());
  std::vector<surfels_t> messages = frame.next(begin, false);
  ASSERT_EQ(messages.size(), 1U);
  const EvidencePart first = to_evidence(wired(messages[0]));
  EXPECT_EQ(first.parts, 0);
  EXPECT_FALSE(first.is_last());
  EXPECT_TRUE(first.evidence.sections[4].later);
  FloorEvidence more = whole;
  more.cells.push_back(whole.cells.front());  // of a surfel that was told already
  more.cells.back().cell.ix += 100;
  messages = frame.next(more, true);
  ASSERT_EQ(messages.size(), 1U);
  const EvidencePart last = to_evidence(wired(messages[0]));
  EXPECT_EQ(last.part, 1);
  EXPECT_EQ(last.parts, 2);
  EXPECT_TRUE(last.is_last());
  EXPECT_EQ(last.evidence.cells.size(), whole.cells.size() - 12 + 1);
  EXPECT_EQ(last.evidence.surfels.size(), whole.surfels.size() - 4 + 1);
}

TEST(SurfelsMessage, AnEmptyFrameIsOneMessage) {
  EXPECT_EQ(to_messages(FloorEvidence{}, {}).size(), 1U);
}

struct Corruption {
  const char* name;
  std::function<void(surfels_t&)> damage;
};

class CorruptSurfels : public testing::TestWithParam<Corruption> {};

TEST_P(CorruptSurfels, AreRefused) {
  surfels_t message = to_messages(sample_evidence(3), sample_source()).front();
  EXPECT_NO_THROW(to_evidence(message));
  GetParam().damage(message);
  EXPECT_THROW(to_evidence(wired(message)), std::invalid_argument);
}

constexpr float kInf = std::numeric_limits<float>::infinity();

INSTANTIATE_TEST_SUITE_P(
    Cases, CorruptSurfels,
    testing::Values(Corruption{"PartBeyondParts", [](surfels_t& m) { m.part = m.parts; }},
                    Corruption{"NegativePart", [](surfels_t& m) { m.part = -1; }},
                    Corruption{"PitchZero", [](surfels_t& m) { m.pitch = 0.0; }},
                    Corruption{"PitchNan", [](surfels_t& m) { m.pitch = std::nan(""); }},
                    Corruption{"OriginInfinite",
                               [](surfels_t& m) { m.origin[1] = static_cast<double>(kInf); }},
                    Corruption{"BodyNan", [](surfels_t& m) { m.body_pos[0] = std::nan(""); }},
                    Corruption{"QuaternionZero",
                               [](surfels_t& m) {
                                 std::fill(std::begin(m.body_orientation), std::end(m.body_orientation), 0.0);
                               }},
                    Corruption{"SensorFar", [](surfels_t& m) { m.sensor_pos[2] = 1e12; }},
                    Corruption{"LatticeOverflow",
                               [](surfels_t& m) { m.origin_ix = std::numeric_limits<std::int32_t>::max(); }},
                    Corruption{"LatticeUnderflow",
                               [](surfels_t& m) { m.origin_iy = std::numeric_limits<std::int32_t>::min(); }},
                    Corruption{"SectionState", [](surfels_t& m) { m.sections[2].state = 9; }},
                    Corruption{"SectionNegative", [](surfels_t& m) { m.sections[2].ix = -1; }},
                    Corruption{"SurfelSectionBeyond", [](surfels_t& m) { m.surfels[1].section = 12; }},
                    Corruption{"SurfelSectionNegative", [](surfels_t& m) { m.surfels[1].section = -1; }},
                    Corruption{"SurfelOfSkippedSection", [](surfels_t& m) { m.surfels[1].section = 11; }},
                    Corruption{"CentroidNan", [](surfels_t& m) { m.surfels[1].centroid[0] = kNan; }},
                    Corruption{"NormalZero", [](surfels_t& m) { std::fill_n(m.surfels[1].normal, 3, 0.0F); }},
                    Corruption{"NormalNan", [](surfels_t& m) { m.surfels[1].normal[2] = kNan; }},
                    Corruption{"RadiusNegative", [](surfels_t& m) { m.surfels[1].radius = -1.0F; }},
                    Corruption{"RmsInfinite", [](surfels_t& m) { m.surfels[1].rms = kInf; }},
                    Corruption{"SurfelWithoutPoints", [](surfels_t& m) { m.surfels[1].points = 0; }},
                    Corruption{"SurfelFlags", [](surfels_t& m) { m.surfels[1].flags = 4; }},
                    Corruption{"CellSurfelBeyond", [](surfels_t& m) { m.cells[1].surfel = 9; }},
                    Corruption{"CellSurfelNegative", [](surfels_t& m) { m.cells[1].surfel = -2; }},
                    Corruption{"CellPointsNegative", [](surfels_t& m) { m.cells[1].points = -1; }},
                    Corruption{"CellWithoutPointsOnSurfel", [](surfels_t& m) { m.cells[1].points = 0; }},
                    Corruption{"MeanNan", [](surfels_t& m) { m.cells[1].mean_z = kNan; }},
                    Corruption{"TopInfinite", [](surfels_t& m) { m.cells[1].top_z = kInf; }},
                    Corruption{"VarianceNegative", [](surfels_t& m) { m.cells[1].var_z = -1e-9F; }},
                    Corruption{"RayInfinite", [](surfels_t& m) { m.cells[1].ray_z = -kInf; }},
                    Corruption{"CellFlags", [](surfels_t& m) { m.cells[1].flags = 8; }}),
    [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace floornav
