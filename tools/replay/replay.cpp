#include "tools/replay/replay.hpp"

#include <chrono>
#include <limits>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "floornav/goal_t.hpp"
#include "lcmtypes/channels.hpp"
#include "mapping/node/mapper_node.hpp"
#include "perception/node/perception_node.hpp"
#include "planner/node/planner_node.hpp"
#include "runtime/process/identity.hpp"
#include "runtime/process/log_reader.hpp"
#include "runtime/process/log_writer.hpp"
#include "runtime/process/replay_executor.hpp"
#include "runtime/process/thread_pool.hpp"
#include "tools/replay/frame_pictures.hpp"
#include "tools/replay/frame_tables.hpp"
#include "tools/replay/log_contents.hpp"
#include "tools/replay/map_files.hpp"
#include "tools/replay/observer.hpp"
#include "tools/replay/overview.hpp"
#include "tools/replay/path_table.hpp"
#include "tools/replay/summary.hpp"

namespace floornav {

namespace {

namespace fs = std::filesystem;

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!fs::is_directory(folder))
    throw std::runtime_error(fmt::format("{}: cannot be made: {}", folder.string(),
                                         error ? error.message() : "a file has this name"));
}

/// result.lcm in the making; it gets its name when the replay is done.
class ResultLog {
 public:
  explicit ResultLog(const fs::path& folder) : file_(folder / "result.lcm"), log_(unfinished()) {}
  ~ResultLog() {
    std::error_code ignored;
    fs::remove(unfinished(), ignored);
  }
  ResultLog(const ResultLog&) = delete;
  ResultLog& operator=(const ResultLog&) = delete;

  void write(const EncodedMessage& message, Micros now) {
    if (message.channel != channel::kHealth) log_.write(now.count(), message.channel, message.bytes);
  }
  void finish() {
    log_.close();
    fs::rename(unfinished(), file_);
  }

 private:
  [[nodiscard]] fs::path unfinished() const { return file_.string() + ".part"; }
  fs::path file_;
  LogWriter log_;
};

EncodedMessage goal_message(const Eigen::Vector2d& place, std::int64_t utime_us) {
  constexpr float kTolerance_m = 0.3F;
  goal_t goal{};
  goal.utime = utime_us;
  goal.id = 1;
  goal.command = goal_t::GO;
  goal.pos[0] = place.x();
  goal.pos[1] = place.y();
  goal.tolerance = kTolerance_m;
  Outbox out(fixed_identity("replay"));
  out.publish(channel::kGoal, goal);
  return out.take().front();
}

ReplayOptions executor_options(const ReplayRequest& request) {
  ReplayOptions options;
  constexpr double kNanosecondsPerMillisecond = 1e6;
  if (request.deadline_ms)
    options.work_budget_ns = static_cast<std::int64_t>(*request.deadline_ms * kNanosecondsPerMillisecond);
  return options;
}

/// One replay from the first event to the last output.
class Replay {
 public:
  Replay(const ReplayRequest& request, const LogContents& contents)
      : request_(request),
        contents_(contents),
        pool_(request.threads),
        perception_(request.settings.perception, request.settings.robot, pool_),
        mapper_(request.settings.mapping, request.settings.robot),
        planner_(request.settings.planner, request.settings.robot),
        nodes_{&perception_, &mapper_, &planner_},
        result_(request.out),
        surfels_(request.out / "surfels.csv"),
        frames_(request.out / "frames.csv"),
        observer_([this](const FrameEvidence& frame) { count(frame); }),
        executor_(
            nodes_, [this](const EncodedMessage& message, Micros now) { publish(message, now); },
            executor_options(request)) {
    if (request.frame_pictures)
      pictures_.emplace(request.out / "frames", request.settings.perception.roi.z_max_m,
                        request.settings.robot.radius_m);
  }

  bool run(const ReplayStep& step) {
    const auto start = std::chrono::steady_clock::now();
    if (request_.goal) executor_.inject(goal_message(*request_.goal, contents_.first_us));
    const bool whole = deliver_all(step);
    executor_.finish();
    draw_frames();
    write_outputs(!whole, std::chrono::steady_clock::now() - start);
    return whole;
  }

 private:
  bool deliver_all(const ReplayStep& step) {
    LogReader reader(request_.log);
    LogEvent event;
    std::int64_t clouds = 0;
    while (reader.next(event)) {
      if (!step(clouds, contents_.clouds)) return false;
      observer_.see(event, executor_.now());
      if (pictures_) pictures_->see(event);
      executor_.deliver(event);
      draw_frames();
      if (event.channel == channel::kKinectCloud || event.channel == channel::kBumblebeeCloud) ++clouds;
    }
    return true;
  }

  void publish(const EncodedMessage& message, Micros now) {
    result_.write(message, now);
    observer_.see(message, now);
  }

  void count(const FrameEvidence& frame) {
    const FloorEvidence& evidence = frame.evidence;
    ++totals_.frames;
    totals_.surfels += static_cast<std::int64_t>(evidence.surfels.size());
    for (const SectionReport& section : evidence.sections) {
      totals_.points += section.points;
      ++(section.done ? totals_.sections_processed : totals_.sections_skipped);
    }
    const FrameFloor floor = floor_of(evidence.surfels, evidence.T_world_body * evidence.T_body_sensor);
    if (floor.points > 0) ++totals_.frames_with_floor;
    surfels_.add(frame);
    frames_.add(frame, floor);
    if (pictures_) undrawn_.emplace_back(frame, floor);
  }

  /// The frames whose evidence has come; the map has it by now.
  void draw_frames() {
    for (const auto& [frame, floor] : undrawn_) pictures_->draw(frame, floor, observer_.map().map());
    undrawn_.clear();
  }

  void write_outputs(bool interrupted, std::chrono::nanoseconds took) {
    surfels_.close();
    frames_.close();
    const MapRaster map = rasterize(observer_.map().map());
    write_map_files(map, request_.out);
    const Overview overview{request_, contents_, observer_, totals_};
    draw_map(overview, map, request_.out / "map.png");
    draw_terrain(overview, request_.out / "terrain.png");
    if (request_.goal) write_path_table(observer_.path(), request_.out / "path.csv");
    write_summary({request_, contents_, executor_, nodes_, observer_, totals_, map, interrupted, took},
                  request_.out / "summary.json");
    result_.finish();
  }

  const ReplayRequest& request_;
  const LogContents& contents_;
  ThreadPool pool_;
  PerceptionNode perception_;
  MapperNode mapper_;
  PlannerNode planner_;
  std::vector<Node*> nodes_;
  ResultLog result_;
  SurfelTable surfels_;
  FrameTable frames_;
  FrameTotals totals_;
  std::optional<FramePictures> pictures_;
  std::vector<std::pair<FrameEvidence, FrameFloor>> undrawn_;
  Observer observer_;
  ReplayExecutor executor_;
};

}  // namespace

bool replay(const ReplayRequest& request, const ReplayStep& step) {
  const LogContents contents = contents_of(request.log);
  require_replayable(contents, request.log, request.salvage);
  make_folder(request.out);
  return Replay(request, contents).run(step);
}

}  // namespace floornav
