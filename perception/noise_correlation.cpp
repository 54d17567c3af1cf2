#include "perception/noise_correlation.hpp"

#include <array>
#include <cmath>

namespace floornav {

namespace {

constexpr std::int32_t kFarthest_px = 32;
constexpr std::int32_t kIndependent_px = 20;  ///< from here on pixels are taken to be independent
constexpr std::int32_t kStride = 32;          ///< every n-th point begins pairs
constexpr std::int64_t kLeastPairs = 1000;    ///< at each distance
constexpr double kLeastCorrelation = 0.05;    ///< less is the accident of this frame

/// Sums over pairs of pixels of a row, by their distance.
class PairSums {
 public:
  void add(const RoiCloud& cloud, std::span<const std::int16_t> label, const InverseDepthPlane& floor,
           std::int32_t begin, std::int32_t end) {
    const auto off_plane = [&](std::size_t i) {
      return (cloud.inverse_depth[i] - floor.inverse_depth(cloud.ray_x[i], cloud.ray_y[i])) *
             cloud.certainty[i];
    };
    for (std::int32_t p = begin; p < end; p += kStride) {
      const auto first = static_cast<std::size_t>(p);
      if (label[first] != 0) continue;
      const float here = off_plane(first);
      for (std::size_t second = first + 1; second < static_cast<std::size_t>(end); ++second) {
        const std::int32_t distance = cloud.pixel[second] - cloud.pixel[first];
        if (distance > kFarthest_px) break;
        if (label[second] != 0) continue;
        const double difference = static_cast<double>(off_plane(second) - here);
        square_[static_cast<std::size_t>(distance)] += difference * difference;
        ++pairs_[static_cast<std::size_t>(distance)];
      }
    }
  }

  [[nodiscard]] double mean_square(std::size_t distance) const {
    return square_[distance] / static_cast<double>(pairs_[distance]);
  }
  [[nodiscard]] bool enough() const {
    for (std::size_t distance = 1; distance < pairs_.size(); ++distance)
      if (pairs_[distance] < kLeastPairs) return false;
    return true;
  }

 private:
  std::array<double, kFarthest_px + 1> square_{};
  std::array<std::int64_t, kFarthest_px + 1> pairs_{};
};

}  // namespace

float alike_length_px(const RoiCloud& cloud, std::span<const std::int16_t> label,
                      std::span<const SectionResult> sections) {
  PairSums sums;
  for (std::size_t s = 0; s < sections.size(); ++s) {
    const auto& planes = sections[s].planes;
    if (planes.empty() || !planes.front().dominant) continue;
    const auto section = static_cast<int>(s);
    sums.add(cloud, label, planes.front().plane, cloud.section_begin(section), cloud.section_end[s]);
  }
  if (!sums.enough()) return 1.0F;
  double independent = 0.0;
  for (std::size_t k = kIndependent_px; k <= kFarthest_px; ++k) independent += sums.mean_square(k);
  independent /= kFarthest_px - kIndependent_px + 1;
  double alike_px = 1.0;
  for (std::size_t k = 1; k < kIndependent_px; ++k) {
    const double correlation = 1.0 - sums.mean_square(k) / independent;
    if (!(correlation > kLeastCorrelation)) break;
    alike_px += 2.0 * correlation;
  }
  return static_cast<float>(alike_px);
}

}  // namespace floornav
