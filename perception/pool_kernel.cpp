#include "perception/pool_kernel.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>

#include "perception/pixel_blocks.hpp"
#include "perception/pool_pieces.hpp"

// Vectors of a size unknown to the compiler cannot be members: such processors take the next best target.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "perception/pool_kernel.cpp"  // NOLINT: each target compiles this file again
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace floornav::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Lanes = hn::CappedTag<float, 8>;
using Vector = hn::Vec<Lanes>;
using Integers = hn::RebindToSigned<Lanes>;
constexpr std::size_t kLanes = hn::MaxLanes(Lanes());

void distances(const PlanePool& pool, const InverseDepthPlane& plane, std::size_t begin, std::size_t end,
               float* distance) {
  const Lanes lanes;
  const std::size_t whole = begin + (end - begin) / kLanes * kLanes;
  const Vector a = hn::Set(lanes, plane.a), b = hn::Set(lanes, plane.b), c = hn::Set(lanes, plane.c);
  for (std::size_t i = begin; i < whole; i += kLanes) {
    const Vector expected = hn::Add(hn::Add(hn::Mul(a, hn::LoadU(lanes, pool.ray_x.data() + i)),
                                            hn::Mul(b, hn::LoadU(lanes, pool.ray_y.data() + i))),
                                    c);
    const Vector residual = hn::Mul(hn::Sub(hn::LoadU(lanes, pool.inverse_depth.data() + i), expected),
                                    hn::LoadU(lanes, pool.certainty.data() + i));
    hn::StoreU(hn::Abs(residual), lanes, distance + i);
  }
  for (std::size_t i = whole; i < end; ++i) distance[i] = std::abs(pool.residual(i, plane));
}

/// The same arithmetic on vectors and, for what is left over, on single floats.
template <class D>
HWY_INLINE hn::Mask<D> within_reach(D lanes, const PlanePool& pool, std::size_t i, const Eigen::Matrix3f& R,
                                    const Eigen::Vector3f& sensor, const Reach& reach, float slack_m) {
  using V = hn::Vec<D>;
  const V ray_x = hn::LoadU(lanes, pool.ray_x.data() + i), ray_y = hn::LoadU(lanes, pool.ray_y.data() + i);
  const auto turned = [&](int axis) HWY_ATTR {
    return hn::Add(
        hn::Add(hn::Mul(hn::Set(lanes, R(axis, 0)), ray_x), hn::Mul(hn::Set(lanes, R(axis, 1)), ray_y)),
        hn::Set(lanes, R(axis, 2)));
  };
  const V depth = hn::Div(hn::Set(lanes, 1.0F), hn::LoadU(lanes, pool.inverse_depth.data() + i));
  const V down = turned(2);
  const V x = hn::Add(hn::Set(lanes, sensor.x()), hn::Mul(depth, turned(0)));
  const V y = hn::Add(hn::Set(lanes, sensor.y()), hn::Mul(depth, turned(1)));
  const V z = hn::Add(hn::Set(lanes, sensor.z()), hn::Mul(depth, down));
  const V away = hn::Sqrt(hn::Add(hn::Mul(x, x), hn::Mul(y, y)));
  const V noise =
      hn::Mul(hn::Div(hn::Mul(depth, depth), hn::LoadU(lanes, pool.certainty.data() + i)), hn::Abs(down));
  const V limit =
      hn::Add(hn::Add(hn::Set(lanes, reach.step_m() + slack_m), hn::Mul(hn::Set(lanes, reach.slope()), away)),
              hn::Mul(hn::Set(lanes, 3.0F), noise));
  return hn::Le(hn::Abs(z), limit);
}

void reachable(const PlanePool& pool, const Eigen::Matrix3f& R, const Eigen::Vector3f& sensor,
               const Reach& reach, float slack_m, std::size_t begin, std::size_t end, Claim* out) {
  const Lanes lanes;
  const hn::CappedTag<float, 1> one;
  const std::size_t whole = begin + (end - begin) / kLanes * kLanes;
  for (std::size_t i = begin; i < whole; i += kLanes) {
    std::array<std::uint8_t, 8> bits{};
    hn::StoreMaskBits(lanes, within_reach(lanes, pool, i, R, sensor, reach, slack_m), bits.data());
    for (std::size_t k = 0; k < kLanes; ++k) out[i + k] = static_cast<Claim>(bits[0] >> k & 1);
  }
  for (std::size_t i = whole; i < end; ++i)
    out[i] = hn::AllTrue(one, within_reach(one, pool, i, R, sensor, reach, slack_m)) ? Claim::kPoint
                                                                                     : Claim::kNone;
}

/// The same arithmetic on vectors and, for what is left over, on single floats: 1 and 2 as Claim has it.
template <class D>
HWY_INLINE hn::VFromD<hn::RebindToSigned<D>> claims_of(D lanes, const float* distance,
                                                       const std::int32_t* block, float threshold,
                                                       float noise_end, const std::int32_t* block_states) {
  const hn::RebindToSigned<D> integers;
  const auto off = hn::LoadU(lanes, distance);
  const auto state = hn::GatherIndex(integers, block_states, hn::LoadU(integers, block));
  const auto holds = [&](std::int32_t bit) HWY_ATTR {
    return hn::Ne(hn::And(state, hn::Set(integers, bit)), hn::Zero(integers));
  };
  const auto is_inlier = hn::RebindMask(integers, hn::Le(off, hn::Set(lanes, threshold)));
  const auto is_close = hn::RebindMask(integers, hn::Le(off, hn::Set(lanes, noise_end)));
  const auto none = hn::Zero(integers);
  return hn::IfThenElse(
      is_inlier, hn::IfThenElseZero(holds(PixelBlocks::kOwned), hn::Set(integers, 1)),
      hn::IfThenElse(hn::And(is_close, holds(PixelBlocks::kMostlyOwned)), hn::Set(integers, 2), none));
}

int claims(const PlanePool& pool, const float* distance, float threshold, float noise_end,
           const std::int32_t* block_states, std::size_t begin, std::size_t end, std::uint8_t* out) {
  const Lanes lanes;
  const Integers integers;
  const hn::CappedTag<float, 1> one;
  const hn::Rebind<std::uint8_t, Lanes> bytes;
  const std::size_t whole = begin + (end - begin) / kLanes * kLanes;
  std::size_t count = 0;
  for (std::size_t i = begin; i < whole; i += kLanes) {
    const auto claim =
        claims_of(lanes, distance + i, pool.block.data() + i, threshold, noise_end, block_states);
    count += hn::CountTrue(integers, hn::Eq(claim, hn::Set(integers, 1)));
    hn::StoreU(hn::DemoteTo(bytes, claim), bytes, out + i);
  }
  for (std::size_t i = whole; i < end; ++i) {
    const auto claim =
        claims_of(one, distance + i, pool.block.data() + i, threshold, noise_end, block_states);
    out[i] = static_cast<std::uint8_t>(hn::GetLane(claim));
    count += out[i] == 1 ? 1 : 0;
  }
  return static_cast<int>(count);
}

void take_one(const PoolSource& source, std::size_t i, std::size_t to, PlanePool& out) {
  out.ray_x[to] = source.ray_x[i];
  out.ray_y[to] = source.ray_y[i];
  out.inverse_depth[to] = source.inverse_depth[i];
  out.certainty[to] = source.certainty[i];
  out.block[to] = source.block[i];
  out.point[to] =
      source.point != nullptr ? source.point[i] : source.first_point + static_cast<std::int32_t>(i);
}

template <class T>
HWY_INLINE void copy_vector(const T* from, T* to) {
  const hn::CappedTag<T, kLanes> lanes;
  hn::StoreU(hn::LoadU(lanes, from), lanes, to);
}

void take_vector(const PoolSource& source, std::size_t i, std::size_t to, PlanePool& out) {
  copy_vector(source.ray_x + i, out.ray_x.data() + to);
  copy_vector(source.ray_y + i, out.ray_y.data() + to);
  copy_vector(source.inverse_depth + i, out.inverse_depth.data() + to);
  copy_vector(source.certainty + i, out.certainty.data() + to);
  copy_vector(source.block + i, out.block.data() + to);
  if (source.point != nullptr) {
    copy_vector(source.point + i, out.point.data() + to);
  } else {
    const Integers integers;
    hn::StoreU(hn::Iota(integers, source.first_point + static_cast<std::int32_t>(i)), integers,
               out.point.data() + to);
  }
}

/// Copies the wanted places of the source's arrays to the front of the pool's, which may be the same. Returns
/// how many. Mostly all places of a vector are wanted, or none.
std::size_t take_wanted(const PoolSource& source, const std::uint8_t* marks, std::uint8_t wanted,
                        PlanePool& out) {
  const Integers integers;
  const hn::Rebind<std::uint8_t, Lanes> bytes;
  std::size_t end = 0;
  const std::size_t whole = source.size / kLanes * kLanes;
  for (std::size_t i = 0; i < whole; i += kLanes) {
    const auto mark = hn::PromoteTo(integers, hn::LoadU(bytes, marks + i));
    std::array<std::uint8_t, 8> bits{};
    hn::StoreMaskBits(integers, hn::Eq(mark, hn::Set(integers, wanted)), bits.data());
    if (bits[0] == (1U << kLanes) - 1) {
      take_vector(source, i, end, out);
      end += kLanes;
      continue;
    }
    for (unsigned left = bits[0]; left != 0; left &= left - 1)
      take_one(source, i + static_cast<std::size_t>(std::countr_zero(left)), end++, out);
  }
  for (std::size_t i = whole; i < source.size; ++i)
    if (marks[i] == wanted) take_one(source, i, end++, out);
  return end;
}

}  // namespace
}  // namespace floornav::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace floornav {

HWY_EXPORT(distances);
HWY_EXPORT(reachable);
HWY_EXPORT(claims);
HWY_EXPORT(take_wanted);

void find_distances(const PlanePool& pool, const InverseDepthPlane& plane, Parallel& parallel,
                    std::span<float> distance) {
  for_pieces(pool.size(), parallel, [&](std::size_t begin, std::size_t end) {
    HWY_DYNAMIC_DISPATCH(distances)(pool, plane, begin, end, distance.data());
  });
}

void find_reachable(const PlanePool& pool, const Eigen::Matrix3f& R, const Eigen::Vector3f& sensor,
                    const Reach& reach, float slack_m, Parallel& parallel, std::span<Claim> reachable) {
  for_pieces(pool.size(), parallel, [&](std::size_t begin, std::size_t end) {
    HWY_DYNAMIC_DISPATCH(reachable)(pool, R, sensor, reach, slack_m, begin, end, reachable.data());
  });
}

PoolSource source_of(const PlanePool& pool) {
  return {pool.ray_x.data(),
          pool.ray_y.data(),
          pool.inverse_depth.data(),
          pool.certainty.data(),
          pool.block.data(),
          pool.point.data(),
          0,
          pool.size()};
}

int find_claims(const PlanePool& pool, std::span<const float> distance, float threshold, float noise_band,
                std::span<const std::int32_t> block_states, Parallel& parallel, std::span<Claim> claims) {
  std::atomic<int> count = 0;
  for_pieces(pool.size(), parallel, [&](std::size_t begin, std::size_t end) {
    count += HWY_DYNAMIC_DISPATCH(claims)(pool, distance.data(), threshold, noise_band * threshold,
                                          block_states.data(), begin, end,
                                          reinterpret_cast<std::uint8_t*>(claims.data()));
  });
  return count;
}

void take_points(const PoolSource& source, std::span<const Claim> claims, Claim wanted, PlanePool& out) {
  out.resize(std::max(out.size(), source.size));
  out.resize(HWY_DYNAMIC_DISPATCH(take_wanted)(source, reinterpret_cast<const std::uint8_t*>(claims.data()),
                                               static_cast<std::uint8_t>(wanted), out));
}

}  // namespace floornav
#endif
