#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace floornav {

/// Sums over a window of two images: pixels known, difference, gradient and their products.
enum WindowSum { kKnown, kRest, kGradient, kProduct, kSquares, kRestSquares, kWindowSums };

/// What a row of pixels adds to them; each as long as the row.
struct ComparedRow {
  std::vector<float> known, rest, gradient;
};

/// Sums over the window's rows, of each column, with half a window of zeros on both sides.
using ColumnSums = std::array<std::vector<float>, kWindowSums>;

// Each of these works on one row; with vectors where the processor has them, to the same bits everywhere.

/// The four pixels from `right[x - 1]` on, in the word at x; 0 where they are not all in the row.
void pack_neighbours(const std::uint8_t* right, int columns, std::vector<std::int32_t>& packed);

/// Left minus warped right, and the gradient along the row, mean of both images. The right image's value and
/// rise come from the cubic through four pixels (Catmull-Rom). `disparity` px, 0: none.
void compare_row(const std::uint8_t* left, const std::vector<std::int32_t>& packed, const float* disparity,
                 ComparedRow& row);

/// Takes a row out of the sums and another one in.
void exchange_rows(const ComparedRow& out, const ComparedRow& in, ColumnSums& sums);

/// Least squares in windows of 2 `reach` + 1 columns: refined disparities and 1 sigma of each, px; infinite
/// where the window has no texture or the disparity has not settled.
void solve_row(const ColumnSums& sums, int reach, int columns, const float* disparity, float* refined,
               float* sigma);

}  // namespace floornav
