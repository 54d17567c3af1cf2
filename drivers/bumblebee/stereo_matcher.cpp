#include "drivers/bumblebee/stereo_matcher.hpp"

#include <algorithm>
#include <utility>

#include <opencv2/calib3d.hpp>

#include "drivers/bumblebee/edge_mask.hpp"
#include "drivers/bumblebee/smoothing_kernel.hpp"
#include "drivers/bumblebee/two_sizes.hpp"

namespace floornav {
namespace {

int shrink_of(const std::string& matcher, int width) {
  constexpr int kWide_px = 1024;
  if (matcher == "auto") return width >= kWide_px ? 4 : 2;
  return matcher == "quarter" ? 4 : matcher == "half" ? 2 : 1;
}

/// Calls piece(rows, worker) for bands of the rows.
template <class Piece>
void in_bands(cv::Range rows, Parallel& parallel, const Piece& piece) {
  constexpr int kBand = 64;  // rows of a piece of work
  parallel.run((rows.size() + kBand - 1) / kBand, [&](int band, int worker) {
    const int first = rows.start + band * kBand;
    piece(cv::Range(first, std::min(first + kBand, rows.end)), static_cast<std::size_t>(worker));
  });
}

/// Windows reach over the rows that are matched; there is nothing known there.
void clear_outside(cv::Range rows, cv::Mat1f& image) {
  image.rowRange(0, rows.start).setTo(0);
  image.rowRange(rows.end, image.rows).setTo(0);
}

}  // namespace

StereoMatcher::StereoMatcher(const StereoSettings& settings, const Pinhole& camera,
                             std::vector<RowSearch> search)
    : settings_(settings),
      size_(camera.width, camera.height),
      coarse_({settings.matcher == "block", shrink_of(settings.matcher, size_.width), settings.speckle_px},
              size_, search) {
  for (int shrink = 1; shrink <= shrink_of(settings.matcher, size_.width); shrink *= 2) {
    Level level;
    const auto shrunk = [shrink](cv::Range rows) {
      return cv::Range(rows.start / shrink, rows.end / shrink);
    };
    level.rows = shrunk(rows());
    level.seen_rows = shrunk(seen_rows());
    const cv::Size size = size_ / shrink;
    level.disparity.create(size);
    level.sigma.create(size);
    level.other.create(size);
    if (shrink > 1) level.left.create(size);
    if (shrink > 1) level.right.create(size);
    levels_.push_back(std::move(level));
  }
}

void StereoMatcher::match(const cv::Mat& left, const cv::Mat& right, Parallel& parallel,
                          DisparityImage& image) {
  refinements_.resize(static_cast<std::size_t>(parallel.workers()), DisparityRefinement(window()));
  levels_.front().left = left;
  levels_.front().right = right;
  for (std::size_t i = 1; i < levels_.size(); ++i) shrink(levels_[i - 1], parallel, levels_[i]);
  Level& smallest = levels_.back();
  coarse_.match(smallest.left, smallest.right, parallel, smallest.disparity);
  smooth(parallel, smallest);
  refine(parallel, smallest);
  for (std::size_t i = levels_.size() - 1; i-- > 0;) {
    enlarge_from(levels_[i + 1], parallel, levels_[i]);
    if (i > 0) smooth(parallel, levels_[i]);
    refine(parallel, levels_[i]);
  }
  if (levels_.size() == 1) {
    smooth(parallel, smallest);
    refine(parallel, smallest);
  }
  choose_pixels(parallel);
  image.width = size_.width;
  image.height = size_.height;
  image.pixels.assign(static_cast<std::size_t>(size_.area()), 0);
  image.uncertainty.assign(static_cast<std::size_t>(size_.area()), 0);
  in_bands(rows(), parallel, [&](cv::Range rows, std::size_t) { write(rows, image); });
}

void StereoMatcher::shrink(const Level& larger, Parallel& parallel, Level& level) {
  in_bands(level.seen_rows, parallel, [&](cv::Range rows, std::size_t) {
    halve(larger.left, rows, level.left);
    halve(larger.right, rows, level.right);
  });
}

void StereoMatcher::enlarge_from(const Level& smaller, Parallel& parallel, Level& level) {
  clear_outside(level.rows, level.disparity);
  in_bands(level.rows, parallel,
           [&](cv::Range rows, std::size_t) { enlarge(smaller.disparity, rows, level.disparity); });
}

cv::Size StereoMatcher::window() const {
  return {settings_.refinement_window_px | 1, settings_.refinement_rows_px | 1};
}

void StereoMatcher::smooth(Parallel& parallel, Level& level) {
  cv::swap(level.disparity, level.other);
  clear_outside(level.rows, level.disparity);
  in_bands(level.rows, parallel, [&](cv::Range rows, std::size_t) {
    smooth_disparities(level.other, window(), rows, level.disparity);
  });
}

/// One round over the rows of one size.
void StereoMatcher::refine(Parallel& parallel, Level& level) {
  cv::swap(level.disparity, level.other);
  clear_outside(level.rows, level.disparity);
  in_bands(level.rows, parallel, [&](cv::Range rows, std::size_t worker) {
    refinements_[worker].refine(level.left, level.right, level.other, rows, level.disparity, level.sigma);
  });
}

void StereoMatcher::choose_pixels(Parallel& parallel) {
  constexpr float kUnits = 16;  // of a pixel
  const auto most_sigma = static_cast<float>(settings_.max_sigma_px);
  const Level& whole = levels_.front();
  patches_.create(size_);
  in_bands(rows(), parallel, [&](cv::Range rows, std::size_t) {
    std::vector<std::uint8_t> edge(static_cast<std::size_t>(size_.width));
    for (int y = rows.start; y < rows.end; ++y) {
      const float* const disparity = whole.disparity[y];
      const float* const sigma = whole.sigma[y];
      short* const patch = patches_[y];
      mark_edges(whole.disparity, y, edge.data());
      for (int x = 0; x < size_.width; ++x) {
        const bool good = (sigma[x] <= most_sigma) & (edge[static_cast<std::size_t>(x)] == 0);
        patch[x] = static_cast<short>(good ? static_cast<int>(disparity[x] * kUnits) : 0);
      }
    }
  });
  cv::Mat matched = patches_.rowRange(rows());
  cv::filterSpeckles(matched, 0, settings_.speckle_px, kUnits);
}

void StereoMatcher::write(cv::Range rows, DisparityImage& image) const {
  constexpr float kMost = 65535;
  const Level& whole = levels_.front();
  for (int y = rows.start; y < rows.end; ++y) {
    const std::ptrdiff_t at = std::ptrdiff_t{y} * size_.width;
    std::uint16_t* const pixel = image.pixels.data() + at;
    std::uint8_t* const uncertainty = image.uncertainty.data() + at;
    const float* const disparity = whole.disparity[y];
    const float* const sigma = whole.sigma[y];
    const short* const patch = patches_[y];
    for (int x = 0; x < size_.width; ++x) {
      const float counts = disparity[x] * (1 / DisparityImage::kUnit_px) + 0.5F;
      const float told = std::min(sigma[x] * (1 / DisparityImage::kSigmaUnit_px) + 1.0F, 255.0F);
      const bool known = (patch[x] != 0) & (counts < kMost);
      pixel[x] = static_cast<std::uint16_t>(known ? static_cast<int>(counts) : 0);
      uncertainty[x] = static_cast<std::uint8_t>(known ? static_cast<int>(told) : 0);
    }
  }
}

}  // namespace floornav
