#include "mapping/node/mapper_node.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "lcmtypes/channels.hpp"
#include "mapping/node/terrain_map_message.hpp"
#include "runtime/process/health.hpp"
#include "runtime/process/pose_message.hpp"

namespace floornav {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t kMaxWaiting = 256;  ///< parts of frames
constexpr Micros kLastPartWait = 300ms;   ///< then the last part is taken for lost
constexpr std::int64_t kTicksPerTerrain = 10;
constexpr std::int64_t kTicksUntilStale = 10;

double stopping_distance_m(const RobotSettings& robot) {
  return robot.radius_m + robot.max_speed_mps * robot.max_speed_mps / (2 * robot.max_acceleration_mps2);
}

/// Whether a part can be added to the others: it is of the same frame, and the surfels can still be numbered.
bool belongs(const EvidencePart& part, const EvidenceSource& source, const FloorEvidence& frame) {
  constexpr auto kMostSurfels = static_cast<std::size_t>(std::numeric_limits<std::int16_t>::max());
  const EvidenceSource& other = part.source;
  return other.frame == source.frame && other.cloud_session == source.cloud_session &&
         other.cloud_source == source.cloud_source && part.evidence.utime_us == frame.utime_us &&
         part.evidence.lattice.pitch_m == frame.lattice.pitch_m &&
         frame.surfels.size() + part.evidence.surfels.size() <= kMostSurfels;
}

void append(FloorEvidence& frame, const FloorEvidence& part) {
  const std::size_t before = frame.surfels.size();
  frame.surfels.insert(frame.surfels.end(), part.surfels.begin(), part.surfels.end());
  for (CellEvidence cell : part.cells) {
    if (cell.surfel >= 0)
      cell.surfel = static_cast<std::int16_t>(static_cast<std::size_t>(cell.surfel) + before);
    frame.cells.push_back(cell);
  }
}

}  // namespace

MapperNode::MapperNode(const MappingSettings& settings, const RobotSettings& robot, MapFiles files)
    : world_(settings, robot),
      keeper_(std::move(files)),
      jumps_(robot),
      stopping_distance_m_(stopping_distance_m(robot)) {}

std::vector<std::string> MapperNode::outputs() const {
  return {channel::kGridMap, channel::kTerrainMap};
}

void MapperNode::subscribe(Inbox& inbox) {
  inbox.subscribe<surfels_t>(channel::kSurfels, Keep::kAll,
                             [this](const surfels_t& message, Micros) { accept_part(message); });
  inbox.subscribe<pose_t>(channel::kPose, Keep::kAll,
                          [this](const pose_t& pose, Micros) { accept_pose(pose); });
  inbox.subscribe<rigid_transform_t>(
      channel::kLocalToGlobal, Keep::kLatest,
      [this](const rigid_transform_t& transform, Micros) { keeper_.take(transform); });
  inbox.subscribe<map_request_t>(channel::kMapRequest, Keep::kAll,
                                 [this](const map_request_t& request, Micros) { accept_request(request); });
}

void MapperNode::accept_part(const surfels_t& message) {
  waiting_.push_back(to_evidence(message));
  if (waiting_.size() <= kMaxWaiting) return;
  waiting_.pop_front();
  ++drops_["SURFELS overtaken"];
}

void MapperNode::accept_pose(const pose_t& pose) {
  const Pose T_world_body = body_pose(pose);
  const PoseJumps::Move move = jumps_.take(pose.utime, T_world_body);
  if (move != PoseJumps::Move::kOld) newest_pose_ = T_world_body;
  if (move == PoseJumps::Move::kClockStepped) {
    newest_jump_us_.reset();
    keeper_.clock_stepped();
  }
  if (move != PoseJumps::Move::kJump) return;
  newest_jump_us_ = pose.utime;
  keeper_.jump(pose.utime);
  jumped_ = true;
}

void MapperNode::accept_request(const map_request_t& request) {
  const Eigen::Vector2d center_m(request.center[0], request.center[1]);
  if (!(center_m.cwiseAbs().maxCoeff() <= kMaxPosition_m) || !std::isfinite(request.radius))
    throw std::invalid_argument("map request: absurd place");
  schedule_.request(tiles_within(world_.grid(), center_m, request.radius));
}

void MapperNode::start_epoch_if_jumped(Outbox& out) {
  if (!std::exchange(jumped_, false)) return;
  open_.reset();
  schedule_.clear();
  keeper_.keep_old(world_);
  world_.start_epoch();
  publish_tiles({}, out);
}

/// Where the map says that it was last seen from may be far away: the map was loaded.
Eigen::Vector2d MapperNode::robot_m() const {
  return newest_pose_.value_or(world_.T_world_body()).translation().head<2>();
}

void MapperNode::place_loaded_map(Outbox& out) {
  const std::optional<MapMemory> memory = keeper_.take_loaded();
  if (!memory) return;
  try {
    world_.restore(*memory);
    schedule_.request(tiles_within(world_.grid(), robot_m(), TileSchedule::kRadius_m));
  } catch (const std::invalid_argument& error) {
    trouble_ = std::string("the loaded map does not fit: ") + error.what();
  }
  publish_tiles({}, out);
}

bool MapperNode::step(Micros now, Budget& /*budget*/, Outbox& out) {
  start_epoch_if_jumped(out);
  place_loaded_map(out);
  if (waiting_.empty()) return false;
  const EvidencePart part = std::move(waiting_.front());
  waiting_.pop_front();
  if (newest_jump_us_ && part.evidence.utime_us < *newest_jump_us_) {
    ++drops_["SURFELS from before a pose jump"];
    return !waiting_.empty();
  }
  if (open_ && !belongs(part, open_->source, open_->evidence)) finish_frame(out);
  if (open_) {
    append(open_->evidence, part.evidence);
  } else {
    open_ = OpenFrame{part.source, part.evidence, now};
  }
  if (part.is_last()) finish_frame(out);
  return !waiting_.empty();
}

void MapperNode::finish_frame(Outbox& out) {
  const OpenFrame frame = std::move(*std::exchange(open_, std::nullopt));
  try {
    drops_["SURFELS cells impossible or out of range"] += world_.integrate(frame.evidence).refused;
    trouble_.clear();
    ticks_without_evidence_ = 0;
  } catch (const std::invalid_argument& error) {
    ++drops_["SURFELS of another lattice"];
    trouble_ = error.what();
    return;
  }
  const std::vector<CellIndex> changed = world_.refresh();
  const std::vector<CellIndex> close = tiles_within(world_.grid(), robot_m(), stopping_distance_m_);
  std::vector<CellIndex> tiles;
  std::ranges::set_union(changed, close, std::back_inserter(tiles));
  publish_tiles(tiles, out);
}

void MapperNode::publish_tiles(const std::vector<CellIndex>& tiles, Outbox& out) {
  const GridMapHeader header{world_.utime_us(), world_.max_step_m(), world_.T_world_body()};
  for (grid_map_t& message : to_messages(world_.grid(), tiles, header))
    out.publish(channel::kGridMap, std::move(message));
}

void MapperNode::publish_terrain(Outbox& out) {
  const std::vector<CellIndex> changed = world_.refresh_terrain();
  const std::vector<CellIndex> around = tiles_within(world_.terrain(), robot_m(), TileSchedule::kRadius_m);
  std::vector<CellIndex> tiles;
  std::ranges::set_union(changed, around, std::back_inserter(tiles));
  for (terrain_map_t& message : to_messages(world_.terrain(), tiles, world_.utime_us()))
    out.publish(channel::kTerrainMap, std::move(message));
}

void MapperNode::tick(Micros now, Outbox& out) {
  ++ticks_without_evidence_;
  if (open_ && now - open_->begun > kLastPartWait) finish_frame(out);
  publish_tiles(schedule_.due(world_.grid(), robot_m()), out);
  if (++ticks_ % kTicksPerTerrain == 0) publish_terrain(out);
  keeper_.tick(now, world_);
}

void MapperNode::stop(Micros /*now*/, Outbox& /*out*/) {
  keeper_.stop(world_);
}

void MapperNode::report(health_t& health) const {
  for (const auto& [cause, count] : drops_) add_drop(health, cause, count);
  if (!trouble_.empty()) worsen(health, health_t::DEGRADED, trouble_);
  if (!keeper_.trouble().empty()) worsen(health, health_t::DEGRADED, "map not saved: " + keeper_.trouble());
  if (keeper_.waits_for_place())
    worsen(health, health_t::DEGRADED, "the map of before waits for LOCAL_TO_GLOBAL to know its place");
  if (ticks_without_evidence_ > kTicksUntilStale)
    worsen(health, health_t::DEGRADED, "no SURFELS for a second or more");
}

}  // namespace floornav
