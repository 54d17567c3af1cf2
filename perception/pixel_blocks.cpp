#include "perception/pixel_blocks.hpp"

#include <algorithm>
#include <cmath>

namespace floornav {

void PixelBlocks::begin(const Pinhole& camera, const PlanePool& pool) {
  columns_ = static_cast<std::size_t>(per_row(camera));
  const auto rows = static_cast<std::size_t>((camera.height + kSide_px - 1) / kSide_px);
  for (auto* counts : {&points_, &inliers_, &patch_}) counts->resize(columns_ * rows);
  begin_ = pool.size() == 0 ? 0 : static_cast<std::size_t>(pool.block[0]) / columns_ * columns_;
  end_ = pool.size() == 0 ? 0
                          : (static_cast<std::size_t>(pool.block[pool.size() - 1]) / columns_ + 1) * columns_;
  std::fill(points_.begin() + static_cast<std::ptrdiff_t>(begin_),
            points_.begin() + static_cast<std::ptrdiff_t>(end_), 0);
  for (const std::int32_t block : std::span(pool.block).first(pool.size()))
    ++points_[static_cast<std::size_t>(block)];
}

void PixelBlocks::count(const PlanePool& pool, std::span<const float> distance, float threshold_sigmas) {
  std::fill(inliers_.begin() + static_cast<std::ptrdiff_t>(begin_),
            inliers_.begin() + static_cast<std::ptrdiff_t>(end_), 0);
  for (std::size_t i = 0; i < pool.size(); ++i)
    inliers_[static_cast<std::size_t>(pool.block[i])] += distance[i] <= threshold_sigmas ? 1 : 0;
}

void PixelBlocks::keep_largest_patch() {
  std::fill(patch_.begin() + static_cast<std::ptrdiff_t>(begin_),
            patch_.begin() + static_cast<std::ptrdiff_t>(end_), 0);
  std::int32_t patches = 0, best = 0, best_inliers = 0;
  for (std::size_t block = begin_; block < end_; ++block) {
    if (!owns(block) || patch_[block] != 0) continue;
    const std::int32_t inliers = flood(block, ++patches);
    if (inliers > best_inliers) {
      best = patches;
      best_inliers = inliers;
    }
  }
  for (std::size_t block = begin_; block < end_; ++block)
    if (patch_[block] != best) inliers_[block] = 0;
}

void PixelBlocks::judge() {
  state_.resize(points_.size());
  for (std::size_t block = begin_; block < end_; ++block)
    state_[block] = (owns(block) ? kOwned : 0) | (2 * inliers_[block] >= points_[block] ? kMostlyOwned : 0);
}

/// Numbers the owned blocks that hang together with `first`; returns their inliers.
std::int32_t PixelBlocks::flood(std::size_t first, std::int32_t patch) {
  std::int32_t inliers = 0;
  const std::size_t first_row = begin_ / columns_, end_row = end_ / columns_;
  open_.assign(1, first);
  patch_[first] = patch;
  while (!open_.empty()) {
    const std::size_t block = open_.back();
    open_.pop_back();
    inliers += inliers_[block];
    const std::size_t row = block / columns_, column = block % columns_;
    for (std::size_t r = row == first_row ? row : row - 1; r < std::min(row + 2, end_row); ++r)
      for (std::size_t c = column == 0 ? 0 : column - 1; c < std::min(column + 2, columns_); ++c) {
        const std::size_t next = r * columns_ + c;
        if (!owns(next) || patch_[next] != 0) continue;
        patch_[next] = patch;
        open_.push_back(next);
      }
  }
  return inliers;
}

}  // namespace floornav
