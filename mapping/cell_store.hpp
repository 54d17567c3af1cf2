#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "mapping/packed_level.hpp"

namespace floornav {

/// The lattice cells of a tile in 8 bytes each, blocks of which nothing was ever seen in none; what few cells
/// have - an upper level, something overhead - lies beside them.
///
/// Heights are kept in steps of 15 um, so that the small gain of a far view still moves them, up to kReach_m
/// above and below the level that the store was made for; what is farther is kept at that distance.
class CellStore {
 public:
  static constexpr float kReach_m = 7.99F;

  CellStore() = default;
  /// Empty cells, a multiple of 256, for heights around `level_m`.
  CellStore(std::size_t cells, double level_m);
  /// Cells with these memories, in the middle of whose heights the level is.
  explicit CellStore(std::span<const CellMemory> cells);

  [[nodiscard]] std::size_t size() const { return blocks_.size() * kBlock; }
  [[nodiscard]] bool is_empty(std::size_t slot) const { return word(slot) == 0; }
  /// Whether a cell, or any, has an upper level or something overhead.
  [[nodiscard]] bool has_more(std::size_t slot) const { return (word(slot) & kMore) != 0; }
  [[nodiscard]] bool has_more() const { return !more_.empty(); }
  [[nodiscard]] CellMemory at(std::size_t slot) const;
  /// CellMemory::decider() of a cell.
  [[nodiscard]] std::optional<Surface> decider(std::size_t slot) const {
    const std::uint64_t own = word(slot);
    const PackedLevel level((own & kMore) == 0 ? own : deciding_word(slot));
    if (level.support() < Level::kTrusted) return std::nullopt;
    return level.surface(level_);
  }
  void set(std::size_t slot, const CellMemory& memory);

  [[nodiscard]] std::size_t memory_bytes() const {
    return blocks_.capacity() * sizeof blocks_[0] + words_.capacity() * sizeof words_[0] +
           more_.capacity() * sizeof more_[0];
  }

 private:
  /// Low bits of a cell's word; above them is its lower level.
  static constexpr std::uint64_t kFloorDoubt = CellMemory::kMostFloorDoubt;
  static constexpr std::uint64_t kMore = kFloorDoubt + 1;
  static_assert(kMore < 1U << PackedLevel::kFreeBits);

  /// Slots are told apart in groups of 256: of a tile whose vertices have one cell each eight rows. A group
  /// has four blocks of eight by eight.
  static constexpr std::size_t kBlock = 64;
  static std::size_t block_of(std::size_t slot) { return slot / 256 * 4 + slot / 8 % 4; }
  static std::size_t place_in_block(std::size_t slot) { return slot / 32 % 8 * 8 + slot % 8; }
  [[nodiscard]] std::uint64_t word(std::size_t slot) const {
    const std::uint32_t block = blocks_[block_of(slot)];
    return block == kNoBlock ? 0 : words_[block * kBlock + place_in_block(slot)];
  }
  static constexpr std::uint32_t kNoBlock = std::numeric_limits<std::uint32_t>::max();

  struct More {
    std::uint64_t upper;
    float overhead_z_m;
    std::uint32_t slot;
  };
  [[nodiscard]] std::uint64_t deciding_word(std::size_t slot) const;
  [[nodiscard]] std::vector<More>::const_iterator place_of(std::size_t slot) const;
  std::uint32_t add_block();
  void set_more(std::size_t slot, const CellMemory& memory);

  std::vector<std::uint32_t> blocks_;  ///< which block of words_
  std::vector<std::uint64_t> words_;
  std::vector<More> more_;  ///< by rising slot
  std::int64_t level_ = 0;  ///< heights are stored as differences from it, in units of the store
};

}  // namespace floornav
