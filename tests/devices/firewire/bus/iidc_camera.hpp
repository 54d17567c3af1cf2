#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "tests/devices/firewire/bus/seen_eyes.hpp"
#include "tests/devices/firewire/control_block.hpp"

namespace floornav {

/// What a camera is told to send.
struct Transmission {
  bool on = false;
  int channel = 0;
  int packet_bytes = 0;
  int packets = 0;  ///< a frame
  std::int64_t frame_bytes = 0;
  std::vector<int> eyes;  ///< bytes of these eyes in turn
  bool stamped = false;

  [[nodiscard]] std::int64_t period_us() const { return std::int64_t{packets} * 125; }
};

/// A Bumblebee2 or XB3 as its registers show it: IIDC's (1394 TA 1.31), with Format_7 modes 0 and 3, and
/// Point Grey's own. What kind it is follows from its scene.
class IidcCamera {
 public:
  IidcCamera(const SeenEyes& scene, FirewireControl& control);

  /// The configuration ROM, 256 quadlets.
  [[nodiscard]] const std::vector<std::uint32_t>& rom() const { return rom_; }
  /// A quadlet at an offset in the camera's register space; nothing where it has none.
  [[nodiscard]] std::optional<std::uint32_t> read(std::uint64_t offset) const;
  /// False where it has none there.
  bool write(std::uint64_t offset, std::uint32_t value);
  /// A camera that is plugged in, or for which the bus was reset with `reset_stops`, sends nothing.
  void stop();
  [[nodiscard]] Transmission transmission() const;
  [[nodiscard]] std::int64_t shutter_us() const;

 private:
  void add_formats();
  void add_features();
  void add_own_registers();
  void tell_exposure(std::uint32_t at, std::uint32_t value);
  [[nodiscard]] bool is_xb3() const { return scene_.header().eyes == 3; }
  [[nodiscard]] std::uint32_t value(std::uint32_t at) const;
  [[nodiscard]] std::uint32_t mode_base() const;
  [[nodiscard]] int bytes_per_pixel(std::uint32_t base) const;
  [[nodiscard]] std::uint32_t frame_bytes(std::uint32_t base) const;
  [[nodiscard]] std::uint32_t packets(std::uint32_t base) const;

  const SeenEyes& scene_;
  FirewireControl& control_;
  std::vector<std::uint32_t> rom_;
  mutable std::mutex mutex_;                          ///< of what follows
  std::map<std::uint32_t, std::uint32_t> registers_;  ///< by offset from the command base
};

}  // namespace floornav
