#pragma once

#include <algorithm>
#include <chrono>
#include <thread>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/drivers/process_resources.hpp"

namespace floornav {

/// What a driver that streams holds before and after its reconnects.
struct ReconnectResources {
  ProcessResources before;
  ProcessResources after;
};

/// Waits until frames come from the camera as it is now: what was on its way when it went has passed.
template <class Rig>
bool wait_for_stream(Rig& rig) {
  constexpr auto kPatience = std::chrono::seconds(30);
  constexpr std::size_t kInFlight = 2;
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  while (!rig.status().trouble.empty()) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  rig.bus.forget_clouds();
  return rig.bus.wait_for_clouds(kInFlight + 1, kPatience);
}

/// Unplugs and plugs as fast as frames come again: `settle` times to see the most that the driver holds, then
/// `reconnects` times more. Fails the test where no frames come.
template <class Rig, class Camera>
ReconnectResources resources_over_reconnects(Rig& rig, Camera& camera, int settle, int reconnects) {
  constexpr auto kPatience = std::chrono::seconds(30);
  ReconnectResources found;
  for (int i = 0; i < settle + reconnects; ++i) {
    EXPECT_TRUE(wait_for_stream(rig)) << "after reconnect " << i;
    if (testing::Test::HasFailure()) return found;
    if (i <= settle) found.before = most_of(found.before, ProcessResources::now());
    camera.unplug();
    const auto deadline = std::chrono::steady_clock::now() + kPatience;
    while (rig.status().trouble.empty() && std::chrono::steady_clock::now() < deadline)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    camera.plug();
  }
  EXPECT_TRUE(wait_for_stream(rig));
  found.after = ProcessResources::settled(found.before);
  fmt::print("[ MEASURED ] {} reconnects: resident {} -> {} kB, threads {} -> {}, descriptors {} -> {}\n",
             reconnects, found.before.resident_kb, found.after.resident_kb, found.before.threads,
             found.after.threads, found.before.descriptors, found.after.descriptors);
  return found;
}

/// Threads and descriptors as before, and no more memory than told.
inline void expect_no_leak(const ReconnectResources& found, double allowed_kb) {
  EXPECT_LE(found.after.threads, found.before.threads);
  EXPECT_LE(found.after.descriptors, found.before.descriptors);
  EXPECT_LT(static_cast<double>(found.after.resident_kb - found.before.resident_kb), allowed_kb);
}

}  // namespace floornav
