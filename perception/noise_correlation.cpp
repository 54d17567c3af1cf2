#include "perception/noise_correlation.hpp"

#include <algorithm>
#include <functional>

namespace floornav {

namespace {

constexpr std::int32_t kIndependent_px = 20;  ///< from here on pixels are taken to be independent
constexpr std::int32_t kStride = 32;          ///< every n-th point begins pairs
constexpr std::int64_t kLeastPairs = 1000;    ///< at each distance
constexpr double kLeastCorrelation = 0.05;    ///< less is the accident of this frame

}  // namespace

void NoiseCorrelation::PairSums::add(const RoiCloud& cloud, std::span<const std::int16_t> label,
                                     const InverseDepthPlane& floor, std::int32_t begin, std::int32_t end) {
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
      square[static_cast<std::size_t>(distance)] += difference * difference;
      ++pairs[static_cast<std::size_t>(distance)];
    }
  }
}

void NoiseCorrelation::PairSums::add(const PairSums& more) {
  for (std::size_t distance = 0; distance < pairs.size(); ++distance) {
    square[distance] += more.square[distance];
    pairs[distance] += more.pairs[distance];
  }
}

bool NoiseCorrelation::PairSums::are_enough() const {
  return std::all_of(pairs.begin() + 1, pairs.end(), [](std::int64_t n) { return n >= kLeastPairs; });
}

void NoiseCorrelation::measure(int first, int end, const RoiCloud& cloud, std::span<const std::int16_t> label,
                               std::span<const SectionResult> sections, Parallel& parallel) {
  sections_.resize(static_cast<std::size_t>(end));
  const auto measure_one = [&](int index, int) {
    const auto s = static_cast<std::size_t>(first + index);
    const auto& planes = sections[s].planes;
    if (planes.empty() || !planes.front().dominant) return;
    sections_[s].add(cloud, label, planes.front().plane, cloud.section_begin(first + index),
                     cloud.section_end[s]);
  };
  parallel.run(end - first, std::ref(measure_one));
}

float NoiseCorrelation::alike_px() const {
  PairSums sums;
  for (const PairSums& section : sections_) sums.add(section);
  if (!sums.are_enough()) return 1.0F;
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
