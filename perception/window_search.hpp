#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "perception/window_image.hpp"
#include "runtime/geometry/parallel.hpp"

namespace floornav {

/// The nearest neighbours of an image's points by way of the image. A ball around a point projects into a
/// bounded window of pixels, so that the window that holds the neighbours is proved to hold them all. The
/// result is that of mean_neighbor_distances, bit for bit; where a window grows too large that one is asked.
class WindowSearch {
 public:
  /// Mean distance of each point to its `neighbors` nearest others. False, and `mean_m` is not to be used,
  /// for points that are not on the rays of ascending pixels, or not more than `neighbors`.
  bool mean_distances(const ImagePoints& cloud, int neighbors, Parallel& parallel, std::span<float> mean_m);

  /// Points that went to the kd-tree in the last search.
  [[nodiscard]] std::size_t left_to_tree() const { return left_.size(); }

 private:
  void finish_rows(const ImagePoints& cloud, int neighbors, int first_row, int end_row,
                   std::span<float> mean_m);

  WindowImage image_;
  std::vector<float> mean_m_;         ///< a place of the image
  std::vector<std::int32_t> left_;    ///< points that the kd-tree must decide
  std::vector<std::uint8_t> filled_;  ///< a band of rows: each point is on its ray
};

}  // namespace floornav
