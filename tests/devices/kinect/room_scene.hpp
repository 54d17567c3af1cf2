#pragma once

#include <cstdint>
#include <filesystem>

#include "runtime/geometry/pinhole.hpp"

namespace floornav {

/// A scene whose depths have a closed form: level floor, a wall across, and nothing else, seen by a level
/// camera that does not move. A post on the left of the wall tells left from right.
struct RoomScene {
  Pinhole camera{575.8F, 575.8F, 319.5F, 239.5F, 640, 480};
  double height_m = 0.72;  ///< of the camera
  double wall_m = 4.0;     ///< depth of the wall
  double post_m = 3.0;     ///< depth of the post, which fills the columns before `post_end`
  int post_end = 100;      ///< px
  int frames = 30;
  int period_us = 33'333;

  /// Depth Z of a pixel's ray, m.
  [[nodiscard]] double depth_at(int column, int row) const;
};

/// Each frame differs from the one before: every 16th pixel is up to 2 mm too deep.
void write_room_scene(const RoomScene& room, const std::filesystem::path& file);

}  // namespace floornav
