#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "floornav/path_t.hpp"
#include "floornav/pose_t.hpp"
#include "mapping/node/grid_map_message.hpp"
#include "mapping/node/terrain_map_message.hpp"
#include "runtime/process/inbox.hpp"
#include "runtime/process/log_event.hpp"
#include "runtime/process/outbox.hpp"
#include "tools/replay/frame_evidence.hpp"

namespace floornav {

/// Sees what a subscriber of every channel would see, and keeps what the outputs need.
class Observer {
 public:
  using FrameDone = std::function<void(const FrameEvidence& frame)>;

  /// `frame_done` is called with each frame's evidence, before the mapper has it.
  explicit Observer(FrameDone frame_done);

  /// A message of the log.
  void see(const LogEvent& event, Micros now);
  /// A message that a node published.
  void see(const EncodedMessage& message, Micros now);

  [[nodiscard]] const GridMapReceiver& map() const { return map_; }
  [[nodiscard]] const TerrainMap& terrain() const { return terrain_.map(); }
  /// The last one that did not only say that the log had ended (STALE_MAP, STALE_POSE).
  [[nodiscard]] const std::optional<path_t>& path() const { return path_; }
  /// The body's way through the map as it is now, a point every few centimetres.
  [[nodiscard]] const std::vector<Eigen::Vector2d>& trajectory() const { return trajectory_; }
  [[nodiscard]] const std::optional<Pose>& last_pose() const { return last_pose_; }
  /// Where the body was when the mapper began this map.
  [[nodiscard]] const std::optional<Pose>& first_mapped_pose() const { return first_mapped_pose_; }
  [[nodiscard]] const std::map<std::string, std::int64_t>& published() const { return published_; }

 private:
  void see_map(const grid_map_t& message);
  void see_path(const path_t& message);
  void see_pose(const pose_t& message);

  FrameDone frame_done_;
  Inbox inbox_;
  FrameCollector frames_;
  GridMapReceiver map_;
  TerrainMapReceiver terrain_;
  std::optional<path_t> path_;
  std::vector<Eigen::Vector2d> trajectory_;
  std::optional<Pose> last_pose_;
  std::optional<Pose> first_mapped_pose_;
  std::map<std::string, std::int64_t> published_;
};

}  // namespace floornav
