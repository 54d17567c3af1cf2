#include "tools/replay/overview.hpp"

#include <fmt/format.h>

#include "tools/pictures/map_picture.hpp"
#include "tools/pictures/terrain_picture.hpp"

namespace floornav {

namespace {

std::string subtitle_of(const Overview& overview, const MapArea& area) {
  std::string words = fmt::format(
      "{} frames, {:.1f} s; seen {:.1f} m², free {:.1f} m²", overview.totals.frames,
      static_cast<double>(overview.log.last_us - overview.log.first_us) * 1e-6, area.seen_m2(), area.free_m2);
  if (const auto& path = overview.observer.path(); path && overview.request.goal)
    words += fmt::format("; path {:.2f} m, {}", path->length, path_status_name(path->status));
  return words;
}

}  // namespace

void draw_map(const Overview& overview, const MapRaster& map, const std::filesystem::path& file) {
  const Observer& observer = overview.observer;
  const ReplaySettings& settings = overview.request.settings;
  MapPicture picture;
  picture.map = map;
  picture.trajectory = observer.trajectory();
  if (overview.request.goal) {
    picture.goal = overview.request.goal;
    if (observer.path())
      for (const path_point_t& p : observer.path()->points) picture.path.emplace_back(p.x, p.y);
    if (const auto& first = observer.first_mapped_pose())
      picture.assumed_floor = AssumedDisc{first->translation().head<2>(),
                                          settings.robot.radius_m + settings.planner.assumed_radius_m};
  }
  if (const auto& pose = observer.last_pose())
    picture.robot = RobotMark{pose->translation().head<2>(), heading_of(*pose), settings.robot.radius_m};
  picture.title = overview.request.log.filename().string();
  picture.subtitle = subtitle_of(overview, area_of(map));
  write_map_png(picture, file);
}

void draw_terrain(const Overview& overview, const std::filesystem::path& file) {
  TerrainPicture picture;
  picture.terrain = rasterize(overview.observer.terrain());
  picture.trajectory = overview.observer.trajectory();
  picture.title = overview.request.log.filename().string();
  picture.subtitle = fmt::format("terrain of {} frames, cells of {} m", overview.totals.frames,
                                 picture.terrain.cells.resolution_m);
  write_terrain_png(picture, file);
}

}  // namespace floornav
