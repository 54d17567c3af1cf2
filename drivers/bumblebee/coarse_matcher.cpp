#include "drivers/bumblebee/coarse_matcher.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace floornav {
namespace {

constexpr int kUnits = 16;          ///< of OpenCV's matchers, a pixel
constexpr int kDisparityStep = 16;  ///< their search ranges are multiples of it
constexpr short kNone = 0;

cv::Ptr<cv::StereoMatcher> semi_global(int least, int count) {
  constexpr int kBlock = 5;
  constexpr int kSmallJump = 8 * kBlock * kBlock;
  constexpr int kLargeJump = 32 * kBlock * kBlock;
  constexpr int kMostLeftRight_px = 1;
  constexpr int kPreFilterCap = 31;
  constexpr int kUniqueness_percent = 10;
  return cv::StereoSGBM::create(least, count, kBlock, kSmallJump, kLargeJump, kMostLeftRight_px,
                                kPreFilterCap, kUniqueness_percent, 0, 0, cv::StereoSGBM::MODE_SGBM_3WAY);
}

cv::Ptr<cv::StereoMatcher> block(int least, int count) {
  constexpr int kBlock = 15;
  const cv::Ptr<cv::StereoBM> matcher = cv::StereoBM::create(count, kBlock);
  matcher->setMinDisparity(least);
  matcher->setDisp12MaxDiff(1);
  return matcher;
}

}  // namespace

CoarseMatcher::CoarseMatcher(const Method& method, cv::Size size, const std::vector<RowSearch>& search)
    : method_(method), size_(size.width / method.shrink, size.height / method.shrink) {
  const int band_rows =
      192 / method.shrink;  // thinner ones search less: what is behind the region finds no place
  for (int first = 0; first < size_.height; first += band_rows) {
    const cv::Range rows(first, std::min(first + band_rows, size_.height));
    RowSearch all;
    for (int y = rows.start * method.shrink; y < rows.end * method.shrink; ++y)
      all.add(search.at(static_cast<std::size_t>(y)));
    if (!all.empty()) add_band(rows, all);
  }
}

void CoarseMatcher::add_band(cv::Range rows, const RowSearch& search) {
  constexpr int kAround = 8;  // rows of the block, and of paths that come from above
  const auto shrink = static_cast<float>(method_.shrink);
  Band band;
  band.rows = rows;
  band.seen = {std::max(0, rows.start - kAround), std::min(size_.height, rows.end + kAround)};
  band.least = std::max(0, static_cast<int>(std::floor(search.least_px / shrink)) - 1);
  const int most = static_cast<int>(std::ceil(search.most_px / shrink)) + 1;
  band.count = (most - band.least + kDisparityStep) / kDisparityStep * kDisparityStep;
  if (band.least + band.count >= size_.width)
    throw std::runtime_error(fmt::format("nearest_m asks for {} px of disparity, the image is {} px wide",
                                         method_.shrink * (band.least + band.count),
                                         method_.shrink * size_.width));
  band.matcher = method_.block ? block(band.least, band.count) : semi_global(band.least, band.count);
  bands_.push_back(std::move(band));
}

cv::Range CoarseMatcher::rows() const {
  if (bands_.empty()) return {0, 0};
  return {bands_.front().rows.start * method_.shrink, bands_.back().rows.end * method_.shrink};
}

cv::Range CoarseMatcher::seen_rows() const {
  if (bands_.empty()) return {0, 0};
  return {bands_.front().seen.start * method_.shrink, bands_.back().seen.end * method_.shrink};
}

/// The images get a margin at the left: OpenCV finds nothing in the first columns, as many as the largest
/// disparity, though the other eye sees all from the least one on.
void CoarseMatcher::match_band(const cv::Mat1b& left, const cv::Mat1b& right, Band& band) {
  const auto with_margin = [&](const cv::Mat1b& from, cv::Mat& to) {
    cv::copyMakeBorder(from.rowRange(band.seen), to, 0, 0, band.count, 0, cv::BORDER_REPLICATE);
  };
  with_margin(left, band.left);
  with_margin(right, band.right);
  band.matcher->compute(band.left, band.right, band.found);
  const cv::Range inner(band.rows.start - band.seen.start, band.rows.end - band.seen.start);
  const cv::Mat part = band.found(inner, {band.count, band.found.cols});
  cv::Mat to = found_.rowRange(band.rows);
  part.copyTo(to);
  const auto least = static_cast<short>(band.least * kUnits);
  for (int y = band.rows.start; y < band.rows.end; ++y) {
    short* const row = found_[y];
    for (int x = 0; x < found_.cols; ++x) row[x] = row[x] < least || row[x] > x * kUnits ? kNone : row[x];
  }
}

void CoarseMatcher::match(const cv::Mat1b& left, const cv::Mat1b& right, Parallel& parallel,
                          cv::Mat1f& disparity) {
  disparity.create(size_);
  found_.create(size_);
  found_.setTo(kNone);
  parallel.run(static_cast<int>(bands_.size()),
               [&](int i, int) { match_band(left, right, bands_[static_cast<std::size_t>(i)]); });
  cv::filterSpeckles(found_, kNone, method_.speckle_px / (method_.shrink * method_.shrink), kUnits);
  found_.convertTo(disparity, CV_32F, 1.0 / kUnits);
}

}  // namespace floornav
