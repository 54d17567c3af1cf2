#include "mapping/cell_store.hpp"

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "mapping/grid_map.hpp"

namespace floornav {
namespace {

constexpr std::size_t kCells = 1024;
constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();

Level random_level(std::mt19937& random, float around_m) {
  std::uniform_real_distribution<float> part(-1, 1);
  Level level;
  level.column = random() % 3 == 0;
  level.z_m = around_m + 7 * part(random);
  level.var_m2 = std::pow(10.0F, -4 + 4 * part(random));
  level.gradient_x = (level.column ? 60.0F : 0.99F) * part(random);
  level.gradient_y = (level.column ? 60.0F : 0.99F) * part(random);
  level.support = static_cast<std::uint8_t>(1 + random() % Level::kMost);
  const int reach = static_cast<int>(random() % (2 * Surface::kCorner + 1)) - Surface::kCorner;
  level.reach = static_cast<std::int8_t>(level.column ? 0 : reach);
  return level;
}

CellMemory random_cell(std::mt19937& random, float around_m) {
  const Level lower = random() % 4 == 0 ? Level{} : random_level(random, around_m);
  const Level upper = random() % 3 == 0 && lower.exists() ? random_level(random, around_m) : Level{};
  const float overhead_m = random() % 5 == 0 ? 300.25F : kNothing;
  const auto floor_doubt = static_cast<std::int32_t>(random() % 32);
  return {lower, upper, overhead_m, floor_doubt};
}

void expect_near(const Level& stored, const Level& level) {
  ASSERT_EQ(stored.support, level.support);
  if (!level.exists()) return;
  ASSERT_EQ(stored.column, level.column);
  ASSERT_NEAR(stored.z_m, level.z_m, 20e-6);
  ASSERT_NEAR(stored.gradient_x, level.gradient_x, level.column ? 1.01 / 32 : 1.01 / 2048);
  ASSERT_NEAR(stored.gradient_y, level.gradient_y, level.column ? 1.01 / 32 : 1.01 / 2048);
  ASSERT_NEAR(stored.var_m2 / level.var_m2, 1, 0.032);
  ASSERT_EQ(stored.reach, level.reach);
}

void expect_near(const CellMemory& stored, const CellMemory& memory) {
  expect_near(stored.lower(), memory.lower());
  expect_near(stored.upper(), memory.upper());
  ASSERT_EQ(stored.floor_doubt(), memory.floor_doubt());
  ASSERT_EQ(std::isnan(stored.overhead_z_m()), std::isnan(memory.overhead_z_m()));
  if (!std::isnan(memory.overhead_z_m())) {
    ASSERT_EQ(stored.overhead_z_m(), memory.overhead_z_m());
  }
}

class CellStores : public testing::TestWithParam<unsigned> {};
INSTANTIATE_TEST_SUITE_P(Seeds, CellStores, testing::Range(1U, 6U));

TEST_P(CellStores, HoldWhatWasSetLastInAnyOrder) {
  std::mt19937 random(GetParam());
  const float around_m = static_cast<float>(random() % 100) - 50.3F;
  CellStore store(kCells, static_cast<double>(around_m));
  std::vector<CellMemory> expected(kCells);
  for (int i = 0; i < 20'000; ++i) {
    const std::size_t slot = random() % kCells;
    expected[slot] = random() % 4 == 0 ? CellMemory{} : random_cell(random, around_m);
    store.set(slot, expected[slot]);
  }
  for (std::size_t slot = 0; slot < kCells; ++slot) {
    expect_near(store.at(slot), expected[slot]);
    const CellMemory& cell = expected[slot];
    const bool more = cell.upper().exists() || !std::isnan(cell.overhead_z_m());
    ASSERT_EQ(store.has_more(slot), more);
    ASSERT_EQ(store.is_empty(slot), !more && !cell.lower().exists() && cell.floor_doubt() == 0);
  }
}

TEST_P(CellStores, MadeOfWhatAnotherHeldHoldTheSameHeightsToTheBit) {
  std::mt19937 random(GetParam());
  CellStore store(kCells, 2.0);
  for (std::size_t slot = 0; slot < kCells; ++slot) store.set(slot, random_cell(random, 2.0F));
  std::vector<CellMemory> held;
  for (std::size_t slot = 0; slot < kCells; ++slot) held.push_back(store.at(slot));
  const CellStore other(held);
  for (std::size_t slot = 0; slot < kCells; ++slot) {
    ASSERT_EQ(other.at(slot).lower().z_m, held[slot].lower().z_m);
    ASSERT_EQ(other.at(slot).upper().z_m, held[slot].upper().z_m);
    ASSERT_EQ(other.at(slot).lower().var_m2, held[slot].lower().var_m2);
    ASSERT_EQ(other.at(slot).lower().gradient_x, held[slot].lower().gradient_x);
  }
}

TEST(CellStore, HeightsOutOfReachStayOnTheirSideAndSpoilNoOther) {
  CellStore store(kCells, 1.0);
  Level floor;
  floor.support = Level::kMost;
  floor.var_m2 = 1e-6F;
  const auto at_height = [&](float z_m) {
    Level level = floor;
    level.z_m = z_m;
    return level;
  };
  store.set(0, {at_height(1.25F), at_height(400.0F), kNothing, 0});
  store.set(1, {at_height(-400.0F), {}, kNothing, 0});
  store.set(2, {at_height(std::numeric_limits<float>::max()), {}, kNothing, 7});
  EXPECT_EQ(store.at(0).lower().z_m, 1.25F);
  EXPECT_NEAR(store.at(0).upper().z_m, 1 + CellStore::kReach_m, 0.02);
  EXPECT_NEAR(store.at(1).lower().z_m, 1 - CellStore::kReach_m, 0.02);
  EXPECT_NEAR(store.at(2).lower().z_m, 1 + CellStore::kReach_m, 0.02);
  EXPECT_EQ(store.at(2).floor_doubt(), 7);
  EXPECT_EQ(store.at(2).lower().support, Level::kMost);
}

TEST(CellStore, FarViewsStillMoveAHeight) {
  constexpr float kFarVar_m2 = 0.01F * 0.01F;
  const FusionLimits limits;
  CellStore store(kCells, 0);
  const auto see = [&](float z_m, float var_m2) {
    CellMemory memory = store.at(0);
    Sighting sighting;
    sighting.z_m = z_m;
    sighting.var_m2 = var_m2;
    sighting.points = Level::kPerFrame;
    memory.fuse({.sightings = {&sighting, 1}}, limits);
    store.set(0, memory);
  };
  for (int i = 0; i < 100; ++i) see(0, 1e-6F);
  for (int i = 0; i < 2000; ++i) see(0.005F, kFarVar_m2);
  EXPECT_NEAR(store.at(0).lower().z_m, 0.005, 0.001);
}

TEST(CellStore, TakesEightBytesACellOfPlainFloorAndNoneWhereNothingWasSeen) {
  CellStore store(kCells, 0);
  EXPECT_LT(store.memory_bytes(), 100U);
  for (std::size_t slot = 0; slot < kCells; ++slot) store.set(slot, {});
  EXPECT_LT(store.memory_bytes(), 100U);
  std::mt19937 random(1);
  for (std::size_t slot = 0; slot < kCells; ++slot)
    store.set(slot, {random_level(random, 0), {}, kNothing, 0});
  EXPECT_LT(store.memory_bytes(), 8 * kCells + 100);
}

}  // namespace
}  // namespace floornav
