#pragma once

#include <filesystem>

#include "tests/devices/firewire/control_block.hpp"
#include "tests/devices/shared_block.hpp"

namespace floornav {

/// Commands a virtual Bumblebee from outside of the driver's process, which finds the control file by its
/// environment (kFirewireVariable).
class VirtualBumblebee {
 public:
  /// Makes the control file; a plugged, faultless camera that sees the scene.
  VirtualBumblebee(const std::filesystem::path& control_file, const std::filesystem::path& scene_file);
  /// Commands that of an existing control file. Throws std::runtime_error where there is none.
  explicit VirtualBumblebee(const std::filesystem::path& control_file);

  [[nodiscard]] const std::filesystem::path& control_file() const { return control_.file(); }
  FirewireControl* operator->() const { return &*control_; }

  void unplug() { control_->unplugged = 1; }
  void plug() { control_->unplugged = 0; }

 private:
  SharedBlock<FirewireControl> control_;
};

}  // namespace floornav
