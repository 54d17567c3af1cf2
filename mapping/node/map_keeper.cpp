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
  T_global_local_ = pose_from_arrays(message.trans, message.quat);
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

void MapKeeper::tick(Micros now, const WorldMap& world) {
  if (!saved_at_) saved_at_ = now;
  const bool due = now - *saved_at_ >= std::chrono::duration<double>(files_.save_every_s);
  if (saving_.valid() && saving_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) end_save();
  if (!due || saving_.valid() || !has_something_to_save(world)) return;
  saved_at_ = now;
  saving_ = std::async(std::launch::async,
                       [memory = memory_of(world), file = files_.save] { save_map(memory, file); });
}

void MapKeeper::stop(const WorldMap& world) {
  end_save();
  if (has_something_to_save(world)) save_map(memory_of(world), files_.save);
}

}  // namespace floornav
