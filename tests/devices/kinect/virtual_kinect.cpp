#include "tests/devices/kinect/virtual_kinect.hpp"

#include <chrono>

namespace floornav {

VirtualKinect::VirtualKinect(const std::filesystem::path& control_file,
                             const std::filesystem::path& scene_file)
    : control_(control_file, SharedBlock<ControlBlock>::How::kMake) {
  store_path(scene_file, control_->scene_path);
  control_->origin_us = std::chrono::duration_cast<std::chrono::microseconds>(
                            std::chrono::steady_clock::now().time_since_epoch())
                            .count();
}

VirtualKinect::VirtualKinect(const std::filesystem::path& control_file)
    : control_(control_file, SharedBlock<ControlBlock>::How::kOpen) {}

}  // namespace floornav
