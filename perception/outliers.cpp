#include "perception/outliers.hpp"

#include <cmath>

namespace floornav {

std::int64_t remove_outliers(const PointsView& points, const OutlierSettings& settings, Parallel& parallel,
                             std::vector<float>& mean_m, std::span<std::uint8_t> keep) {
  if (points.size() == 0) return 0;
  mean_m.resize(points.size());
  mean_neighbor_distances(points, settings.neighbors, parallel, mean_m);

  const auto count = static_cast<double>(points.size());
  double sum = 0.0;
  for (const float mean : mean_m) sum += static_cast<double>(mean);
  const double mu_global = sum / count;
  double squares = 0.0;
  for (const float mean : mean_m) {
    const double difference = static_cast<double>(mean) - mu_global;
    squares += difference * difference;
  }
  const double limit = settings.epsilon * std::sqrt(squares / count);

  std::int64_t outliers = 0;
  for (std::size_t i = 0; i < mean_m.size(); ++i) {
    const bool outlier = std::abs(static_cast<double>(mean_m[i]) - mu_global) > limit;
    keep[i] = outlier ? 0 : 1;
    outliers += outlier ? 1 : 0;
  }
  return outliers;
}

}  // namespace floornav
