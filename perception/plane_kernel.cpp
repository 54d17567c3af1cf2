#include "perception/plane_kernel.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "perception/pool_pieces.hpp"

// Vectors of a size unknown to the compiler cannot be members: such processors take the next best target.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "perception/plane_kernel.cpp"  // NOLINT: each target compiles this file again
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace floornav::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// Sums are kept apart for eight residues of the index, however many a vector holds: so they do not depend on
/// the instruction set.
constexpr std::size_t kStreams = 8;
using Lanes = hn::CappedTag<float, kStreams>;
using Vector = hn::Vec<Lanes>;
constexpr std::size_t kLanes = hn::MaxLanes(Lanes());

/// A sum over the points, first by streams.
class Sum {
 public:
  HWY_INLINE void add(std::size_t part, Vector values) {
    float* const place = streams_.data() + part * kLanes;
    hn::Store(hn::Add(hn::Load(Lanes(), place), values), Lanes(), place);
  }
  void add(std::size_t stream, float value) { streams_[stream] += value; }
  [[nodiscard]] double total() const {
    double sum = 0.0;
    for (const float stream : streams_) sum += static_cast<double>(stream);
    return sum;
  }

 private:
  alignas(64) std::array<float, kStreams> streams_{};
};

PlaneScore score(const PlanePool& pool, const InverseDepthPlane& plane, float threshold) {
  const Lanes lanes;
  const float limit = threshold * threshold;
  Sum gain, inliers;
  const std::size_t whole = pool.size() / kStreams * kStreams;
  const Vector a = hn::Set(lanes, plane.a), b = hn::Set(lanes, plane.b), c = hn::Set(lanes, plane.c);
  const Vector zero = hn::Zero(lanes), one = hn::Set(lanes, 1.0F), limits = hn::Set(lanes, limit);
  for (std::size_t first = 0; first < whole; first += kStreams)
    for (std::size_t part = 0; part < kStreams / kLanes; ++part) {
      const std::size_t i = first + part * kLanes;
      const Vector expected = hn::Add(hn::Add(hn::Mul(a, hn::LoadU(lanes, pool.ray_x.data() + i)),
                                              hn::Mul(b, hn::LoadU(lanes, pool.ray_y.data() + i))),
                                      c);
      const Vector r = hn::Mul(hn::Sub(hn::LoadU(lanes, pool.inverse_depth.data() + i), expected),
                               hn::LoadU(lanes, pool.certainty.data() + i));
      const Vector left = hn::Sub(limits, hn::Mul(r, r));
      gain.add(part, hn::Max(left, zero));
      inliers.add(part, hn::IfThenElseZero(hn::Gt(left, zero), one));
    }
  for (std::size_t i = whole; i < pool.size(); ++i) {
    const float r = pool.residual(i, plane);
    const float left = limit - r * r;
    gain.add(i - whole, std::max(left, 0.0F));
    inliers.add(i - whole, left > 0.0F ? 1.0F : 0.0F);
  }
  return {static_cast<float>(gain.total()),
          static_cast<float>(inliers.total() / static_cast<double>(pool.size()))};
}

/// Sums of a fit around a ray, of what is left of inverse depth over a plane: small numbers.
struct FitStreams {
  Sum w, x, y, xx, xy, yy, r, xr, yr, rr;

  template <class Value, class Multiply>
  HWY_INLINE void add(std::size_t place, Value weight, Value dx, Value dy, Value left, Multiply times) {
    const Value wx = times(weight, dx), wy = times(weight, dy), wr = times(weight, left);
    w.add(place, weight), x.add(place, wx), y.add(place, wy), r.add(place, wr);
    xx.add(place, times(wx, dx)), xy.add(place, times(wx, dy)), yy.add(place, times(wy, dy));
    xr.add(place, times(wx, left)), yr.add(place, times(wy, left)), rr.add(place, times(wr, left));
  }
  void add_to(ResidualSums& sums) const {
    sums.w += w.total(), sums.x += x.total(), sums.y += y.total(), sums.r += r.total();
    sums.xx += xx.total(), sums.xy += xy.total(), sums.yy += yy.total();
    sums.xr += xr.total(), sums.yr += yr.total(), sums.rr += rr.total();
  }
};

/// `weights` may be null.
void fit_piece(const PlanePool& pool, const InverseDepthPlane& plane, float threshold, const float* weights,
               std::size_t begin, std::size_t end, ResidualSums& sums) {
  const Lanes lanes;
  const auto times = [](Vector p, Vector q) HWY_ATTR { return hn::Mul(p, q); };
  FitStreams streams;
  const std::size_t whole = begin + (end - begin) / kStreams * kStreams;
  const Vector a = hn::Set(lanes, plane.a), b = hn::Set(lanes, plane.b), c = hn::Set(lanes, plane.c);
  const Vector x0 = hn::Set(lanes, sums.ray_x), y0 = hn::Set(lanes, sums.ray_y);
  const Vector limit = hn::Set(lanes, threshold);
  for (std::size_t first = begin; first < whole; first += kStreams)
    for (std::size_t part = 0; part < kStreams / kLanes; ++part) {
      const std::size_t i = first + part * kLanes;
      const Vector ray_x = hn::LoadU(lanes, pool.ray_x.data() + i);
      const Vector ray_y = hn::LoadU(lanes, pool.ray_y.data() + i);
      const Vector certainty = hn::LoadU(lanes, pool.certainty.data() + i);
      const Vector left = hn::Sub(hn::LoadU(lanes, pool.inverse_depth.data() + i),
                                  hn::Add(hn::Add(hn::Mul(a, ray_x), hn::Mul(b, ray_y)), c));
      Vector weight =
          hn::IfThenElseZero(hn::Le(hn::Abs(hn::Mul(left, certainty)), limit), hn::Mul(certainty, certainty));
      if (weights != nullptr) weight = hn::Mul(weight, hn::LoadU(lanes, weights + i));
      streams.add(part, weight, hn::Sub(ray_x, x0), hn::Sub(ray_y, y0), left, times);
    }
  for (std::size_t i = whole; i < end; ++i) {
    const float left = pool.inverse_depth[i] - plane.inverse_depth(pool.ray_x[i], pool.ray_y[i]);
    if (std::abs(left * pool.certainty[i]) > threshold) continue;
    const float own = weights != nullptr ? weights[i] : 1.0F;
    streams.add(i - whole, pool.certainty[i] * pool.certainty[i] * own, pool.ray_x[i] - sums.ray_x,
                pool.ray_y[i] - sums.ray_y, left, [](float p, float q) { return p * q; });
  }
  streams.add_to(sums);
}

}  // namespace
}  // namespace floornav::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace floornav {

HWY_EXPORT(score);
HWY_EXPORT(fit_piece);

PlaneScore score_of(const PlanePool& pool, const InverseDepthPlane& plane, float threshold) {
  return HWY_DYNAMIC_DISPATCH(score)(pool, plane, threshold);
}

PlaneFit fit_inliers(const PlanePool& pool, const InverseDepthPlane& plane, float threshold,
                     std::span<const float> weights, Parallel& parallel, std::vector<ResidualSums>& parts) {
  constexpr std::size_t kPart = 4096;  // so that float sums stay exact enough
  if (pool.size() == 0) return {};
  ResidualSums sums;
  sums.ray_x = pool.ray_x[pool.size() / 2];
  sums.ray_y = pool.ray_y[pool.size() / 2];
  parts.assign((pool.size() + kPart - 1) / kPart, sums);
  for_pieces(pool.size(), parallel, [&](std::size_t begin, std::size_t end) {
    for (std::size_t first = begin; first < end; first += kPart) HWY_DYNAMIC_DISPATCH(fit_piece)
    (pool, plane, threshold, weights.empty() ? nullptr : weights.data(), first, std::min(first + kPart, end),
     parts[first / kPart]);
  });
  for (const ResidualSums& part : parts) sums += part;
  return PlaneFit(sums, plane);
}

}  // namespace floornav
#endif
