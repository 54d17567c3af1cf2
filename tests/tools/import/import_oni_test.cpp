#include <gtest/gtest.h>

#include "tests/real_data.hpp"
#include "tests/tools/import/recorded.hpp"
#include "tests/tools/temporary_folder.hpp"
#include "tools/import/import.hpp"

namespace floornav {
namespace {

ImportTarget target(const std::filesystem::path& log) {
  return {log, imported_sensor("kinect"), [](auto, auto) {}};
}

TEST(OniImport, ARealRecordingBecomesClouds) {
  const std::filesystem::path file = real_data("kinect_oni") / "test.oni";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is absent";
  const TemporaryFolder folder;
  const ImportReport report = import_oni({file, std::nullopt, {}}, target(folder / "out.lcm"));
  EXPECT_EQ(report.clouds, 12);
  const auto clouds = recorded_clouds(folder / "out.lcm");
  ASSERT_EQ(clouds.size(), 12U);
  EXPECT_EQ(clouds[0].message.width, 640);
  EXPECT_NEAR(clouds[0].message.fx, 320 / std::tan(1.0145F / 2), 0.5F);
  EXPECT_NE(clouds[0].pixels, clouds[11].pixels);
}

TEST(OniImport, WhatIsNoRecordingIsRefused) {
  const TemporaryFolder folder;
  write_file(folder / "in.oni", "not a recording");
  EXPECT_THROW(import_oni({folder / "in.oni", std::nullopt, {}}, target(folder / "out.lcm")),
               std::runtime_error);
  EXPECT_THROW(import_oni({folder / "nowhere.oni", std::nullopt, {}}, target(folder / "out.lcm")),
               std::runtime_error);
  EXPECT_FALSE(std::filesystem::exists(folder / "out.lcm"));
}

}  // namespace
}  // namespace floornav
