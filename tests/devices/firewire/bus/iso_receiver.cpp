#include "tests/devices/firewire/bus/iso_receiver.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstring>
#include <utility>

#include <arpa/inet.h>
#include <linux/firewire-cdev.h>

namespace floornav {
namespace {

using Clock = std::chrono::steady_clock;

void sleep_until(std::int64_t monotonic_us) {
  std::this_thread::sleep_until(Clock::time_point(std::chrono::microseconds(monotonic_us)));
}

/// True, and one fewer left, where any of a fault is still to happen.
bool use_one(std::atomic<std::int32_t>& left) {
  std::int32_t count = left.load();
  while (count > 0)
    if (left.compare_exchange_weak(count, count - 1)) return true;
  return false;
}

void put_big_endian(std::uint32_t value, std::uint8_t* to) {
  const std::uint32_t in_order = htonl(value);
  std::memcpy(to, &in_order, sizeof in_order);
}

}  // namespace

std::int64_t bus_monotonic_us() {
  return std::chrono::duration_cast<std::chrono::microseconds>(Clock::now().time_since_epoch()).count();
}

std::uint32_t cycle_time(std::int64_t monotonic_us, int clock_ppm) {
  const auto us = static_cast<std::uint64_t>(monotonic_us + monotonic_us / 1'000'000 * clock_ppm);
  const auto seconds = static_cast<std::uint32_t>(us / 1'000'000 % 128);
  const auto cycles = static_cast<std::uint32_t>(us % 1'000'000 / 125);
  const auto offset = static_cast<std::uint32_t>(us % 125 * 3072 / 125);
  return seconds << 25 | cycles << 12 | offset;
}

IsoReceiver::IsoReceiver(const SeenEyes& scene, IidcCamera& camera, FirewireControl& control, int channel,
                         int header_bytes, std::function<void(std::span<const std::uint8_t>)> deliver)
    : scene_(scene),
      camera_(camera),
      control_(control),
      channel_(channel),
      header_bytes_(header_bytes),
      deliver_(std::move(deliver)) {}

IsoReceiver::~IsoReceiver() {
  stop();
}

void IsoReceiver::queue(std::uint64_t data, std::vector<std::uint32_t> packets) {
  const std::scoped_lock lock(mutex_);
  queued_.push_back({data, std::move(packets)});
}

void IsoReceiver::start() {
  if (running_.exchange(true)) return;
  ++control_.opened;
  thread_ = std::thread([this] { receive(); });
}

void IsoReceiver::stop() {
  running_ = false;
  if (thread_.joinable()) thread_.join();
}

/// The camera exposes in the bus's step; a frame is there when its last packet is.
void IsoReceiver::receive() {
  constexpr auto kIdle = std::chrono::milliseconds(1);
  std::int64_t step = -1;
  while (running_) {
    const Transmission sent = camera_.transmission();
    if (!sent.on || sent.channel != channel_ || sent.packets == 0) {
      std::this_thread::sleep_for(kIdle);
      step = -1;
      continue;
    }
    const std::int64_t period = sent.period_us();
    const std::int64_t origin = control_.origin_us;
    if (step < 0) step = std::max<std::int64_t>(0, (bus_monotonic_us() - origin) / period + 1);
    const std::int64_t exposure = origin + step * period;
    sleep_until(exposure + camera_.shutter_us() / 2 + period);
    control_.packet_bytes = sent.packet_bytes;
    if (running_ && control_.unplugged == 0 && control_.stalled == 0) expose(step, exposure, sent);
    ++step;
  }
}

void IsoReceiver::expose(std::int64_t step, std::int64_t exposure_us, const Transmission& sent) {
  if (use_one(control_.drop)) {
    ++control_.lost;
    return;
  }
  Buffer buffer;
  {
    const std::scoped_lock lock(mutex_);
    if (queued_.empty()) {
      ++control_.no_buffer;
      return;
    }
    buffer = std::move(queued_.front());
    queued_.pop_front();
  }
  fill(step, exposure_us, sent);
  if (use_one(control_.lose_packets)) shifted_ = true;
  DeliveredFrame& record = control_.records[static_cast<std::size_t>(step) % FirewireControl::kRecords];
  record.exposure_us = exposure_us;
  record.raised_us = bus_monotonic_us();
  ++control_.raised;
  deliver(buffer, sent);
}

/// The bytes of the eyes in turn, stamped.
void IsoReceiver::fill(std::int64_t step, std::int64_t exposure_us, const Transmission& sent) {
  if (control_.frozen == 0) frozen_step_ = -1;
  if (control_.frozen != 0 && frozen_step_ < 0) frozen_step_ = step;
  const std::int64_t of_scene =
      (frozen_step_ < 0 ? step : frozen_step_) * sent.period_us() / std::max(1, scene_.header().period_us);
  frame_.assign(static_cast<std::size_t>(sent.frame_bytes), 0);
  const std::size_t eyes = sent.eyes.size();
  for (std::size_t eye = 0; eye < eyes && control_.black == 0; ++eye) {
    const std::span<const std::uint8_t> image = scene_.image(of_scene, sent.eyes[eye]);
    const std::size_t pixels = std::min(image.size(), frame_.size() / eyes);
    for (std::size_t i = 0; i < pixels; ++i) frame_[i * eyes + eye] = image[i];
  }
  if (sent.stamped && frame_.size() >= 8) {
    put_big_endian(cycle_time(exposure_us, control_.clock_ppm), frame_.data());
    put_big_endian(static_cast<std::uint32_t>(step), frame_.data() + 4);
  }
  if (shifted_) std::rotate(frame_.begin(), frame_.begin() + sent.packet_bytes, frame_.end());
}

void IsoReceiver::deliver(const Buffer& buffer, const Transmission& sent) {
  const auto at = buffer.data - reinterpret_cast<std::uint64_t>(memory_.data());
  std::size_t room = 0;
  for (const std::uint32_t packet : buffer.packets) room += packet & 0xFFFFU;
  const std::size_t bytes = std::min({room, frame_.size(), memory_.size() - std::min(at, memory_.size())});
  std::copy_n(frame_.begin(), bytes, memory_.begin() + static_cast<std::ptrdiff_t>(at));

  constexpr std::size_t kBefore = offsetof(fw_cdev_event_iso_interrupt, header);
  const std::size_t headers =
      static_cast<std::size_t>(sent.packets) * static_cast<std::size_t>(header_bytes_);
  event_.assign(kBefore + headers, 0);
  fw_cdev_event_iso_interrupt head{};
  const std::uint32_t now = cycle_time(bus_monotonic_us(), control_.clock_ppm);
  head.type = FW_CDEV_EVENT_ISO_INTERRUPT;
  head.cycle = now >> 12 & 0xFFFFU;
  head.header_length = static_cast<std::uint32_t>(headers);
  std::memcpy(event_.data(), &head, kBefore);
  for (int packet = 0; packet < sent.packets; ++packet) {
    std::uint8_t* const header = event_.data() + kBefore + static_cast<std::size_t>(packet * header_bytes_);
    put_big_endian(static_cast<std::uint32_t>(sent.packet_bytes) << 16 | static_cast<std::uint32_t>(channel_)
                                                                             << 8,
                   header);
    if (header_bytes_ >= 8) put_big_endian(now >> 12 & 0xFFFFU, header + 4);
  }
  deliver_(event_);
}

}  // namespace floornav
