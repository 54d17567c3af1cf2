#include "tools/replay/frame_evidence.hpp"

#include <gtest/gtest.h>

#include "perception/node/surfels_message.hpp"

namespace floornav {
namespace {

/// More cells on one surfel than fit into one message, and a second surfel.
FloorEvidence large_evidence() {
  FloorEvidence evidence;
  evidence.utime_us = 77;
  evidence.sections.push_back({0, 0, true, 0, 9000});
  for (int i = 0; i < 2; ++i) {
    Surfel surfel;
    surfel.centroid_m = Eigen::Vector3d(1 + i, 0, 0);
    surfel.normal = Eigen::Vector3f::UnitZ();
    surfel.points = 4000 + i;
    evidence.surfels.push_back(surfel);
  }
  for (int i = 0; i < 6000; ++i) {
    CellEvidence cell;
    cell.cell = {i % 100, i / 100};
    cell.surfel = i < 5000 ? 0 : 1;
    cell.points = 1;
    cell.mean_z_m = cell.top_z_m = 0;
    cell.var_z_m2 = 1e-6F;
    evidence.cells.push_back(cell);
  }
  return evidence;
}

TEST(FrameCollector, PutsTheSurfelsOfAFrameInManyPartsTogetherOnce) {
  const FloorEvidence sent = large_evidence();
  const auto messages = to_messages(sent, {"kinect", 5, 42, 1});
  ASSERT_GT(messages.size(), 3U);
  FrameCollector collector;
  for (int round = 0; round < 2; ++round)
    for (std::size_t i = 0; i < messages.size(); ++i) {
      const auto frame = collector.add(messages[i]);
      ASSERT_EQ(frame.has_value(), i + 1 == messages.size());
      if (!frame) continue;
      EXPECT_EQ(frame->frame, 42);
      EXPECT_EQ(frame->evidence.utime_us, 77);
      ASSERT_EQ(frame->evidence.surfels.size(), 2U);
      EXPECT_EQ(frame->evidence.surfels[1].points, 4001);
      EXPECT_EQ(frame->evidence.cells.size(), sent.cells.size());
      EXPECT_EQ(frame->evidence.sections.size(), 1U);
    }
}

}  // namespace
}  // namespace floornav
