#include "drivers/bumblebee/camera_registers.hpp"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace floornav {
namespace {

constexpr double kPackets_hz = 8000;
constexpr std::int64_t kPacket_us = 125;

}  // namespace

std::optional<SensorType> sensor_type_of(std::uint32_t value) {
  const std::uint32_t kind = value & 0xFU;
  const bool color = (kind & 1U) == 0;
  switch (kind & ~1U) {
    case 0xA:
      return SensorType{640, 480, color};
    case 0xC:
      return SensorType{1024, 768, color};
    case 0xE:
      return SensorType{1280, 960, color};
    default:
      return std::nullopt;
  }
}

std::string bayer_pattern_of(std::uint32_t value) {
  std::string pattern;
  for (int shift = 24; shift >= 0; shift -= 8) {
    const auto letter = static_cast<char>(value >> shift & 0xFFU);
    pattern += letter >= 'A' && letter <= 'Z' ? letter : '?';
  }
  return pattern;
}

int packet_bytes_for(double frames_per_second, std::int64_t frame_bytes, int iso_speed_mbps) {
  const double per_packet = static_cast<double>(frame_bytes) * frames_per_second / kPackets_hz;
  const int bytes = 4 * static_cast<int>(std::ceil(per_packet / 4));
  const int most = iso_speed_mbps >= 800 ? 8188 : 1024 * iso_speed_mbps / 100;
  if (bytes > most)
    throw std::runtime_error(fmt::format(
        "{} frames/s of {} bytes are more than a bus of {} Mbit/s carries: at most {:.1f}", frames_per_second,
        frame_bytes, iso_speed_mbps, kPackets_hz * most / static_cast<double>(frame_bytes)));
  return bytes;
}

std::int64_t transfer_us(std::int64_t frame_bytes, int packet_bytes) {
  return (frame_bytes + packet_bytes - 1) / packet_bytes * kPacket_us;
}

}  // namespace floornav
