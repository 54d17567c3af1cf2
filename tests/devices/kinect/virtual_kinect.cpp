#include "tests/devices/kinect/virtual_kinect.hpp"

#include <chrono>
#include <stdexcept>
#include <utility>

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

namespace floornav {

VirtualKinect::VirtualKinect(std::filesystem::path control_file, const std::filesystem::path& scene_file)
    : file_(std::move(control_file)) {
  map(true);
  const std::string scene = std::filesystem::absolute(scene_file).string();
  if (scene.size() >= ControlBlock::kLongestPath) throw std::runtime_error(scene + ": path too long");
  scene.copy(control_->scene_path, scene.size());
  control_->origin_us = std::chrono::duration_cast<std::chrono::microseconds>(
                            std::chrono::steady_clock::now().time_since_epoch())
                            .count();
}

VirtualKinect::VirtualKinect(std::filesystem::path control_file) : file_(std::move(control_file)) {
  map(false);
}

VirtualKinect::~VirtualKinect() {
  ::munmap(control_, sizeof(ControlBlock));
}

void VirtualKinect::map(bool make) {
  const int file =
      ::open(file_.c_str(), make ? O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC : O_RDWR | O_CLOEXEC, 0600);
  if (file < 0 || (make && ::ftruncate(file, sizeof(ControlBlock)) != 0))
    throw std::runtime_error(file_.string() + ": no control file");
  void* memory = ::mmap(nullptr, sizeof(ControlBlock), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  ::close(file);
  if (memory == MAP_FAILED) throw std::runtime_error(file_.string() + ": cannot be mapped");
  control_ = static_cast<ControlBlock*>(memory);
}

}  // namespace floornav
