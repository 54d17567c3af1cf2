#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "perception/roi_cloud.hpp"
#include "perception/section_result.hpp"
#include "runtime/geometry/parallel.hpp"

namespace floornav {

/// Measures over how many pixels, each way, a frame's noise is alike. Told by the frame's own floor: half the
/// mean squared difference of what two pixels of a row are off their plane grows with their distance up to
/// where they are independent. Rows are taken to speak for columns too.
class NoiseCorrelation {
 public:
  /// Begins a frame.
  void clear() { sections_.clear(); }
  /// Adds what the sections [first, end) show; they come in order.
  void measure(int first, int end, const RoiCloud& cloud, std::span<const std::int16_t> label,
               std::span<const SectionResult> sections, Parallel& parallel);
  /// 1 where pixels are independent, or where too little floor was seen; about n where depth comes out of
  /// matching windows of n x n pixels.
  [[nodiscard]] float alike_px() const;

 private:
  static constexpr std::int32_t kFarthest_px = 32;

  /// Sums over pairs of pixels of a row, by their distance.
  struct PairSums {
    std::array<double, kFarthest_px + 1> square{};
    std::array<std::int64_t, kFarthest_px + 1> pairs{};

    void add(const RoiCloud& cloud, std::span<const std::int16_t> label, const InverseDepthPlane& floor,
             std::int32_t begin, std::int32_t end);
    void add(const PairSums& more);
    [[nodiscard]] double mean_square(std::size_t distance) const {
      return square[distance] / static_cast<double>(pairs[distance]);
    }
    [[nodiscard]] bool are_enough() const;
  };

  std::vector<PairSums> sections_;
};

/// How many independent measurements the points of a patch are that is `width_px` wide in the image, where
/// the noise is alike over `alike_px`.
inline float independent_measurements(std::int32_t points, float width_px, float alike_px) {
  const auto n = static_cast<float>(points);
  const float columns = std::max(1.0F, width_px / alike_px);
  const float rows = std::max(1.0F, n / (width_px * alike_px));
  return std::min(n, columns * rows);
}

}  // namespace floornav
