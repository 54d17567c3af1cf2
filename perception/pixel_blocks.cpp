#include "perception/pixel_blocks.hpp"

#include <algorithm>
#include <cmath>

namespace floornav {

void PixelBlocks::reset(const Pinhole& camera) {
  width_ = camera.width;
  per_row_ = (camera.width + kSide_px - 1) / kSide_px;
  const std::int32_t rows = (camera.height + kSide_px - 1) / kSide_px;
  points_.assign(static_cast<std::size_t>(per_row_) * static_cast<std::size_t>(rows), 0);
  inliers_.assign(points_.size(), 0);
}

void PixelBlocks::count(const PlanePool& pool, const std::vector<std::int32_t>& pixel,
                        const InverseDepthPlane& plane, float threshold_sigmas) {
  std::fill(inliers_.begin(), inliers_.end(), 0);
  for (std::size_t i = 0; i < pool.size(); ++i)
    if (std::abs(pool.residual(i, plane)) <= threshold_sigmas)
      ++inliers_[block_of(pixel[static_cast<std::size_t>(pool.point[i])])];
}

void PixelBlocks::keep_largest_patch() {
  patch_.assign(inliers_.size(), 0);
  std::int32_t patches = 0, best = 0, best_inliers = 0;
  for (std::size_t block = 0; block < inliers_.size(); ++block) {
    if (!owns(block) || patch_[block] != 0) continue;
    const std::int32_t inliers = flood(block, ++patches);
    if (inliers > best_inliers) {
      best = patches;
      best_inliers = inliers;
    }
  }
  for (std::size_t block = 0; block < inliers_.size(); ++block)
    if (patch_[block] != best) inliers_[block] = 0;
}

/// Numbers the owned blocks that hang together with `first`; returns their inliers.
std::int32_t PixelBlocks::flood(std::size_t first, std::int32_t patch) {
  std::int32_t inliers = 0;
  const auto columns = static_cast<std::size_t>(per_row_);
  const std::size_t rows = inliers_.size() / columns;
  open_.assign(1, first);
  patch_[first] = patch;
  while (!open_.empty()) {
    const std::size_t block = open_.back();
    open_.pop_back();
    inliers += inliers_[block];
    const std::size_t row = block / columns, column = block % columns;
    for (std::size_t r = row == 0 ? 0 : row - 1; r <= std::min(row + 1, rows - 1); ++r)
      for (std::size_t c = column == 0 ? 0 : column - 1; c <= std::min(column + 1, columns - 1); ++c) {
        const std::size_t next = r * columns + c;
        if (!owns(next) || patch_[next] != 0) continue;
        patch_[next] = patch;
        open_.push_back(next);
      }
  }
  return inliers;
}

}  // namespace floornav
