#include "mapping/node/map_keeper.hpp"

#include <exception>
#include <utility>

#include "mapping/moved_memory.hpp"
#include "mapping/node/map_file.hpp"

namespace floornav {

MapKeeper::MapKeeper(MapFiles files) : files_(std::move(files)) {
  const bool first_run = files_.load == files_.save && !std::filesystem::exists(files_.load);
  if (!files_.load.empty() && !first_run) loaded_ = load_map(files_.load);
}

void MapKeeper::take(const rigid_transform_t& message) {
  const Pose T_global_local = pose_from_arrays(message.trans, message.quat);
  if (message.utime >= jumped_us_) T_global_local_ = T_global_local;
}

void MapKeeper::jump(std::int64_t utime_us) {
  if (T_global_local_) T_before_jump_ = std::exchange(T_global_local_, std::nullopt);
  jumped_us_ = utime_us;
}

void MapKeeper::keep_old(const WorldMap& world) {
  const std::optional<Pose> T_before_jump = std::exchange(T_before_jump_, std::nullopt);
  if (loaded_ || world.utime_us() == 0) return;
  MapMemory memory = world.memory();
  if (T_before_jump) {
    memory.T_global_local = T_before_jump;
    loaded_ = std::move(memory);
  } else if (!files_.save.empty()) {
    end_save();
    begin_save(std::move(memory), files_.save.string() + ".before-jump");
  }
}

std::optional<MapMemory> MapKeeper::take_loaded() {
  if (!loaded_ || waits_for_place()) return std::nullopt;
  const MapMemory memory = std::move(*std::exchange(loaded_, std::nullopt));
  if (!memory.T_global_local) return memory;
  return moved(memory, T_global_local_->inverse() * *memory.T_global_local);
}

bool MapKeeper::has_something_to_save(const WorldMap& world) const {
  return !files_.save.empty() && !loaded_ && world.utime_us() > 0;
}

MapMemory MapKeeper::memory_of(const WorldMap& world) const {
  MapMemory memory = world.memory();
  memory.T_global_local = T_global_local_;
  return memory;
}

void MapKeeper::end_save() {
  if (!saving_.valid()) return;
  try {
    saving_.get();
    trouble_.clear();
  } catch (const std::exception& error) {
    trouble_ = error.what();
  }
}

void MapKeeper::begin_save(MapMemory memory, std::filesystem::path file) {
  saving_ = std::async(std::launch::async,
                       [memory = std::move(memory), file = std::move(file)] { save_map(memory, file); });
}

void MapKeeper::tick(Micros now, const WorldMap& world) {
  if (!saved_at_) saved_at_ = now;
  const bool due = now - *saved_at_ >= std::chrono::duration<double>(files_.save_every_s);
  if (saving_.valid() && saving_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) end_save();
  if (!due || saving_.valid() || !has_something_to_save(world)) return;
  saved_at_ = now;
  begin_save(memory_of(world), files_.save);
}

void MapKeeper::stop(const WorldMap& world) {
  end_save();
  if (has_something_to_save(world)) save_map(memory_of(world), files_.save);
}

}  // namespace floornav
