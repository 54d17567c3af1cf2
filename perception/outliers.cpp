#include "perception/outliers.hpp"

#include <array>
#include <cmath>

namespace floornav {

namespace {

/// Up to so many points are compared with each other faster than an image is filled.
constexpr std::size_t kFewPoints = 64;

/// In four streams: one sum waits for itself at every step.
template <class Value>
double sum_over(const std::vector<float>& values, Value value) {
  std::array<double, 4> sums{};
  std::size_t i = 0;
  for (; i + sums.size() <= values.size(); i += sums.size())
    for (std::size_t k = 0; k < sums.size(); ++k) sums[k] += value(static_cast<double>(values[i + k]));
  for (; i < values.size(); ++i) sums[0] += value(static_cast<double>(values[i]));
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

}  // namespace

std::int64_t OutlierRemover::remove(const ImagePoints& cloud, Parallel& parallel,
                                    std::span<std::uint8_t> keep) {
  if (cloud.points.size() == 0) return 0;
  find_mean_distances(cloud, parallel);

  const auto count = static_cast<double>(cloud.points.size());
  const double mu_global = sum_over(mean_m_, [](double mean) { return mean; }) / count;
  const double squares =
      sum_over(mean_m_, [mu_global](double mean) { return (mean - mu_global) * (mean - mu_global); });
  const double limit = settings_.epsilon * std::sqrt(squares / count);

  std::int64_t outliers = 0;
  for (std::size_t i = 0; i < mean_m_.size(); ++i) {
    const bool outlier = std::abs(static_cast<double>(mean_m_[i]) - mu_global) > limit;
    keep[i] = outlier ? 0 : 1;
    outliers += outlier ? 1 : 0;
  }
  return outliers;
}

void OutlierRemover::find_mean_distances(const ImagePoints& cloud, Parallel& parallel) {
  mean_m_.resize(cloud.points.size());
  if (settings_.search == "auto" && cloud.points.size() <= kFewPoints) {
    mean_distances_of_few(cloud.points, settings_.neighbors, mean_m_);
    return;
  }
  const bool by_window = settings_.search != "nanoflann";
  if (by_window && window_.mean_distances(cloud, settings_.neighbors, parallel, mean_m_)) return;
  mean_neighbor_distances(cloud.points, settings_.neighbors, parallel, mean_m_);
}

}  // namespace floornav
