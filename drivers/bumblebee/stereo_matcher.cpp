#include "drivers/bumblebee/stereo_matcher.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

namespace floornav {
namespace {

constexpr int kCoarseUnits = 16;    ///< of OpenCV's matchers, a pixel
constexpr int kDisparityStep = 16;  ///< their search ranges are multiples of it

cv::Ptr<cv::StereoMatcher> semi_global(int disparities) {
  constexpr int kBlock = 5;
  constexpr int kSmallJump = 8 * kBlock * kBlock;
  constexpr int kLargeJump = 32 * kBlock * kBlock;
  constexpr int kMostLeftRight_px = 1;
  constexpr int kPreFilterCap = 31;
  constexpr int kUniqueness_percent = 10;
  return cv::StereoSGBM::create(0, disparities, kBlock, kSmallJump, kLargeJump, kMostLeftRight_px,
                                kPreFilterCap, kUniqueness_percent, 0, 0, cv::StereoSGBM::MODE_SGBM_3WAY);
}

cv::Ptr<cv::StereoMatcher> block(int disparities) {
  constexpr int kBlock = 15;
  const cv::Ptr<cv::StereoBM> matcher = cv::StereoBM::create(disparities, kBlock);
  matcher->setDisp12MaxDiff(1);
  return matcher;
}

}  // namespace

StereoMatcher::StereoMatcher(const StereoSettings& settings, const Pinhole& camera, double baseline_m)
    : settings_(settings),
      shrink_(settings.matcher == "half" ? 2 : 1),
      refinement_(settings.refinement_window_px | 1) {
  const double most_px = camera.fx * baseline_m / settings.nearest_m / shrink_;
  const int disparities = kDisparityStep * static_cast<int>(std::ceil((most_px + 1) / kDisparityStep));
  if (disparities * shrink_ >= camera.width)
    throw std::runtime_error(
        fmt::format("nearest_m {} m asks for {} px of disparity, the image is {} px wide", settings.nearest_m,
                    disparities * shrink_, camera.width));
  coarse_matcher_ = settings.matcher == "block" ? block(disparities) : semi_global(disparities);
}

void StereoMatcher::match_coarsely(const cv::Mat& left, const cv::Mat& right) {
  if (shrink_ == 1) {
    coarse_matcher_->compute(left, right, coarse_);
  } else {
    const double scale = 1.0 / shrink_;
    cv::resize(left, small_left_, {}, scale, scale, cv::INTER_AREA);
    cv::resize(right, small_right_, {}, scale, scale, cv::INTER_AREA);
    coarse_matcher_->compute(small_left_, small_right_, coarse_);
  }
  constexpr int kSpeckleRange = kCoarseUnits;
  cv::filterSpeckles(coarse_, -kCoarseUnits, settings_.speckle_px / (shrink_ * shrink_), kSpeckleRange);
}

void StereoMatcher::match(const cv::Mat& left, const cv::Mat& right, DisparityImage& image) {
  match_coarsely(left, right);
  disparity_.create(left.size());
  for (int y = 0; y < left.rows; ++y) {
    const auto* const row = coarse_.ptr<std::int16_t>(std::min(y / shrink_, coarse_.rows - 1));
    for (int x = 0; x < left.cols; ++x) {
      const std::int16_t coarse = row[std::min(x / shrink_, coarse_.cols - 1)];
      disparity_(y, x) =
          coarse > 0 ? static_cast<float>(coarse) * static_cast<float>(shrink_) / kCoarseUnits : 0.0F;
    }
  }
  left.convertTo(left_, CV_32F);
  right.convertTo(right_, CV_32F);
  refinement_.refine(left_, right_, disparity_, sigma_);
  write(image);
}

void StereoMatcher::write(DisparityImage& image) const {
  image.width = disparity_.cols;
  image.height = disparity_.rows;
  image.pixels.assign(disparity_.total(), 0);
  image.uncertainty.assign(disparity_.total(), 0);
  const auto most_sigma = static_cast<float>(settings_.max_sigma_px);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const float disparity = disparity_.ptr<float>()[i];
    const float sigma = sigma_.ptr<float>()[i];
    if (!(sigma <= most_sigma)) continue;
    const float counts = std::round(disparity / DisparityImage::kUnit_px);
    if (counts < 1 || counts > 65535) continue;
    image.pixels[i] = static_cast<std::uint16_t>(counts);
    image.uncertainty[i] =
        static_cast<std::uint8_t>(std::clamp(std::ceil(sigma / DisparityImage::kSigmaUnit_px), 1.0F, 255.0F));
  }
}

}  // namespace floornav
