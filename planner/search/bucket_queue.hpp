#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

namespace floornav {

/// A monotone priority queue of small integers: one bucket a priority, in a ring, with a bit for each bucket
/// that holds something. Of equal priorities the last one pushed comes first. Memory is kept between
/// searches.
class BucketQueue {
 public:
  /// Empties the queue. Priorities pushed from now on lie in [lowest left, lowest left + span).
  void reset(std::uint32_t span) {
    if (span > heads_.size()) {
      const std::size_t size = std::bit_ceil(std::max<std::size_t>(span, 4096));
      heads_.assign(size, kNone);
      filled_.assign(size / 64, 0);
      groups_.assign(size / 4096, 0);
    } else {
      clear();
    }
    mask_ = static_cast<std::uint32_t>(heads_.size() - 1);
    entries_.clear();
    free_ = kNone;
    current_ = 0;
  }

  void push(std::uint32_t priority, std::uint32_t item) {
    const std::uint32_t bucket = priority & mask_;
    const std::uint32_t slot = free_;
    if (slot != kNone) {
      free_ = entries_[slot].next;
      entries_[slot] = {item, heads_[bucket]};
      heads_[bucket] = slot;
    } else {
      entries_.push_back({item, heads_[bucket]});
      heads_[bucket] = static_cast<std::uint32_t>(entries_.size() - 1);
    }
    filled_[bucket >> 6] |= 1ULL << (bucket & 63);
    groups_[bucket >> 12] |= 1ULL << ((bucket >> 6) & 63);
  }

  /// Takes an item of the lowest priority. False: the queue is empty.
  bool pop(std::uint32_t& item) {
    if (heads_[current_] == kNone && !advance()) return false;
    const std::uint32_t slot = heads_[current_];
    Entry& entry = entries_[slot];
    item = entry.item;
    heads_[current_] = entry.next;
    entry.next = free_;
    free_ = slot;
    return true;
  }

  /// The last item popped was the only one of its priority that was left.
  [[nodiscard]] bool bucket_done() const { return heads_[current_] == kNone; }
  /// Calls visit(item) for the two items that come next within the present priority, if there are any.
  template <class Visit>
  void look_ahead(const Visit& visit) const {
    if (bucket_done()) return;
    const Entry& next = entries_[heads_[current_]];
    visit(next.item);
    if (next.next != kNone) visit(entries_[next.next].item);
  }

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;
  struct Entry {
    std::uint32_t item;
    std::uint32_t next;
  };

  /// Moves on to the next bucket that holds something, around the ring.
  bool advance() {
    filled_[current_ >> 6] &= ~(1ULL << (current_ & 63));
    if (filled_[current_ >> 6] == 0) groups_[current_ >> 12] &= ~(1ULL << ((current_ >> 6) & 63));
    const std::uint32_t word = current_ >> 6;
    if (const std::uint64_t rest = filled_[word] & (~0ULL << (current_ & 63)); rest != 0) {
      current_ = word * 64 + static_cast<std::uint32_t>(std::countr_zero(rest));
      return true;
    }
    const std::uint32_t group = word >> 6;
    // Words of this group after the present one, then the other groups, then this group from its start.
    const std::uint64_t after = (word & 63) == 63 ? 0 : ~0ULL << ((word & 63) + 1);
    if (const std::uint64_t rest = groups_[group] & after; rest != 0) return enter(group, rest);
    const auto n = static_cast<std::uint32_t>(groups_.size());
    for (std::uint32_t i = 1; i <= n; ++i) {
      const std::uint32_t next = (group + i) % n;
      if (groups_[next] != 0) return enter(next, groups_[next]);
    }
    return false;
  }

  bool enter(std::uint32_t group, std::uint64_t words) {
    const std::uint32_t word = group * 64 + static_cast<std::uint32_t>(std::countr_zero(words));
    current_ = word * 64 + static_cast<std::uint32_t>(std::countr_zero(filled_[word]));
    return true;
  }

  void clear() {
    for (std::size_t group = 0; group < groups_.size(); ++group) {
      for (std::uint64_t words = groups_[group]; words != 0; words &= words - 1) {
        const std::size_t word = group * 64 + static_cast<std::size_t>(std::countr_zero(words));
        for (std::uint64_t bits = filled_[word]; bits != 0; bits &= bits - 1)
          heads_[word * 64 + static_cast<std::size_t>(std::countr_zero(bits))] = kNone;
        filled_[word] = 0;
      }
      groups_[group] = 0;
    }
  }

  std::vector<std::uint32_t> heads_;   ///< first entry of each bucket
  std::vector<std::uint64_t> filled_;  ///< bit b of word w: bucket 64 w + b may hold something
  std::vector<std::uint64_t> groups_;  ///< bit w of group g: word 64 g + w is not 0
  std::vector<Entry> entries_;
  std::uint32_t free_ = kNone;
  std::uint32_t mask_ = 0;
  std::uint32_t current_ = 0;
};

}  // namespace floornav
