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

struct PlanePart {
  float mean_z = 0.0F;  ///< of the points as moved onto the plane
  float max_z = 0.0F;
  float rise = 0.0F;  ///< mean
  float var = 0.0F;   ///< of the mean rise
};

/// Sums the points of one surfel (or those on none, for -1).
PlanePart part_of(std::span<const CellPoint> points, std::int16_t surfel) {
  double z = 0.0, rise = 0.0, var = 0.0, common = 0.0;
  float max_z = -std::numeric_limits<float>::infinity();
  int count = 0;
  for (const CellPoint& p : points) {
    if (p.surfel != surfel) continue;
    z += static_cast<double>(p.z_m);
    rise += static_cast<double>(p.rise_m);
    var += static_cast<double>(p.var_m2);
    common += static_cast<double>(p.common_m2);
    max_z = std::max(max_z, p.z_m);
    ++count;
  }
  const double n = count;
  return {static_cast<float>(z / n), max_z, static_cast<float>(rise / n),
          static_cast<float>(var / (n * n) + common / n)};
}

/// True where one of the points on no surfel is clearly higher than this surfel's are.
bool something_above(std::span<const CellPoint> points, std::int16_t surfel) {
  const float top = part_of(points, surfel).max_z;
  return std::any_of(points.begin(), points.end(), [top](const CellPoint& p) {
    return p.surfel < 0 && p.z_m > top + kAboveSigmas * std::sqrt(p.var_m2);
  });
}

/// The highest surfel with a fair share of the points, -1 where there is none. Of one or two points one is
/// enough, where nothing stands above it: far floor has no more than that in a cell.
std::int16_t deciding_surfel(std::span<const CellPoint> points, std::size_t surfels, CellScratch& scratch) {
  scratch.surfel_points.resize(std::max(scratch.surfel_points.size(), surfels), 0);
  for (const CellPoint& p : points)
    if (p.surfel >= 0) ++scratch.surfel_points[static_cast<std::size_t>(p.surfel)];
  const auto least = std::max(kMinSurfelPoints,
                              static_cast<std::int32_t>(kMinSurfelShare * static_cast<float>(points.size())));
  std::int16_t best = -1;
  float best_z = 0.0F;
  for (const CellPoint& p : points) {
    if (p.surfel < 0) continue;
    std::int32_t& count = scratch.surfel_points[static_cast<std::size_t>(p.surfel)];
    const bool sparse = points.size() <= kSparse && !something_above(points, p.surfel);
    if (count >= least || (count > 0 && sparse)) {
      const float z = part_of(points, p.surfel).mean_z;
      if (best < 0 || z > best_z) {
        best = p.surfel;
        best_z = z;
      }
    }
    count = 0;
  }
  return best;
}

/// Draws an insignificant rise to zero.
float significant_rise(const PlanePart& part, float significance) {
  const float squared = part.rise * part.rise;
  if (squared <= 0.0F) return 0.0F;
  return part.rise * std::max(0.0F, 1.0F - significance * significance * part.var / squared);
}

float quantile(std::vector<float>& values, float share) {
  const auto place = static_cast<std::size_t>(share * static_cast<float>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(place), values.end());
  return values[place];
}

/// Top of what stands clearly above `plane_top`, or `plane_top` where too few points do.
float robust_top(std::span<const CellPoint> points, float plane_top, std::vector<float>& heights) {
  heights.clear();
  for (const CellPoint& p : points) {
    const float noise = p.surfel < 0 ? kAboveSigmas * std::sqrt(p.var_m2) : 0.0F;
    if (p.z_m > plane_top + noise) heights.push_back(p.z_m);
  }
  const float least = kMinAboveShare * static_cast<float>(points.size());
  if (heights.size() < kMinAbovePoints || static_cast<float>(heights.size()) < least) return plane_top;
  return quantile(heights, kTopQuantile);
}

}  // namespace

void summarize_cell(std::span<const CellPoint> points, std::size_t surfels, float significance_sigmas,
                    CellScratch& scratch, CellEvidence& cell) {
  cell.points = static_cast<std::int32_t>(points.size());
  cell.surfel = deciding_surfel(points, surfels, scratch);
  if (cell.surfel >= 0) {
    const PlanePart part = part_of(points, cell.surfel);
    const float rise = significant_rise(part, significance_sigmas);
    cell.mean_z_m = part.mean_z + rise;
    cell.var_z_m2 = part.var;
    cell.top_z_m = robust_top(points, part.max_z + rise, scratch.heights);
    return;
  }
  double z = 0.0, var = 0.0, common = 0.0;
  scratch.heights.clear();
  for (const CellPoint& p : points) {
    z += static_cast<double>(p.z_m);
    var += static_cast<double>(p.var_m2);
    common += static_cast<double>(p.common_m2);
    scratch.heights.push_back(p.z_m);
  }
  const auto n = static_cast<double>(points.size());
  cell.mean_z_m = static_cast<float>(z / n);
  cell.var_z_m2 = static_cast<float>(var / (n * n) + common / n);
  cell.top_z_m = quantile(scratch.heights, kTopQuantile);
}

}  // namespace floornav
