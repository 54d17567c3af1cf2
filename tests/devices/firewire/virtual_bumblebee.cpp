#include "tests/devices/firewire/virtual_bumblebee.hpp"

#include <chrono>

namespace floornav {

VirtualBumblebee::VirtualBumblebee(const std::filesystem::path& control_file,
                                   const std::filesystem::path& scene_file)
    : control_(control_file, SharedBlock<FirewireControl>::How::kMake) {
  store_path(scene_file, control_->scene_path);
  control_->origin_us = std::chrono::duration_cast<std::chrono::microseconds>(
                            std::chrono::steady_clock::now().time_since_epoch())
                            .count();
}

VirtualBumblebee::VirtualBumblebee(const std::filesystem::path& control_file)
    : control_(control_file, SharedBlock<FirewireControl>::How::kOpen) {}

}  // namespace floornav
