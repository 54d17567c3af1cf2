#include "perception/plane_splitter.hpp"

namespace floornav {

namespace {

/// Mean squared distance from a plane, in variances, beyond which it may be a compromise: of one plane's
/// points within the threshold it is 0.91.
constexpr double kMostScatter = 1.35;
constexpr double kLeastGain = 40.0;        ///< that the sum of squared distances falls by
constexpr int kLeastPoints = 30;           ///< of each plane
constexpr std::size_t kMostPoints = 4000;  ///< of both: more are of nothing small
constexpr int kIterations = 8;

void add(const PlanePool& pool, std::size_t i, PlaneFit& fit) {
  fit.add(pool.ray_x[i], pool.ray_y[i], pool.inverse_depth[i], pool.certainty[i] * pool.certainty[i]);
}

std::optional<PlanePair> solve(const std::array<PlaneFit, 2>& fits) {
  const auto first = fits[0].solve(), second = fits[1].solve();
  if (!first || !second) return std::nullopt;
  return PlanePair{{*first, *second}, fits};
}

}  // namespace

std::optional<PlanePair> PlaneSplitter::split(const PlanePool& pool, std::span<const Claim> claims,
                                              std::span<const float> distance, float threshold_sigmas) {
  take_claimed(pool, claims);
  if (points_.size() > kMostPoints) return std::nullopt;
  double cost = 0.0;
  for (const std::size_t i : points_) cost += static_cast<double>(distance[i] * distance[i]);
  if (cost <= kMostScatter * static_cast<double>(points_.size())) return std::nullopt;
  std::optional<Split> best;
  for (const auto* coordinate : {&pool.ray_x, &pool.ray_y}) {
    const auto found = split_at_middle(pool, *coordinate, threshold_sigmas);
    if (found && (!best || found->cost < best->cost)) best = found;
  }
  if (!best || cost - best->cost < kLeastGain) return std::nullopt;
  return best->pair;
}

std::optional<PlaneSplitter::Split> PlaneSplitter::split_at_middle(const PlanePool& pool,
                                                                   const std::vector<float>& coordinate,
                                                                   float threshold_sigmas) {
  values_.clear();
  for (const std::size_t i : points_) values_.push_back(coordinate[i]);
  const auto middle = values_.begin() + static_cast<std::ptrdiff_t>(values_.size() / 2);
  std::nth_element(values_.begin(), middle, values_.end());
  std::array<PlaneFit, 2> halves;
  for (const std::size_t i : points_) add(pool, i, coordinate[i] < *middle ? halves[0] : halves[1]);
  auto pair = solve(halves);
  for (int k = 0; pair && k < kIterations; ++k) pair = refit(pool, *pair, threshold_sigmas);
  if (!pair) return std::nullopt;
  double cost = 0.0;
  for (const std::size_t i : points_) {
    const float d = std::min(pair->distance(pool, i), threshold_sigmas);
    cost += static_cast<double>(d * d);
  }
  return Split{*pair, cost};
}

void PlaneSplitter::take_claimed(const PlanePool& pool, std::span<const Claim> claims) {
  points_.clear();
  for (std::size_t i = 0; i < pool.size(); ++i)
    if (claims[i] == Claim::kPoint) points_.push_back(i);
}

bool PlaneSplitter::both_own_points(const PlanePool& pool, std::span<const Claim> claims,
                                    const PlanePair& pair) {
  int first = 0, second = 0;
  for (std::size_t i = 0; i < pool.size(); ++i)
    if (claims[i] == Claim::kPoint) ++(pair.meets_first(pool.ray_x[i], pool.ray_y[i]) ? first : second);
  return std::min(first, second) >= kLeastPoints;
}

std::optional<PlanePair> PlaneSplitter::refit(const PlanePool& pool, std::span<const Claim> claims,
                                              const PlanePair& pair, float threshold_sigmas) {
  take_claimed(pool, claims);
  return refit(pool, pair, threshold_sigmas);
}

std::optional<PlanePair> PlaneSplitter::refit(const PlanePool& pool, const PlanePair& pair,
                                              float threshold_sigmas) const {
  std::array<PlaneFit, 2> fits;
  int first = 0, second = 0;
  for (const std::size_t i : points_) {
    if (pair.distance(pool, i) > threshold_sigmas) continue;
    const bool is_first = pair.meets_first(pool.ray_x[i], pool.ray_y[i]);
    add(pool, i, is_first ? fits[0] : fits[1]);
    ++(is_first ? first : second);
  }
  if (std::min(first, second) < kLeastPoints) return std::nullopt;
  return solve(fits);
}

}  // namespace floornav
