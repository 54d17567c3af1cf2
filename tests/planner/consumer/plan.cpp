// Plans around a wall on a map of its own, without LCM.
#include <cstdio>

#include "planner/planner.hpp"

int main() {
  using namespace floornav;
  GridMap map(0.1);
  map.version = 1;
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 100; ++x) {
      const CellIndex cell{x, y};
      GridTile& tile = map.make(GridMap::tile_of(cell));
      const auto i = static_cast<std::size_t>(GridTile::index_of(cell));
      const bool wall = x == 50 && y < 40;
      tile.version = 1;
      tile.state[i] = wall ? VertexState::kBlocked : VertexState::kFree;
      tile.belief[i] = wall ? 0 : 255;
      tile.edges[i] = wall ? 0 : 0xFF;
    }
  Planner planner(PlannerSettings{}, RobotSettings{});
  Pose T_world_body = Pose::Identity();
  T_world_body.translation() = Eigen::Vector3d(2, 2, 0);
  const Plan plan = planner.plan(map, T_world_body, Goal{8, 2, 0.1});
  std::printf("status %d, %zu points, %.2f m\n", static_cast<int>(plan.status), plan.points.size(),
              plan.length_m);
  return plan.status == PlanStatus::kFollowing && plan.length_m > 7.0 && plan.length_m < 10.0 ? 0 : 1;
}
