#pragma once

#include <cstdint>
#include <filesystem>

#include "tests/devices/kinect/control_block.hpp"
#include "tests/devices/shared_block.hpp"

namespace floornav {

/// Commands virtual Kinects from outside of the driver's process. The plug-in finds the control file by the
/// environment of that process (kControlVariable).
class VirtualKinect {
 public:
  /// Makes the control file; a plugged, faultless device that sees the scene.
  VirtualKinect(const std::filesystem::path& control_file, const std::filesystem::path& scene_file);
  /// Commands those of an existing control file. Throws std::runtime_error where there is none.
  explicit VirtualKinect(const std::filesystem::path& control_file);

  [[nodiscard]] const std::filesystem::path& control_file() const { return control_.file(); }
  ControlBlock* operator->() const { return &*control_; }

  void unplug(int device = 0) { control_->unplugged |= 1U << device; }
  void plug(int device = 0) { control_->unplugged &= ~(1U << device); }

 private:
  SharedBlock<ControlBlock> control_;
};

}  // namespace floornav
