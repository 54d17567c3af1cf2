#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace floornav {

/// When each vertex of a tile was seen last, in units of 0.1 s that start again every 13 years: only
/// differences tell.
///
/// Kept in 2 bytes a vertex, exactly while a tile's times span less than 1.8 hours. After that, what lies
/// more than kExact units before the newest is taken to be as old as that; a message cannot tell it apart.
template <std::size_t kVertices>
class SeenTimes {
 public:
  static constexpr std::int64_t kUnit_us = 100'000;
  static constexpr std::int32_t kExact = std::numeric_limits<std::int16_t>::max();

  /// The time of `utime_us`; never 0.
  static constexpr std::uint32_t at(std::int64_t utime_us) {
    const auto time = static_cast<std::uint32_t>(utime_us / kUnit_us);
    return time == 0 ? 1 : time;
  }

  /// 0: never.
  [[nodiscard]] std::uint32_t operator[](std::size_t vertex) const {
    const std::uint16_t offset = offsets_[vertex];
    if (offset == 0) return 0;
    const std::uint32_t time = before_ + offset;
    return time == 0 ? 1 : time;
  }
  void set(std::size_t vertex, std::uint32_t time) {
    if (time == 0) {
      offsets_[vertex] = 0;
      return;
    }
    if (!begun_) before_ = time - kExact;
    begun_ = true;
    if (!fits(offset_of(time))) make_room_for(offset_of(time));
    offsets_[vertex] = static_cast<std::uint16_t>(std::clamp(offset_of(time), 1, kMost));
  }
  friend bool operator==(const SeenTimes& a, const SeenTimes& b) {
    for (std::size_t i = 0; i < kVertices; ++i)
      if (a[i] != b[i]) return false;
    return true;
  }

 private:
  static constexpr std::int32_t kMost = std::numeric_limits<std::uint16_t>::max();
  static bool fits(std::int32_t offset) { return offset >= 1 && offset <= kMost; }
  [[nodiscard]] std::int32_t offset_of(std::uint32_t time) const {
    return static_cast<std::int32_t>(time - before_);
  }

  /// Begins later or earlier: so that nothing is lost, or if that cannot be, so that the newest kExact fit.
  void make_room_for(std::int32_t offset) {
    std::int64_t oldest = offset;
    std::int64_t newest = offset;
    for (const std::uint16_t held : offsets_) {
      if (held == 0) continue;
      oldest = std::min<std::int64_t>(oldest, held);
      newest = std::max<std::int64_t>(newest, held);
    }
    const std::int64_t by = newest - oldest < kMost ? oldest - 1 : newest - 1 - kExact;
    for (std::uint16_t& held : offsets_)
      if (held != 0) held = static_cast<std::uint16_t>(std::clamp<std::int64_t>(held - by, 1, kMost));
    before_ += static_cast<std::uint32_t>(by);
  }

  std::uint32_t before_ = 0;  ///< the offsets count from here
  bool begun_ = false;
  std::array<std::uint16_t, kVertices> offsets_{};
};

}  // namespace floornav
