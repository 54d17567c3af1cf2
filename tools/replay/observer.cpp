#include "tools/replay/observer.hpp"

#include <utility>

#include "floornav/pose_t.hpp"
#include "lcmtypes/channels.hpp"

namespace floornav {

Observer::Observer(FrameDone frame_done) : frame_done_(std::move(frame_done)) {
  inbox_.subscribe<pose_t>(channel::kPose, Keep::kAll, [this](const pose_t& m, Micros) { see_pose(m); });
  inbox_.subscribe<surfels_t>(channel::kSurfels, Keep::kAll, [this](const surfels_t& m, Micros) {
    if (const auto frame = frames_.add(m)) frame_done_(*frame);
  });
  inbox_.subscribe<grid_map_t>(channel::kGridMap, Keep::kAll,
                               [this](const grid_map_t& m, Micros) { see_map(m); });
  inbox_.subscribe<terrain_map_t>(channel::kTerrainMap, Keep::kAll,
                                  [this](const terrain_map_t& m, Micros) { terrain_.apply(m); });
  inbox_.subscribe<path_t>(channel::kPath, Keep::kAll, [this](const path_t& m, Micros) { see_path(m); });
}

void Observer::see(const LogEvent& event, Micros now) {
  if (event.channel == channel::kPose) inbox_.deliver(event.channel, event.bytes, now);
}

void Observer::see(const EncodedMessage& message, Micros now) {
  ++published_[message.channel];
  inbox_.deliver(message.channel, message.bytes, now);
}

void Observer::see_map(const grid_map_t& message) {
  if (map_.apply(message).restarted) {
    trajectory_.clear();
    first_mapped_pose_ = std::nullopt;
  }
  if (!first_mapped_pose_) first_mapped_pose_ = map_.header().T_world_body;
}

void Observer::see_path(const path_t& message) {
  if (message.status != path_t::STALE_MAP && message.status != path_t::STALE_POSE) path_ = message;
}

void Observer::see_pose(const pose_t& message) {
  constexpr double kTrajectoryStep_m = 0.02;
  last_pose_ = pose_from_arrays(message.pos, message.orientation);
  const Eigen::Vector2d place = last_pose_->translation().head<2>();
  if (trajectory_.empty() || (place - trajectory_.back()).norm() > kTrajectoryStep_m)
    trajectory_.push_back(place);
}

}  // namespace floornav
