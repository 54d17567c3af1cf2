#include "mapping/tile_codec.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "mapping/byte_stream.hpp"

namespace floornav {
namespace {

constexpr double kHeightUnit_m = 1e-4;
constexpr double kRiseUnit = 1.0 / 1024;
constexpr double kVariancePerOctave = 8;  // codes
constexpr double kLeastVariance_m2 = 1e-9;
constexpr std::int64_t kMostHeight = 20'000'000'000;  // units
constexpr std::int64_t kMostRise = 1'000'000;
constexpr std::uint8_t kLower = 1;
constexpr std::uint8_t kUpper = 2;
constexpr std::uint8_t kOverhead = 4;
constexpr std::uint8_t kFloorDoubt = 8;
constexpr int kReachBit = 4;  ///< of a level's first byte: its reach is above, its support below
constexpr int kColumn = -8;   ///< instead of a reach

std::int64_t units(double value, double unit) {
  return std::llround(value / unit);
}

std::uint8_t variance_code(float var_m2) {
  const double octaves =
      std::log2(std::max(static_cast<double>(var_m2), kLeastVariance_m2) / kLeastVariance_m2);
  return static_cast<std::uint8_t>(std::min(255.0, std::round(kVariancePerOctave * octaves)));
}

float variance_of(std::uint8_t code) {
  return static_cast<float>(kLeastVariance_m2 * std::exp2(code / kVariancePerOctave));
}

/// What the next level is told against: the one before.
struct Previous {
  std::int64_t z = 0;
  std::int64_t rise_x = 0;
  std::int64_t rise_y = 0;
};

void write_difference(std::int64_t now, std::int64_t& before, ByteWriter& out) {
  out.number(now - before);
  before = now;
}

std::int64_t read_difference(std::int64_t& before, std::int64_t most, ByteReader& in) {
  const std::int64_t difference = in.number();
  if (std::abs(difference) > 2 * most || std::abs(before + difference) > most)
    throw std::invalid_argument("a height or rise that cannot be");
  return before += difference;
}

void write_level(const Level& level, Previous& previous, ByteWriter& out) {
  const int reach = level.column ? kColumn : level.reach;
  out.byte(static_cast<std::uint8_t>(level.support | (reach << kReachBit)));
  out.byte(variance_code(level.var_m2));
  write_difference(units(level.z_m, kHeightUnit_m), previous.z, out);
  write_difference(units(level.gradient_x, kRiseUnit), previous.rise_x, out);
  write_difference(units(level.gradient_y, kRiseUnit), previous.rise_y, out);
}

Level read_level(Previous& previous, ByteReader& in) {
  const std::uint8_t head = in.byte();
  Level level;
  const auto reach = static_cast<std::int8_t>(static_cast<std::int8_t>(head) >> kReachBit);
  level.column = reach == kColumn;
  level.reach = level.column ? std::int8_t{0} : reach;
  level.support = head & ((1 << kReachBit) - 1);
  if (level.support == 0 || level.support > Level::kMost)
    throw std::invalid_argument("a support that cannot be");
  level.var_m2 = variance_of(in.byte());
  const auto z = static_cast<double>(read_difference(previous.z, kMostHeight, in));
  const auto rise_x = static_cast<double>(read_difference(previous.rise_x, kMostRise, in));
  const auto rise_y = static_cast<double>(read_difference(previous.rise_y, kMostRise, in));
  level.z_m = static_cast<float>(kHeightUnit_m * z);
  level.gradient_x = static_cast<float>(kRiseUnit * rise_x);
  level.gradient_y = static_cast<float>(kRiseUnit * rise_y);
  return level;
}

std::uint8_t parts_of(const CellMemory& cell) {
  std::uint8_t parts = 0;
  if (cell.lower().exists()) parts |= kLower;
  if (cell.upper().exists()) parts |= kUpper;
  if (!std::isnan(cell.overhead_z_m())) parts |= kOverhead;
  if (cell.floor_doubt() > 0) parts |= kFloorDoubt;
  return parts;
}

struct PreviousCell {
  Previous lower;
  Previous upper;
  std::int64_t overhead = 0;
};

void write_cell(const CellMemory& cell, PreviousCell& previous, ByteWriter& out) {
  const std::uint8_t parts = parts_of(cell);
  out.byte(parts);
  if ((parts & kLower) != 0) write_level(cell.lower(), previous.lower, out);
  if ((parts & kUpper) != 0) write_level(cell.upper(), previous.upper, out);
  if ((parts & kOverhead) != 0)
    write_difference(units(cell.overhead_z_m(), kHeightUnit_m), previous.overhead, out);
  if ((parts & kFloorDoubt) != 0) out.byte(static_cast<std::uint8_t>(cell.floor_doubt()));
}

CellMemory read_cell(PreviousCell& previous, ByteReader& in) {
  const std::uint8_t parts = in.byte();
  if (parts == 0 || parts > (kLower | kUpper | kOverhead | kFloorDoubt))
    throw std::invalid_argument("a cell with unknown parts");
  Level lower, upper;
  float overhead_z_m = std::numeric_limits<float>::quiet_NaN();
  std::uint8_t floor_doubt = 0;
  if ((parts & kLower) != 0) lower = read_level(previous.lower, in);
  if ((parts & kUpper) != 0) upper = read_level(previous.upper, in);
  if ((parts & kOverhead) != 0)
    overhead_z_m = static_cast<float>(
        kHeightUnit_m * static_cast<double>(read_difference(previous.overhead, kMostHeight, in)));
  if ((parts & kFloorDoubt) != 0) floor_doubt = in.byte();
  return {lower, upper, overhead_z_m, floor_doubt};
}

/// Runs of empty and of other cells, in turn.
void write_cells(const CellStore& cells, ByteWriter& out) {
  PreviousCell previous;
  for (std::size_t i = 0; i < cells.size();) {
    std::size_t begin = i;
    while (i < cells.size() && cells.is_empty(i)) ++i;
    out.count(i - begin);
    begin = i;
    while (i < cells.size() && !cells.is_empty(i)) ++i;
    out.count(i - begin);
    for (; begin < i; ++begin) write_cell(cells.at(begin), previous, out);
  }
}

CellStore read_cells(std::size_t count, ByteReader& in) {
  std::vector<CellMemory> cells(count);
  PreviousCell previous;
  for (std::size_t i = 0; i < cells.size();) {
    i += in.count(cells.size() - i);
    for (std::size_t full = in.count(cells.size() - i); full > 0; --full)
      cells[i++] = read_cell(previous, in);
  }
  return CellStore(cells);
}

/// Runs of vertices that share a value, each as its length and what `write(value)` tells.
template <class Value, class Write>
void write_runs(Value value, Write write) {
  constexpr std::size_t kAll = GridTile::kVertices;
  for (std::size_t i = 0; i < kAll;) {
    const std::size_t begin = i;
    const auto shared = value(begin);
    while (i < kAll && value(i) == shared) ++i;
    write(i - begin, shared);
  }
}

void write_vertices(const MapTile& tile, ByteWriter& out) {
  write_runs([&](std::size_t i) { return tile.vertices[i].is(Vertex::kFloor); },
             [&](std::size_t run, bool floor) { out.count(2 * run + (floor ? 1 : 0)); });
  std::int64_t previous = 0;
  write_runs([&](std::size_t i) { return std::int64_t{tile.seen()[i]}; },
             [&](std::size_t run, std::int64_t seen) {
               out.count(run);
               write_difference(seen, previous, out);
             });
}

void read_vertices(MapTile& tile, ByteReader& in) {
  constexpr std::int64_t kMostTime = std::numeric_limits<std::uint32_t>::max();
  const std::size_t all = tile.vertices.size();
  for (std::size_t i = 0; i < all;) {
    const std::size_t run = in.count(2 * (all - i) + 1);
    if (run < 2) throw std::invalid_argument("a run of nothing");
    for (std::size_t k = 0; k < run / 2; ++k) tile.vertices[i++].set(Vertex::kFloor, (run & 1U) != 0);
  }
  std::int64_t previous = 0;
  for (std::size_t i = 0; i < all;) {
    std::size_t run = in.count(all - i);
    if (run == 0) throw std::invalid_argument("a run of nothing");
    const std::int64_t seen = read_difference(previous, kMostTime, in);
    if (seen < 0) throw std::invalid_argument("a time that cannot be");
    for (; run > 0; --run) tile.seen().set(i++, static_cast<std::uint32_t>(seen));
  }
}

}  // namespace

std::vector<std::uint8_t> pack(const MapTile& tile) {
  ByteWriter out;
  write_cells(tile.cells, out);
  write_vertices(tile, out);
  std::vector<std::uint8_t> bytes = out.take();
  bytes.shrink_to_fit();
  return bytes;
}

void unpack(std::span<const std::uint8_t> bytes, std::size_t cells, MapTile& tile) {
  ByteReader in(bytes);
  tile.cells = read_cells(cells, in);
  read_vertices(tile, in);
  if (!in.empty()) throw std::invalid_argument("more bytes than a tile has");
}

}  // namespace floornav
