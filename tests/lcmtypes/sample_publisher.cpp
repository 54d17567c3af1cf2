// Says something on every channel of the project, so that others can be tried against it.

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>
#include <thread>

#include <lcm/lcm.h>

#include "lcmtypes/channels.hpp"
#include "sample_messages.hpp"

int main(int argc, char** argv) {
  using namespace floornav;
  if (argc != 3) {
    std::fputs(
        "usage: sample_publisher LCM_URL ROUNDS\nPublishes ROUNDS messages on each channel, ten a second.\n",
        stderr);
    return 1;
  }
  lcm_t* lcm = lcm_create(argv[1]);
  if (lcm == nullptr) {
    std::fprintf(stderr, "sample_publisher: cannot open %s\n", argv[1]);
    return 1;
  }
  const std::map<std::string, std::vector<const char*>> channels{
      {"depth_cloud_t", {channel::kKinectCloud, channel::kBumblebeeCloud}},
      {"pose_t", {channel::kPose}},
      {"rigid_transform_t", {channel::kLocalToGlobal}},
      {"surfels_t", {channel::kSurfels}},
      {"grid_map_t", {channel::kGridMap}},
      {"terrain_map_t", {channel::kTerrainMap}},
      {"map_request_t", {channel::kMapRequest}},
      {"goal_t", {channel::kGoal}},
      {"path_t", {channel::kPath}},
      {"health_t", {channel::kHealth}}};
  const auto types = every_message_type();
  int failed = 0;
  for (int round = 0; round < std::atoi(argv[2]); ++round) {
    if (round > 0) std::this_thread::sleep_for(std::chrono::milliseconds(100));
    for (const auto& type : types) {
      const auto found = channels.find(type->name());
      if (found == channels.end()) continue;  // a part of another message
      const auto bytes = type->sample(static_cast<std::uint32_t>(round));
      for (const char* name : found->second)
        failed += lcm_publish(lcm, name, bytes.data(), static_cast<unsigned>(bytes.size())) != 0;
    }
  }
  lcm_destroy(lcm);
  return failed == 0 ? 0 : 1;
}
