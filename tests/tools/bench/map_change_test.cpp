#include "tools/bench/map_change.hpp"

#include <gtest/gtest.h>

namespace floornav {
namespace {

TEST(MapChange, PeopleLeaveNoTrailANewBoxIsSeenAtOnceAndAStandingOneStays) {
  Serial serial;
  const MapChange change = measure_map_change({.walks = 2, .width = 320, .seed = 11}, serial);
  EXPECT_LE(change.trail, 0.01);
  EXPECT_LE(change.frames_until_blocked, 3);
  EXPECT_GE(change.frames_until_blocked, 1);
  EXPECT_LE(change.eroded, 0.05);
}

}  // namespace
}  // namespace floornav
