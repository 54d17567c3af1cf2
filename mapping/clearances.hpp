#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace floornav {

/// The free height above each vertex of a tile, in counts. Takes memory only where something is above.
template <std::size_t kVertices>
class Clearances {
 public:
  static constexpr std::uint8_t kNothingAbove = 255;

  std::uint8_t operator[](std::size_t vertex) const {
    return counts_.empty() ? kNothingAbove : counts_[vertex];
  }
  void set(std::size_t vertex, std::uint8_t counts) {
    if (counts_.empty() && counts == kNothingAbove) return;
    if (counts_.empty()) counts_.assign(kVertices, kNothingAbove);
    counts_[vertex] = counts;
  }
  [[nodiscard]] std::size_t memory_bytes() const { return counts_.capacity(); }
  friend bool operator==(const Clearances& a, const Clearances& b) {
    for (std::size_t i = 0; i < kVertices; ++i)
      if (a[i] != b[i]) return false;
    return true;
  }

 private:
  std::vector<std::uint8_t> counts_;
};

}  // namespace floornav
