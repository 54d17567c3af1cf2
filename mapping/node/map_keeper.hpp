#pragma once

#include <cstdint>
#include <filesystem>
#include <future>
#include <limits>
#include <optional>
#include <string>

#include "floornav/rigid_transform_t.hpp"
#include "mapping/map_memory.hpp"
#include "mapping/world_map.hpp"
#include "runtime/process/time.hpp"

namespace floornav {

/// Where a map comes from at the start and is kept; empty paths: nowhere.
struct MapFiles {
  std::filesystem::path load;  ///< may be missing only if it is `save` too: the first run
  std::filesystem::path save;
  double save_every_s = 60;  ///< and when the process ends
};

/// Loads a map at the start and saves it now and then. A map that was saved with LOCAL_TO_GLOBAL lies where
/// that puts it in the local frame of today, and waits until LOCAL_TO_GLOBAL is known; another one lies where
/// it was. After a jump of the pose the map of before waits in the same way: what was seen since is given up
/// for it. Without LOCAL_TO_GLOBAL nobody knows where it lies: it is saved beside, as `save` +
/// ".before-jump".
class MapKeeper {
 public:
  /// Throws std::runtime_error for a file that cannot be loaded.
  explicit MapKeeper(MapFiles files);

  /// LOCAL_TO_GLOBAL; one from before a jump is left out. Throws std::invalid_argument for numbers that
  /// cannot be.
  void take(const rigid_transform_t& message);

  /// The pose jumped at this time: LOCAL_TO_GLOBAL has to be told anew.
  void jump(std::int64_t utime_us);
  /// The clock of the senders was set: times from before it tell nothing.
  void clock_stepped() { jumped_us_ = std::numeric_limits<std::int64_t>::min(); }
  /// Keeps the map of before the jump.
  void keep_old(const WorldMap& world);

  /// The loaded map, or that of before a jump, in the local frame, once, as soon as its place is known.
  std::optional<MapMemory> take_loaded();
  [[nodiscard]] bool waits_for_place() const {
    return loaded_ && loaded_->T_global_local && !T_global_local_;
  }

  /// Saves when it is time, beside the caller's work.
  void tick(Micros now, const WorldMap& world);
  /// Saves now. Throws std::runtime_error.
  void stop(const WorldMap& world);
  /// Of the last try to save; empty: it is on the disk.
  [[nodiscard]] const std::string& trouble() const { return trouble_; }

 private:
  [[nodiscard]] bool has_something_to_save(const WorldMap& world) const;
  [[nodiscard]] MapMemory memory_of(const WorldMap& world) const;
  void end_save();
  void begin_save(MapMemory memory, std::filesystem::path file);

  MapFiles files_;
  std::optional<MapMemory> loaded_;
  std::optional<Pose> T_global_local_;
  std::optional<Pose> T_before_jump_;
  std::int64_t jumped_us_ = std::numeric_limits<std::int64_t>::min();
  std::optional<Micros> saved_at_;
  std::future<void> saving_;
  std::string trouble_;
};

}  // namespace floornav
