// Takes a PATH from its bytes and follows it with the example's controller.
#include <cstdint>
#include <cstdio>
#include <vector>

#include "floornav/goal_t.hpp"
#include "follow_path.hpp"

int main() {
  floornav::path_t sent{};
  sent.status = floornav::path_t::FOLLOWING;
  sent.valid_for_ms = 250;
  for (int i = 0; i <= 10; ++i) {
    floornav::path_point_t point{};
    point.x = 0.1F * static_cast<float>(i);
    point.speed = i < 10 ? 0.5F : 0.0F;
    sent.points.push_back(point);
  }
  sent.n_points = static_cast<std::int32_t>(sent.points.size());
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(sent.getEncodedSize()));
  sent.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  floornav::path_t received;
  if (received.decode(bytes.data(), 0, static_cast<int>(bytes.size())) < 0) return 1;
  FollowPath controller;
  controller.accept(received, 10.0);
  const bool drives = controller.command(0, 0, 0, 10.1).speed_mps == 0.5;
  const bool stops_late = controller.command(0, 0, 0, 10.3).speed_mps == 0;
  std::printf("drives %d, stops without news %d\n", drives, stops_late);
  return drives && stops_late ? 0 : 1;
}
