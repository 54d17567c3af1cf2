#include "tools/bench/slow_drive.hpp"

#include <cstddef>
#include <vector>

#include "tools/bench/table1.hpp"
#include "tools/simulator/raycaster.hpp"
#include "tools/simulator/vehicle.hpp"

namespace floornav {

DriveObserver::DriveObserver(SensorKind kind, bool correlated, std::uint64_t key,
                             const MappingSettings& mapping)
    : mapping_(mapping), sensor_(bench_sensor(kind, correlated), key), driven_(new_stack()) {}

std::unique_ptr<FrameStack> DriveObserver::new_stack() const {
  return std::make_unique<FrameStack>(perception_for(sensor_.model().kind, SectionSettings{}), mapping_,
                                      RobotSettings{});
}

void DriveObserver::see(std::span<const float> depth, int frame, const Pose& T_world_body) {
  const auto pixels = sensor_.measure(depth, frame);
  driven_->see(sensor_, pixels, T_world_body);
  if (frame + 1 < kFrames) return;
  single_ = new_stack();
  single_->see(sensor_, pixels, T_world_body);
}

std::array<DriveObserver, 2> drive_up_to(const Shapes& shapes, const Pose& T_world_body, SensorKind kind,
                                         std::uint64_t key, const MappingSettings& mapping) {
  std::array<DriveObserver, 2> observers{DriveObserver(kind, false, key, mapping),
                                         DriveObserver(kind, true, key, mapping)};
  const SensorSpec& spec = observers[0].sensor();
  const Eigen::Vector2d ahead = T_world_body.linear().col(0).head<2>().normalized();
  const Eigen::Vector2d end = T_world_body.translation().head<2>();
  std::vector<float> depth(static_cast<std::size_t>(spec.camera.width) *
                           static_cast<std::size_t>(spec.camera.height));
  for (int frame = 0; frame < DriveObserver::kFrames; ++frame) {
    const double left_m = (DriveObserver::kFrames - 1 - frame) * DriveObserver::kMovePerFrame_m;
    const Pose here = body_on_floor(shapes, {end - left_m * ahead, ahead});
    cast_depth(shapes, spec.camera, here * spec.T_body_sensor, depth);
    for (DriveObserver& observer : observers) observer.see(depth, frame, here);
  }
  return observers;
}

}  // namespace floornav
