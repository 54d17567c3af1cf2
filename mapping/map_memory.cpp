#include "mapping/map_memory.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "mapping/byte_stream.hpp"

namespace floornav {
namespace {

constexpr std::array<std::uint8_t, 8> kMagic{'f', 'l', 'o', 'o', 'r', 'm', 'a', 'p'};
constexpr std::uint8_t kVersion = 2;
constexpr std::size_t kHead = kMagic.size() + 1 + 8 + 8;  ///< magic, version, length, checksum
constexpr std::int64_t kFarthestTile = 1 << 24;

/// FNV-1a.
std::uint64_t checksum(std::span<const std::uint8_t> bytes) {
  std::uint64_t sum = 0xcbf29ce484222325ULL;
  for (const std::uint8_t byte : bytes) sum = (sum ^ byte) * 0x100000001b3ULL;
  return sum;
}

void write_fixed(std::uint64_t value, ByteWriter& out) {
  for (int i = 0; i < 8; ++i) out.byte(static_cast<std::uint8_t>(value >> (8 * i)));
}

std::uint64_t read_fixed(ByteReader& in) {
  std::uint64_t value = 0;
  for (int i = 0; i < 8; ++i) value |= static_cast<std::uint64_t>(in.byte()) << (8 * i);
  return value;
}

void write_pose(const Pose& pose, ByteWriter& out) {
  double position[3], turn[4];
  pose_to_arrays(pose, position, turn);
  for (const double value : position) out.real(value);
  for (const double value : turn) out.real(value);
}

Pose read_pose(ByteReader& in) {
  double position[3], turn[4];
  for (double& value : position) value = in.real();
  for (double& value : turn) value = in.real();
  return pose_from_arrays(position, turn);
}

std::vector<std::uint8_t> body_of(const MapMemory& memory) {
  ByteWriter out;
  out.real(memory.pitch_m);
  out.count(static_cast<std::uint64_t>(memory.cells_per_vertex));
  out.number(memory.utime_us);
  write_pose(memory.T_world_body, out);
  out.byte(memory.T_global_local ? 1 : 0);
  if (memory.T_global_local) write_pose(*memory.T_global_local, out);
  out.count(memory.tiles.size());
  CellIndex before;
  for (const auto& [index, bytes] : memory.tiles) {
    out.number(std::int64_t{index.ix} - before.ix);
    out.number(std::int64_t{index.iy} - before.iy);
    out.count(bytes.size());
    out.append(bytes);
    before = index;
  }
  return out.take();
}

std::int32_t read_index(std::int32_t before, ByteReader& in) {
  const std::int64_t step = in.number();
  if (std::abs(step) > 2 * kFarthestTile || std::abs(before + step) > kFarthestTile)
    throw std::invalid_argument("a tile farther away than any map");
  return static_cast<std::int32_t>(before + step);
}

MapMemory read_body(ByteReader& in) {
  constexpr std::size_t kMostCells = 1000;
  MapMemory memory;
  memory.pitch_m = in.real();
  memory.cells_per_vertex = static_cast<std::int32_t>(in.count(kMostCells));
  memory.utime_us = in.number();
  memory.T_world_body = read_pose(in);
  if (in.byte() != 0) memory.T_global_local = read_pose(in);
  const bool empty = memory.pitch_m == 0;
  if (!empty && !(memory.pitch_m >= 0.001 && memory.pitch_m <= 10))
    throw std::invalid_argument("an absurd pitch");
  if (memory.cells_per_vertex < 1 || memory.utime_us < 0)
    throw std::invalid_argument("an absurd size or time");
  CellIndex index;
  for (std::uint64_t tiles = in.count(); tiles > 0; --tiles) {
    index = {read_index(index.ix, in), read_index(index.iy, in)};
    const auto bytes = in.take(in.count(std::size_t{1} << 30));
    memory.tiles.emplace_back(index, std::vector<std::uint8_t>(bytes.begin(), bytes.end()));
  }
  if (!in.empty()) throw std::invalid_argument("more bytes than its tiles have");
  return memory;
}

}  // namespace

std::vector<std::uint8_t> to_bytes(const MapMemory& memory) {
  const std::vector<std::uint8_t> body = body_of(memory);
  ByteWriter out;
  out.append(kMagic);
  out.byte(kVersion);
  write_fixed(body.size(), out);
  write_fixed(checksum(body), out);
  out.append(body);
  return out.take();
}

MapMemory memory_from_bytes(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < kHead || !std::ranges::equal(bytes.first(kMagic.size()), kMagic))
    throw std::invalid_argument("is no map of floornav");
  ByteReader head(bytes.subspan(kMagic.size()));
  const std::uint8_t version = head.byte();
  if (version != kVersion)
    throw std::invalid_argument("is a map of version " + std::to_string(version) +
                                ", this program reads version " + std::to_string(kVersion));
  const std::uint64_t size = read_fixed(head);
  const std::uint64_t sum = read_fixed(head);
  const auto body = bytes.subspan(kHead);
  if (body.size() != size)
    throw std::invalid_argument("is damaged: " + std::to_string(body.size()) + " bytes of " +
                                std::to_string(size));
  if (checksum(body) != sum) throw std::invalid_argument("is damaged: its checksum is another one");
  ByteReader in(body);
  return read_body(in);
}

}  // namespace floornav
