#include "perception/cell_evidence.hpp"

#include <algorithm>
#include <cmath>

namespace floornav {

namespace {

constexpr float kMinSurfelShare = 0.1F;  ///< of a cell's points, for a surfel to decide it
constexpr std::int32_t kMinSurfelPoints = 2;
constexpr std::size_t kSparse = 2;       ///< points of a cell of which one on a surfel is enough
constexpr float kMinAboveShare = 0.02F;  ///< of a cell's points, to make a top above the plane
constexpr std::size_t kMinAbovePoints = 3;
constexpr float kAboveSigmas = 4.0F;
constexpr float kTopQuantile = 0.9F;
constexpr float kTopQuantileSigmas = 1.2816F;  ///< of a normal distribution

/// Sums the points of one surfel.
DecidingSurfel part_of(std::span<const CellPoint> points, std::int16_t surfel) {
  double z = 0.0;
  DecidingSurfel part;
  part.surfel = surfel;
  part.max_z_m = -std::numeric_limits<float>::infinity();
  for (const CellPoint& p : points) {
    if (p.surfel != surfel) continue;
    z += static_cast<double>(p.z_m);
    part.max_z_m = std::max(part.max_z_m, p.z_m);
    part.rise += {.group = CellRise::kNone,
                  .points = 1,
                  .rise_m = p.rise_m,
                  .var_m2 = p.var_m2,
                  .common_m2 = p.common_m2};
  }
  part.mean_z_m = static_cast<float>(z / part.rise.points);
  return part;
}

/// True where one of the points on no surfel is clearly higher than this surfel's are.
bool something_above(std::span<const CellPoint> points, std::int16_t surfel) {
  const float top = part_of(points, surfel).max_z_m;
  return std::any_of(points.begin(), points.end(), [top](const CellPoint& p) {
    return p.surfel < 0 && p.z_m > top + kAboveSigmas * std::sqrt(p.var_m2);
  });
}

/// The higher one of two surfels; of two that lie closer than noise throws a point, the one with more points.
bool outranks(const DecidingSurfel& a, const DecidingSurfel& b) {
  const DecidingSurfel& lower = a.mean_z_m < b.mean_z_m ? a : b;
  if (std::abs(a.mean_z_m - b.mean_z_m) > lower.thrown_m()) return a.mean_z_m > b.mean_z_m;
  return a.rise.points > b.rise.points;
}

/// Of the mean, each point a measurement of its own.
float variance_of(const CellRise& sums) {
  return sums.variance_m2(static_cast<float>(sums.points));
}

float quantile(std::vector<float>& values, float share) {
  const auto place = static_cast<std::size_t>(share * static_cast<float>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(place), values.end());
  return values[place];
}

/// Top of a surfel's points, or of those on none, as they were measured: their quantile, less what noise
/// makes of it, so that the top of what is level is its mean.
float top_of_measured(std::span<const CellPoint> points, std::int16_t surfel, float mean_z_m,
                      std::vector<float>& heights) {
  heights.clear();
  float var_m2 = 0.0F;
  for (const CellPoint& p : points) {
    if (surfel >= 0 && p.surfel != surfel) continue;
    heights.push_back(p.z_m);
    var_m2 += p.var_m2;
  }
  const float above_m = quantile(heights, kTopQuantile) - mean_z_m;
  const float noise_m = kTopQuantileSigmas * std::sqrt(var_m2 / static_cast<float>(heights.size()));
  return mean_z_m + (above_m > noise_m ? std::sqrt(above_m * above_m - noise_m * noise_m) : 0.0F);
}

/// Top of what stands clearly above `plane_top`, or `plane_top` where too few points do.
float robust_top(std::span<const CellPoint> points, float plane_top, std::vector<float>& heights) {
  heights.clear();
  for (const CellPoint& p : points) {
    if (p.z_m > plane_top + kAboveSigmas * std::sqrt(p.var_m2)) heights.push_back(p.z_m);
  }
  const float least = kMinAboveShare * static_cast<float>(points.size());
  if (heights.size() < kMinAbovePoints || static_cast<float>(heights.size()) < least) return plane_top;
  return quantile(heights, kTopQuantile);
}

}  // namespace

float DecidingSurfel::thrown_m() const {
  return kAboveSigmas * std::sqrt(rise.var_m2 / static_cast<float>(rise.points));
}

/// Of one or two points one on a surfel is enough, where nothing stands above it: far floor has no more than
/// that in a cell.
DecidingSurfel find_deciding_surfel(std::span<const CellPoint> points, std::size_t surfels,
                                    CellScratch& scratch) {
  const std::int16_t first = points.front().surfel;
  if (std::all_of(points.begin(), points.end(), [first](const CellPoint& p) { return p.surfel == first; }))
    return first < 0 ? DecidingSurfel{} : part_of(points, first);
  scratch.surfel_points.resize(std::max(scratch.surfel_points.size(), surfels), 0);
  for (const CellPoint& p : points)
    if (p.surfel >= 0) ++scratch.surfel_points[static_cast<std::size_t>(p.surfel)];
  const auto least = std::max(kMinSurfelPoints,
                              static_cast<std::int32_t>(kMinSurfelShare * static_cast<float>(points.size())));
  DecidingSurfel best;
  for (const CellPoint& p : points) {
    if (p.surfel < 0) continue;
    std::int32_t& count = scratch.surfel_points[static_cast<std::size_t>(p.surfel)];
    const bool sparse = points.size() <= kSparse && !something_above(points, p.surfel);
    if (count >= least || (count > 0 && sparse)) {
      const DecidingSurfel candidate = part_of(points, p.surfel);
      if (best.surfel < 0 || outranks(candidate, best)) best = candidate;
    }
    count = 0;
  }
  return best;
}

void summarize_cell(std::span<const CellPoint> points, const DecidingSurfel& decider, float rise_m,
                    CellScratch& scratch, CellEvidence& cell) {
  cell.points = static_cast<std::int32_t>(points.size());
  cell.surfel = decider.surfel;
  if (cell.surfel >= 0) {
    cell.mean_z_m = decider.mean_z_m + rise_m;
    cell.var_z_m2 = variance_of(decider.rise);
    const float own_top_z_m = decider.slanted
                                  ? top_of_measured(points, cell.surfel, decider.mean_z_m, scratch.heights)
                                  : decider.max_z_m + rise_m;
    cell.top_z_m = robust_top(points, own_top_z_m, scratch.heights);
    return;
  }
  double z = 0.0;
  CellRise sums;
  for (const CellPoint& p : points) {
    z += static_cast<double>(p.z_m);
    sums +=
        {.group = CellRise::kNone, .points = 1, .rise_m = 0.0F, .var_m2 = p.var_m2, .common_m2 = p.common_m2};
  }
  cell.mean_z_m = static_cast<float>(z / sums.points);
  cell.var_z_m2 = variance_of(sums);
  cell.top_z_m = top_of_measured(points, cell.surfel, cell.mean_z_m, scratch.heights);
}

}  // namespace floornav
