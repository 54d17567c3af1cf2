#include "drivers/bumblebee/refinement_kernel.hpp"

#include <cstddef>
#include <limits>

// Vectors of a size unknown to the compiler cannot be members: such processors take the next best target.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "drivers/bumblebee/refinement_kernel.cpp"  // NOLINT: compiled for each target
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace floornav::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// Calls work(lanes, x) from `begin` on: as many columns at once as fit, the rest one by one.
template <class Work>
HWY_INLINE void over_columns(std::size_t begin, std::size_t end, const Work& work) {
  const hn::CappedTag<float, 8> lanes;
  const hn::CappedTag<float, 1> single;
  std::size_t x = begin;
  for (; x + hn::Lanes(lanes) <= end; x += hn::Lanes(lanes)) work(lanes, x);
  for (; x < end; ++x) work(single, x);
}

/// Grey levels from bytes.
template <class D>
HWY_INLINE hn::Vec<D> greys(D lanes, const std::uint8_t* from) {
  const hn::RebindToSigned<D> integers;
  return hn::ConvertTo(lanes, hn::PromoteTo(integers, hn::LoadU(hn::Rebind<std::uint8_t, D>(), from)));
}

/// One of the four pixels of packed words.
template <int kPlace, class D, class V>
HWY_INLINE hn::Vec<D> neighbour(D lanes, V packed) {
  const hn::RebindToSigned<D> integers;
  return hn::ConvertTo(lanes, hn::And(hn::ShiftRight<8 * kPlace>(packed), hn::Set(integers, 255)));
}

void pack(const std::uint8_t* right, std::size_t columns, std::int32_t* packed) {
  over_columns(1, columns - 2, [&](auto lanes, std::size_t x) HWY_ATTR {
    const hn::RebindToSigned<decltype(lanes)> integers;
    const auto pixel = [&](std::size_t at) HWY_ATTR {
      return hn::PromoteTo(integers, hn::LoadU(hn::Rebind<std::uint8_t, decltype(lanes)>(), right + at));
    };
    const auto low = hn::Or(pixel(x - 1), hn::ShiftLeft<8>(pixel(x)));
    const auto high = hn::Or(hn::ShiftLeft<16>(pixel(x + 1)), hn::ShiftLeft<24>(pixel(x + 2)));
    hn::StoreU(hn::Or(low, high), integers, packed + x);
  });
}

/// Columns x on of a row.
template <class D>
HWY_INLINE void compare(D lanes, std::size_t x, const std::uint8_t* left, const std::int32_t* packed,
                        const float* disparity, std::size_t columns, ComparedRow& row) {
  using V = hn::Vec<D>;
  const hn::RebindToSigned<D> integers;
  const V one = hn::Set(lanes, 1.0F), two = hn::Set(lanes, 2.0F), half = hn::Set(lanes, 0.5F);
  const V shift = hn::LoadU(lanes, disparity + x);
  const V place = hn::Sub(hn::Iota(lanes, static_cast<float>(x)), shift);
  const auto seen =
      hn::And(hn::Gt(shift, hn::Zero(lanes)),
              hn::And(hn::Ge(place, one), hn::Lt(place, hn::Set(lanes, static_cast<float>(columns - 3)))));
  const V inside = hn::IfThenElse(seen, place, one);
  const auto whole = hn::ConvertTo(integers, inside);
  const V t = hn::Sub(inside, hn::ConvertTo(lanes, whole));
  const auto four = hn::GatherIndex(integers, packed, whole);
  const V a = neighbour<0>(lanes, four), b = neighbour<1>(lanes, four);
  const V c = neighbour<2>(lanes, four), d = neighbour<3>(lanes, four);
  const V k1 = hn::Mul(half, hn::Sub(c, a));
  const V k2 =
      hn::Sub(hn::Add(hn::Sub(a, hn::Mul(hn::Set(lanes, 2.5F), b)), hn::Mul(two, c)), hn::Mul(half, d));
  const V k3 = hn::Add(hn::Mul(half, hn::Sub(d, a)), hn::Mul(hn::Set(lanes, 1.5F), hn::Sub(b, c)));
  const V value = hn::Add(b, hn::Mul(t, hn::Add(k1, hn::Mul(t, hn::Add(k2, hn::Mul(t, k3))))));
  const V curve = hn::Add(hn::Mul(two, k2), hn::Mul(hn::Set(lanes, 3.0F), hn::Mul(t, k3)));
  const V rise = hn::Add(k1, hn::Mul(t, curve));
  const V ahead = hn::Mul(half, hn::Sub(greys(lanes, left + x + 1), greys(lanes, left + x - 1)));
  hn::StoreU(hn::IfThenElseZero(seen, one), lanes, row.known.data() + x);
  hn::StoreU(hn::IfThenElseZero(seen, hn::Sub(greys(lanes, left + x), value)), lanes, row.rest.data() + x);
  hn::StoreU(hn::IfThenElseZero(seen, hn::Mul(half, hn::Add(ahead, rise))), lanes, row.gradient.data() + x);
}

void compare_columns(const std::uint8_t* left, const std::int32_t* packed, const float* disparity,
                     std::size_t columns, ComparedRow& row) {
  over_columns(1, columns - 1, [&](auto lanes, std::size_t x) HWY_ATTR {
    compare(lanes, x, left, packed, disparity, columns, row);
  });
}

void exchange(const ComparedRow& out, const ComparedRow& in, ColumnSums& sums) {
  const std::size_t columns = in.known.size();
  const std::size_t margin = (sums[kKnown].size() - columns) / 2;
  over_columns(0, columns, [&](auto lanes, std::size_t x) HWY_ATTR {
    const auto e = hn::LoadU(lanes, in.rest.data() + x), old_e = hn::LoadU(lanes, out.rest.data() + x);
    const auto g = hn::LoadU(lanes, in.gradient.data() + x);
    const auto old_g = hn::LoadU(lanes, out.gradient.data() + x);
    const auto change = [&](WindowSum which, auto more, auto less) HWY_ATTR {
      float* const sum = sums[which].data() + margin + x;
      hn::StoreU(hn::Add(hn::LoadU(lanes, sum), hn::Sub(more, less)), lanes, sum);
    };
    change(kKnown, hn::LoadU(lanes, in.known.data() + x), hn::LoadU(lanes, out.known.data() + x));
    change(kRest, e, old_e);
    change(kGradient, g, old_g);
    change(kProduct, hn::Mul(g, e), hn::Mul(old_g, old_e));
    change(kSquares, hn::Mul(g, g), hn::Mul(old_g, old_g));
    change(kRestSquares, hn::Mul(e, e), hn::Mul(old_e, old_e));
  });
}

/// The window's sum: `columns` neighbouring sums from a place on.
template <class D>
HWY_INLINE hn::Vec<D> window_sum(D lanes, const float* from, std::size_t columns) {
  hn::Vec<D> sum = hn::LoadU(lanes, from);
  for (std::size_t i = 1; i < columns; ++i) sum = hn::Add(sum, hn::LoadU(lanes, from + i));
  return sum;
}

template <class D>
HWY_INLINE void solve(D lanes, std::size_t x, const ColumnSums& sums, std::size_t reach,
                      const float* disparity, float* refined, float* sigma) {
  using V = hn::Vec<D>;
  const V zero = hn::Zero(lanes), one = hn::Set(lanes, 1.0F);
  const V most_step = hn::Set(lanes, 1.0F);        // px
  const V settled = hn::Set(lanes, 0.25F);         // px
  const V model2 = hn::Set(lanes, 0.05F * 0.05F);  // px2, of what interpolation and the window's shape add
  const V least_texture = hn::Set(lanes, 4.0F);    // mean square of the gradient, grey levels a pixel
  const auto sum = [&](WindowSum which)
                       HWY_ATTR { return window_sum(lanes, sums[which].data() + x, 2 * reach + 1); };
  const V known = sum(kKnown), e = sum(kRest), g = sum(kGradient);
  const V n = hn::Max(one, known);
  const V texture = hn::Sub(sum(kSquares), hn::Div(hn::Mul(g, g), n));
  const V divisor = hn::Max(texture, one);
  const V step = hn::Div(hn::Sub(hn::Div(hn::Mul(g, e), n), sum(kProduct)), divisor);
  const V rest = hn::Max(zero, hn::Sub(sum(kRestSquares), hn::Div(hn::Mul(e, e), n)));
  const V from = hn::LoadU(lanes, disparity + x);
  const auto solvable =
      hn::And(hn::And(hn::Gt(from, zero), hn::Ge(known, one)), hn::Ge(texture, hn::Mul(least_texture, n)));
  const V moved = hn::Add(from, hn::Min(most_step, hn::Max(hn::Neg(most_step), step)));
  hn::StoreU(hn::IfThenElse(solvable, hn::Max(zero, moved), from), lanes, refined + x);
  const V told = hn::Sqrt(hn::Add(hn::Div(rest, hn::Mul(n, divisor)), model2));
  const auto good = hn::And(solvable, hn::Lt(hn::Abs(step), settled));
  hn::StoreU(hn::IfThenElse(good, told, hn::Set(lanes, std::numeric_limits<float>::infinity())), lanes,
             sigma + x);
}

void solve_columns(const ColumnSums& sums, std::size_t reach, std::size_t columns, const float* disparity,
                   float* refined, float* sigma) {
  over_columns(0, columns, [&](auto lanes, std::size_t x) HWY_ATTR {
    solve(lanes, x, sums, reach, disparity, refined, sigma);
  });
}

}  // namespace
}  // namespace floornav::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace floornav {

HWY_EXPORT(pack);
HWY_EXPORT(compare_columns);
HWY_EXPORT(exchange);
HWY_EXPORT(solve_columns);

void pack_neighbours(const std::uint8_t* right, int columns, std::vector<std::int32_t>& packed) {
  packed.assign(static_cast<std::size_t>(columns), 0);
  if (columns >= 4) HWY_DYNAMIC_DISPATCH(pack)(right, packed.size(), packed.data());
}

void compare_row(const std::uint8_t* left, const std::vector<std::int32_t>& packed, const float* disparity,
                 ComparedRow& row) {
  const std::size_t columns = packed.size();
  for (auto* values : {&row.known, &row.rest, &row.gradient}) values->assign(columns, 0.0F);
  if (columns >= 4) HWY_DYNAMIC_DISPATCH(compare_columns)(left, packed.data(), disparity, columns, row);
}

void exchange_rows(const ComparedRow& out, const ComparedRow& in, ColumnSums& sums) {
  HWY_DYNAMIC_DISPATCH(exchange)(out, in, sums);
}

void solve_row(const ColumnSums& sums, int reach, int columns, const float* disparity, float* refined,
               float* sigma) {
  HWY_DYNAMIC_DISPATCH(solve_columns)
  (sums, static_cast<std::size_t>(reach), static_cast<std::size_t>(columns), disparity, refined, sigma);
}

}  // namespace floornav
#endif
