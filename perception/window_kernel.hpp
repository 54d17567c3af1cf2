#pragma once

#include <span>

#include "perception/window_image.hpp"

namespace floornav {

/// For each pixel of some rows that holds a point, writes to `mean_m` (as large as the image's planes) the
/// mean distance to its `neighbors` nearest others: exact where the window of WindowImage::kMaxHalf_px proves
/// that none of them is outside. Elsewhere the value is negative: minus a distance within which there are
/// that many, or minus something absurd where the window holds fewer.
void search_windows(const WindowImage& image, int neighbors, int first_row, int end_row,
                    std::span<float> mean_m);

/// Mean distance of the point at a pixel to its `neighbors` nearest others of a larger window, which
/// `radius_m` sizes: within it there are that many. Negative as above where the window would hold more pixels
/// than `max_pixels`.
float search_wider(const WindowImage& image, int neighbors, int row, int column, float radius_m,
                   int max_pixels);

}  // namespace floornav
