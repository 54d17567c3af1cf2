#include "drivers/bumblebee/stereo_pipeline.hpp"

#include <algorithm>
#include <utility>

namespace floornav {

StereoPipeline::StereoPipeline(const StereoSettings& settings, Rectification rectification,
                               std::vector<RowSearch> search)
    : rectification_(std::move(rectification)),
      matcher_(settings, rectification_.camera(), std::move(search)) {}

void StereoPipeline::match(const cv::Mat& raw_left, const cv::Mat& raw_right, Parallel& parallel,
                           DisparityImage& image) {
  rectify(raw_left, raw_right, parallel);
  matcher_.match(left_, right_, parallel, image);
}

void StereoPipeline::rectify(const cv::Mat& raw_left, const cv::Mat& raw_right, Parallel& parallel) {
  constexpr int kBand = 64;  // rows: about a millisecond of work
  rectification_.prepare(raw_left, raw_right, left_, right_);
  const cv::Range rows = matcher_.seen_rows();
  parallel.run((rows.size() + kBand - 1) / kBand, [&](int band, int) {
    const int first = rows.start + band * kBand;
    rectification_.apply_rows(raw_left, raw_right, {first, std::min(first + kBand, rows.end)}, left_, right_);
  });
}

}  // namespace floornav
