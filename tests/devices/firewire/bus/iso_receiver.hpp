#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <span>
#include <thread>
#include <vector>

#include "tests/devices/firewire/bus/iidc_camera.hpp"

namespace floornav {

/// Receives the camera's frames on an isochronous channel into buffers that a program has queued, as the
/// kernel's DMA does.
class IsoReceiver {
 public:
  /// `deliver` gets each event for the program's descriptor.
  IsoReceiver(const SeenEyes& scene, IidcCamera& camera, FirewireControl& control, int channel,
              int header_bytes, std::function<void(std::span<const std::uint8_t>)> deliver);
  ~IsoReceiver();
  IsoReceiver(const IsoReceiver&) = delete;
  IsoReceiver& operator=(const IsoReceiver&) = delete;

  /// The memory that the program has mapped.
  void set_memory(std::span<std::uint8_t> memory) { memory_ = memory; }
  /// A frame's packets, to be written from `data` (an address in the memory) on.
  void queue(std::uint64_t data, std::vector<std::uint32_t> packets);
  void start();
  void stop();
  /// Nothing more is received; stop() is still to be called.
  void abandon() { running_ = false; }

 private:
  struct Buffer {
    std::uint64_t data = 0;
    std::vector<std::uint32_t> packets;
  };

  void receive();
  void expose(std::int64_t step, std::int64_t exposure_us, const Transmission& sent);
  void fill(std::int64_t step, std::int64_t exposure_us, const Transmission& sent);
  void deliver(const Buffer& buffer, const Transmission& sent);

  const SeenEyes& scene_;
  IidcCamera& camera_;
  FirewireControl& control_;
  int channel_;
  int header_bytes_;
  std::function<void(std::span<const std::uint8_t>)> deliver_;
  std::span<std::uint8_t> memory_;
  std::mutex mutex_;
  std::deque<Buffer> queued_;
  std::vector<std::uint8_t> frame_;
  std::vector<std::uint8_t> event_;
  std::int64_t frozen_step_ = -1;
  bool shifted_ = false;  ///< packets were lost: frames begin late
  std::atomic<bool> running_ = false;
  std::thread thread_;
};

/// The bus's clock: 7 bits of s, 13 of 1/8000 s, 12 of 1/3072 of that.
std::uint32_t cycle_time(std::int64_t monotonic_us, int clock_ppm);

std::int64_t bus_monotonic_us();

}  // namespace floornav
