#pragma once

#include <cstdint>

#include <opencv2/core.hpp>

namespace floornav {

/// Where a surface ends or is folded, a window holds two of them and its disparity is neither's: a box seems
/// higher than it is. Writes 1 to `edge` for each pixel of row `y` beside which disparities (px; 0: none) do
/// not lie on one plane, 0 for the others and where too little is known.
void mark_edges(const cv::Mat1f& disparity, int y, std::uint8_t* edge);

}  // namespace floornav
