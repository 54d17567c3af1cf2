#include "perception/ransac.hpp"

#include <algorithm>
#include <cmath>

#include "perception/plane_kernel.hpp"

namespace floornav {

namespace {

constexpr std::size_t kSampleSize = 2048;
constexpr std::size_t kPointsPerMean = 4;
constexpr int kAttemptsPerHypothesis = 8;
constexpr float kMissProbability = 0.01F;
constexpr float kMinHypotheses =
    50.0F;  ///< the best of several planes that compete is found by comparing enough
constexpr float kWorthRefining = 0.8F;  ///< of the best gain so far
constexpr int kLocalRefinements = 2;
constexpr int kFinalRefinements = 1;

/// Mean of a few points that follow each other: if they are on a plane so is their mean, with less noise. So
/// planes a little apart compete more clearly.
void set_mean(const PlanePool& pool, std::size_t first, std::size_t place, PlanePool& sample) {
  const std::size_t count = std::min(kPointsPerMean, pool.size() - first);
  float ray_x = 0.0F, ray_y = 0.0F, inverse_depth = 0.0F, certainty = 0.0F;
  for (std::size_t i = first; i < first + count; ++i) {
    ray_x += pool.ray_x[i];
    ray_y += pool.ray_y[i];
    inverse_depth += pool.inverse_depth[i];
    certainty += pool.certainty[i];
  }
  const float share = 1.0F / static_cast<float>(count);
  sample.ray_x[place] = ray_x * share;
  sample.ray_y[place] = ray_y * share;
  sample.inverse_depth[place] = inverse_depth * share;
  sample.certainty[place] = certainty * std::sqrt(share);
}

/// One mean of each of equal pieces of the pool, so that the sample covers the section evenly.
void draw_sample(const PlanePool& pool, Random& random, PlanePool& sample) {
  const std::size_t count = std::min(kSampleSize, pool.size());
  sample.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t begin = i * pool.size() / count;
    const std::size_t end = (i + 1) * pool.size() / count;
    set_mean(pool, begin + random.below(end - begin), i, sample);
  }
}

/// Through three points; where the normal is known, each second one through one point, with that normal.
std::optional<InverseDepthPlane> hypothesis(const PlanePool& sample, const PlaneQuery& query, int attempt,
                                            Random& random) {
  const auto draw = [&] {
    const std::size_t i = random.below(sample.size());
    return Eigen::Vector3f(sample.ray_x[i], sample.ray_y[i], sample.inverse_depth[i]);
  };
  const Eigen::Vector3f p = draw();
  if (query.expected_normal && attempt % 2 == 0) return plane_through(p, *query.expected_normal);
  const Eigen::Vector3f q = draw();
  const Eigen::Vector3f r = draw();
  return plane_through(p, q, r);
}

/// Number of hypotheses after which one of inliers alone was likely among them.
float hypotheses_needed(float inlier_share) {
  const float all_inliers = inlier_share * inlier_share * inlier_share;
  if (all_inliers >= 1.0F) return kMinHypotheses;
  return std::max(kMinHypotheses, std::log(kMissProbability) / std::log1p(-all_inliers));
}

struct Candidate {
  InverseDepthPlane plane;
  PlaneScore score;
};

/// Weighted least squares on the points near the plane.
std::optional<InverseDepthPlane> refine(const PlanePool& pool, const InverseDepthPlane& plane,
                                        const PlaneQuery& query, Parallel& parallel, RansacScratch& scratch) {
  return fit_inliers(pool, plane, query.threshold_sigmas, {}, parallel, scratch.parts).solve();
}

Candidate refined_on_sample(const PlaneQuery& query, Candidate best, Parallel& parallel,
                            RansacScratch& scratch) {
  for (int i = 0; i < kLocalRefinements; ++i) {
    const auto plane = refine(scratch.sample, best.plane, query, parallel, scratch);
    if (!plane || !query.admits(*plane)) break;
    const PlaneScore score = score_of(scratch.sample, *plane, query.threshold_sigmas);
    if (score.gain <= best.score.gain) break;
    best = {*plane, score};
  }
  return best;
}

}  // namespace

std::optional<InverseDepthPlane> find_plane(const PlanePool& pool, const PlaneQuery& query, Random& random,
                                            Parallel& parallel, RansacScratch& scratch) {
  if (pool.size() < 3) return std::nullopt;
  draw_sample(pool, random, scratch.sample);
  std::optional<Candidate> best;
  float needed = static_cast<float>(query.max_hypotheses);
  int scored = 0;
  for (int attempt = 0; attempt < kAttemptsPerHypothesis * query.max_hypotheses; ++attempt) {
    if (static_cast<float>(scored) >= needed) break;
    const auto plane = hypothesis(scratch.sample, query, attempt, random);
    if (!plane || !query.admits(*plane)) continue;
    const PlaneScore score = score_of(scratch.sample, *plane, query.threshold_sigmas);
    ++scored;
    if (best && score.gain < kWorthRefining * best->score.gain) continue;
    const Candidate refined = refined_on_sample(query, {*plane, score}, parallel, scratch);
    if (best && refined.score.gain <= best->score.gain) continue;
    best = refined;
    needed = std::min(needed, hypotheses_needed(best->score.inliers));
  }
  scratch.hypotheses += scored;
  if (!best) return std::nullopt;
  InverseDepthPlane plane = best->plane;
  for (int i = 0; i < kFinalRefinements; ++i) {
    const auto refined = refine(pool, plane, query, parallel, scratch);
    if (!refined || !query.admits(*refined)) break;
    plane = *refined;
  }
  return plane;
}

}  // namespace floornav
