#include "drivers/bumblebee/stereo_matcher.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace floornav {
namespace {

constexpr int kBand = 64;  ///< rows of a piece of work

CoarseMatcher::Method method_of(const StereoSettings& settings) {
  return {settings.matcher == "block", settings.matcher == "half" ? 2 : 1, settings.speckle_px};
}

/// Calls piece(rows, worker) for bands of the rows.
template <class Piece>
void in_bands(cv::Range rows, Parallel& parallel, const Piece& piece) {
  parallel.run((rows.size() + kBand - 1) / kBand, [&](int band, int worker) {
    const int first = rows.start + band * kBand;
    piece(cv::Range(first, std::min(first + kBand, rows.end)), static_cast<std::size_t>(worker));
  });
}

/// Bilinear between four disparities of one surface, else the nearest one.
float between(const cv::Mat1f& small, int x, int y, bool right, bool below) {
  const float nearest = small(y, x);
  const int x2 = std::clamp(right ? x + 1 : x - 1, 0, small.cols - 1);
  const int y2 = std::clamp(below ? y + 1 : y - 1, 0, small.rows - 1);
  constexpr float kSameSurface_px = 1.0F;
  const float a = small(y, x2);
  const float b = small(y2, x);
  const float c = small(y2, x2);
  const auto same = [nearest](float d) { return d > 0 && std::abs(d - nearest) < kSameSurface_px; };
  if (!same(a) || !same(b) || !same(c)) return nearest;
  return 0.5625F * nearest + 0.1875F * (a + b) + 0.0625F * c;
}

}  // namespace

StereoMatcher::StereoMatcher(const StereoSettings& settings, const Pinhole& camera,
                             std::vector<RowSearch> search)
    : settings_(settings), size_(camera.width, camera.height), coarse_(method_of(settings), size_, search) {
  rows_ = coarse_.rows();
}

cv::Range StereoMatcher::seen_rows() const {
  return coarse_.seen_rows();
}

void StereoMatcher::match(const cv::Mat& left, const cv::Mat& right, Parallel& parallel,
                          DisparityImage& image) {
  const int window = settings_.refinement_window_px | 1;
  workers_.resize(static_cast<std::size_t>(parallel.workers()),
                  {DisparitySmoothing(window), DisparityRefinement(window)});
  coarse_.match(left, right, parallel);
  const bool half = settings_.matcher == "half";
  refine(coarse_.left(), coarse_.right(), true, parallel, coarse_.disparity());
  if (half) {
    disparity_.create(size_);
    in_bands(rows_, parallel, [&](cv::Range rows, std::size_t) { enlarge(rows); });
    refine(left, right, false, parallel, disparity_);
  } else {
    disparity_ = coarse_.disparity();
    refine(left, right, true, parallel, disparity_);
  }
  image.width = size_.width;
  image.height = size_.height;
  image.pixels.assign(static_cast<std::size_t>(size_.area()), 0);
  image.uncertainty.assign(static_cast<std::size_t>(size_.area()), 0);
  in_bands(rows_, parallel, [&](cv::Range rows, std::size_t) { write(rows, image); });
}

/// One round over the rows of an image that is matched.
void StereoMatcher::refine(const cv::Mat1b& left, const cv::Mat1b& right, bool smooth, Parallel& parallel,
                           cv::Mat1f& disparity) {
  const int shrink = size_.height / disparity.rows;
  const cv::Range rows(rows_.start / shrink, rows_.end / shrink);
  smooth_.create(disparity.size());
  sigma_.create(disparity.size());
  if (smooth) {
    in_bands(rows, parallel, [&](cv::Range band, std::size_t worker) {
      workers_[worker].smoothing.apply(disparity, band, smooth_);
    });
  } else {
    cv::swap(smooth_, disparity);
  }
  disparity.create(smooth_.size());
  in_bands(rows, parallel, [&](cv::Range band, std::size_t worker) {
    workers_[worker].refinement.refine(left, right, smooth_, band, disparity, sigma_);
  });
}

/// The refined disparities of the small images, at the whole ones' size.
void StereoMatcher::enlarge(cv::Range rows) {
  const cv::Mat1f& small = coarse_.disparity();
  for (int y = rows.start; y < rows.end; ++y)
    for (int x = 0; x < size_.width; ++x) {
      const int sx = std::min(x / 2, small.cols - 1);
      const int sy = std::min(y / 2, small.rows - 1);
      disparity_(y, x) = 2 * between(small, sx, sy, (x & 1) != 0, (y & 1) != 0);
    }
}

void StereoMatcher::write(cv::Range rows, DisparityImage& image) const {
  const auto most_sigma = static_cast<float>(settings_.max_sigma_px);
  for (int y = rows.start; y < rows.end; ++y)
    for (int x = 0; x < size_.width; ++x) {
      const float sigma = sigma_(y, x);
      const float counts = std::round(disparity_(y, x) / DisparityImage::kUnit_px);
      if (!(sigma <= most_sigma) || counts < 1 || counts > 65535) continue;
      const auto i =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(size_.width) + static_cast<std::size_t>(x);
      image.pixels[i] = static_cast<std::uint16_t>(counts);
      image.uncertainty[i] = static_cast<std::uint8_t>(
          std::clamp(std::ceil(sigma / DisparityImage::kSigmaUnit_px), 1.0F, 255.0F));
    }
}

}  // namespace floornav
