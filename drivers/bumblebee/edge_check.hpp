#pragma once

#include <opencv2/core.hpp>

namespace floornav {

/// Beside an edge, windows that hold both surfaces give the nearer one's disparity to pixels of the farther
/// one. Those are told by the images: the disparity of the other side explains a small window around them
/// better. They lose theirs.
///
/// `left`, `right`: rectified, 8 bit; some rows of `disparity` (px; 0 = none) go to `checked`. Bands of rows
/// are independent work.
void check_edges(const cv::Mat1b& left, const cv::Mat1b& right, const cv::Mat1f& disparity, cv::Range rows,
                 cv::Mat1f& checked);

}  // namespace floornav
