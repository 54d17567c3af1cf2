#include "tests/devices/kinect/room_scene.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "tests/devices/kinect/scene_writer.hpp"

namespace floornav {

double RoomScene::depth_at(int column, int row) const {
  const double down = (row - double{camera.cy}) / double{camera.fy};  // of the ray at depth 1
  const double ahead = column < post_end ? post_m : wall_m;
  return down > 0 ? std::min(ahead, height_m / down) : ahead;
}

void write_room_scene(const RoomScene& room, const std::filesystem::path& file) {
  constexpr int kCountUm = 100;
  SceneHeader header;
  header.width = room.camera.width;
  header.height = room.camera.height;
  header.count_um = kCountUm;
  header.horizontal_fov_rad = 2 * std::atan(static_cast<float>(header.width) / (2 * room.camera.fx));
  header.vertical_fov_rad = 2 * std::atan(static_cast<float>(header.height) / (2 * room.camera.fy));

  std::vector<std::uint16_t> still;
  for (int row = 0; row < header.height; ++row)
    for (int column = 0; column < header.width; ++column)
      still.push_back(static_cast<std::uint16_t>(std::lround(room.depth_at(column, row) * 1e6 / kCountUm)));
  SceneWriter writer(file, header);
  std::minstd_rand random;
  for (int frame = 0; frame < room.frames; ++frame) {
    std::vector<std::uint16_t> seen = still;
    for (std::size_t i = 0; i < seen.size(); i += 16)
      seen[i] = static_cast<std::uint16_t>(seen[i] + random() % 21);
    writer.add(seen);
  }
  writer.close(room.period_us);
}

}  // namespace floornav
