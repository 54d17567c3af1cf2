#include "drivers/bumblebee/disparity_refinement.hpp"

#include <cstddef>

namespace floornav {

void DisparityRefinement::begin(int columns) {
  const auto wide = static_cast<std::size_t>(columns);
  ring_.resize(static_cast<std::size_t>(2 * reach_.height + 2));
  for (ComparedRow& row : ring_)
    for (auto* values : {&row.known, &row.rest, &row.gradient}) values->assign(wide, 0.0F);
  for (auto& sums : sums_) sums.assign(wide + 2 * static_cast<std::size_t>(reach_.width), 0.0F);
}

void DisparityRefinement::refine(const cv::Mat1b& left, const cv::Mat1b& right, const cv::Mat1f& disparity,
                                 cv::Range rows, cv::Mat1f& refined, cv::Mat1f& sigma) {
  const int columns = left.cols;
  begin(columns);
  std::size_t place = 0;
  for (int y = rows.start - reach_.height; y < rows.end + reach_.height; ++y) {
    ComparedRow& row = ring_[place];
    place = (place + 1) % ring_.size();
    if (y >= 0 && y < left.rows) {
      pack_neighbours(right[y], columns, packed_);
      compare_row(left[y], packed_, disparity[y], row);
    } else {
      for (auto* values : {&row.known, &row.rest, &row.gradient})
        values->assign(static_cast<std::size_t>(columns), 0.0F);
    }
    exchange_rows(ring_[place], row, sums_);
    const int middle = y - reach_.height;
    if (middle >= rows.start)
      solve_row(sums_, reach_.width, columns, disparity[middle], refined[middle], sigma[middle]);
  }
}

}  // namespace floornav
