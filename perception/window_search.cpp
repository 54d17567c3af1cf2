#include "perception/window_search.hpp"

#include <algorithm>
#include <functional>

#include "perception/window_kernel.hpp"

namespace floornav {

namespace {

constexpr int kPixelsPerPiece = 8192;
/// Beyond it the kd-tree is faster.
constexpr int kMaxWindow_pixels = 1 << 14;

}  // namespace

bool WindowSearch::mean_distances(const ImagePoints& cloud, int neighbors, Parallel& parallel,
                                  std::span<float> mean_m) {
  left_.clear();
  if (cloud.points.size() <= static_cast<std::size_t>(neighbors) || neighbors > kMaxNeighbors) return false;
  if (!image_.lay_out(cloud)) return false;
  mean_m_.resize(std::max(mean_m_.size(), image_.size()));
  const int rows = std::max(kPixelsPerPiece / image_.width(), 1);
  const int bands = (image_.height() + rows - 1) / rows;
  const auto end_of = [&](int band) { return std::min((band + 1) * rows, image_.height()); };

  filled_.assign(static_cast<std::size_t>(bands), 0);
  const auto fill = [&](int band, int) {
    filled_[static_cast<std::size_t>(band)] = image_.fill_rows(cloud, band * rows, end_of(band)) ? 1 : 0;
  };
  parallel.run(bands, std::ref(fill));
  if (std::find(filled_.begin(), filled_.end(), 0) != filled_.end()) return false;
  const auto search = [&](int band, int) {
    search_windows(image_, neighbors, band * rows, end_of(band), mean_m_);
    finish_rows(cloud, neighbors, band * rows, end_of(band), mean_m);
  };
  parallel.run(bands, std::ref(search));
  for (std::size_t i = 0; i < mean_m.size(); ++i)
    if (mean_m[i] < 0.0F) left_.push_back(static_cast<std::int32_t>(i));
  mean_neighbor_distances(cloud.points, neighbors, left_, parallel, mean_m);
  return true;
}

/// Brings the means from the image to the points, and looks farther where the first window was too small.
void WindowSearch::finish_rows(const ImagePoints& cloud, int neighbors, int first_row, int end_row,
                               std::span<float> mean_m) {
  for (int row = first_row; row < end_row; ++row)
    for (std::int32_t p = image_.row_begin(row); p < image_.row_begin(row + 1); ++p) {
      const auto i = static_cast<std::size_t>(p);
      const int column = image_.column_of(cloud.pixel[i], row);
      const float mean = mean_m_[static_cast<std::size_t>(image_.at(row, column))];
      mean_m[i] =
          mean >= 0.0F ? mean : search_wider(image_, neighbors, row, column, -mean, kMaxWindow_pixels);
    }
}

}  // namespace floornav
