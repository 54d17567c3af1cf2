#include "mapping/node/map_file.hpp"

#include <csignal>
#include <fstream>
#include <random>
#include <stdexcept>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "mapping/node/map_keeper.hpp"
#include "tests/mapping/made_evidence.hpp"
#include "tests/tools/temporary_folder.hpp"

namespace floornav {
namespace {

WorldMap floor_of(double length_m) {
  WorldMap map(MappingSettings{}, RobotSettings{});
  map.integrate(see(flat(), {0, length_m, -1, 1}));
  map.refresh();
  return map;
}

TEST(MapFile, ComesBackAsItWasSaved) {
  const TemporaryFolder folder;
  const MapMemory memory = floor_of(3).memory();
  save_map(memory, folder / "map");
  EXPECT_EQ(to_bytes(load_map(folder / "map")), to_bytes(memory));
}

TEST(MapFile, WhatIsNoMapIsOneClearLine) {
  const TemporaryFolder folder;
  std::ofstream(folder / "text") << "no map at all, but longer than a header is";
  for (const char* name : {"text", "missing", "."}) {
    try {
      (void)load_map(folder / name);
      ADD_FAILURE() << name;
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find((folder / name).string()), std::string::npos);
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
  }
  EXPECT_THROW(save_map(floor_of(1).memory(), folder / "no" / "such" / "folder"), std::runtime_error);
}

TEST(MapFile, KilledAtAnyMomentItIsTheOldMapOrTheNewOne) {
  const TemporaryFolder folder;
  const auto file = folder / "map";
  const MapMemory small = floor_of(2).memory();
  const MapMemory large = floor_of(7).memory();
  save_map(small, file);
  std::mt19937 random(1);
  bool seen_small = false;
  bool seen_large = false;
  for (int round = 0; round < 60; ++round) {
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      for (;;) {
        save_map(large, file);
        save_map(small, file);
      }
    }
    usleep(static_cast<useconds_t>(500 + random() % 20'000));
    ASSERT_EQ(kill(child, SIGKILL), 0);
    ASSERT_EQ(waitpid(child, nullptr, 0), child);
    const std::vector<std::uint8_t> found = to_bytes(load_map(file));
    const bool is_small = found == to_bytes(small);
    ASSERT_TRUE(is_small || found == to_bytes(large));
    (is_small ? seen_small : seen_large) = true;
  }
  EXPECT_TRUE(seen_small || seen_large);
}

class KeptMap : public testing::Test {
 protected:
  static rigid_transform_t local_to_global(double x_m) {
    rigid_transform_t message{};
    message.trans[0] = x_m;
    message.quat[0] = 1;
    return message;
  }
  TemporaryFolder folder_;
  WorldMap world_ = floor_of(3);
};

TEST_F(KeptMap, MayBeMissingAtTheFirstRunOnly) {
  EXPECT_NO_THROW(MapKeeper({.load = folder_ / "map", .save = folder_ / "map"}));
  EXPECT_THROW(MapKeeper({.load = folder_ / "map", .save = {}}), std::runtime_error);
}

TEST_F(KeptMap, ComesBackWhereItWasWithoutAGlobalFrame) {
  MapKeeper({.load = {}, .save = folder_ / "map"}).stop(world_);
  MapKeeper again({.load = folder_ / "map", .save = {}});
  const auto loaded = again.take_loaded();
  ASSERT_TRUE(loaded);
  EXPECT_EQ(to_bytes(*loaded), to_bytes(world_.memory()));
  EXPECT_FALSE(again.take_loaded());
}

TEST_F(KeptMap, WaitsForLocalToGlobalAndLiesWhereThatPutsIt) {
  MapKeeper first({.load = {}, .save = folder_ / "map"});
  first.take(local_to_global(10));
  first.stop(world_);
  MapKeeper second({.load = folder_ / "map", .save = folder_ / "map"});
  EXPECT_TRUE(second.waits_for_place());
  EXPECT_FALSE(second.take_loaded());
  second.stop(world_);  // must not overwrite the map that was never placed
  second.take(local_to_global(6));
  const auto loaded = second.take_loaded();
  ASSERT_TRUE(loaded);
  WorldMap placed(MappingSettings{}, RobotSettings{});
  placed.restore(*loaded);
  EXPECT_EQ(placed.grid().state(placed.grid().lattice().cell_of(4.02, 0)), VertexState::kFree);
  EXPECT_EQ(placed.grid().state(placed.grid().lattice().cell_of(3.9, 0)), VertexState::kUnknown);
  EXPECT_EQ(placed.grid().state(placed.grid().lattice().cell_of(7.1, 0)), VertexState::kUnknown);
}

TEST_F(KeptMap, OfBeforeAJumpIsSavedBesideWhereNobodyKnowsItsPlace) {
  {
    MapKeeper keeper({.load = {}, .save = folder_ / "map"});
    keeper.jump(1'000'000);
    keeper.keep_old(world_);
    EXPECT_FALSE(keeper.take_loaded());
  }
  EXPECT_EQ(to_bytes(load_map(folder_ / "map.before-jump")), to_bytes(world_.memory()));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "map"));
}

TEST_F(KeptMap, ThatCannotBeSavedSaysWhy) {
  MapKeeper keeper({.load = {}, .save = folder_ / "no" / "map", .save_every_s = 1});
  EXPECT_THROW(keeper.stop(world_), std::runtime_error);
  for (int i = 0; i < 1000 && keeper.trouble().empty(); ++i) {
    keeper.tick(std::chrono::seconds(2 * i), world_);
    usleep(1000);
  }
  EXPECT_NE(keeper.trouble().find("map"), std::string::npos);
}

TEST_F(KeptMap, AGlobalFrameThatCannotBeIsRefused) {
  MapKeeper keeper({.load = {}, .save = folder_ / "map"});
  rigid_transform_t broken = local_to_global(std::nan(""));
  EXPECT_THROW(keeper.take(broken), std::invalid_argument);
  broken = {};
  EXPECT_THROW(keeper.take(broken), std::invalid_argument);
}

}  // namespace
}  // namespace floornav
