#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>

#include "runtime/geometry/parallel.hpp"

namespace floornav {

/// Cuts the points of a pool into pieces that workers share: work(begin, end), in multiples of what the
/// kernels handle at once. A small pool is one piece.
template <class Work>
void for_pieces(std::size_t points, Parallel& parallel, const Work& work) {
  constexpr std::size_t kPointsPerPiece = 16384;
  if (points <= kPointsPerPiece) return work(std::size_t{0}, points);
  const auto one = [&](int piece, int) {
    const std::size_t begin = static_cast<std::size_t>(piece) * kPointsPerPiece;
    work(begin, std::min(begin + kPointsPerPiece, points));
  };
  parallel.run(static_cast<int>((points + kPointsPerPiece - 1) / kPointsPerPiece), std::ref(one));
}

}  // namespace floornav
