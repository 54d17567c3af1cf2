#include "perception/outliers.hpp"

#include <cmath>

namespace floornav {

namespace {

/// Up to so many points are compared with each other faster than an image is filled.
constexpr std::size_t kFewPoints = 64;

}  // namespace

std::int64_t OutlierRemover::remove(const ImagePoints& cloud, Parallel& parallel,
                                    std::span<std::uint8_t> keep) {
  if (cloud.points.size() == 0) return 0;
  find_mean_distances(cloud, parallel);

  const auto count = static_cast<double>(cloud.points.size());
  double sum = 0.0;
  for (const float mean : mean_m_) sum += static_cast<double>(mean);
  const double mu_global = sum / count;
  double squares = 0.0;
  for (const float mean : mean_m_) {
    const double difference = static_cast<double>(mean) - mu_global;
    squares += difference * difference;
  }
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
