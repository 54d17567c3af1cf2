#include "perception/step_kernel.hpp"

#include <algorithm>
#include <array>
#include <bit>

// Vectors of a size unknown to the compiler cannot be members: such processors take the next best target.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "perception/step_kernel.cpp"  // NOLINT: each target compiles this file again
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace floornav::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Lanes = hn::CappedTag<float, 8>;
using Vector = hn::Vec<Lanes>;

/// The nearer one in the image of two rows or columns, where it measured something.
Vector first_measured(const float* near, const float* far) {
  const Vector depths = hn::LoadU(Lanes(), near);
  return hn::IfThenElse(hn::Gt(depths, hn::Zero(Lanes())), depths, hn::LoadU(Lanes(), far));
}

std::int32_t steps_of_row(const MeasuredImage& image, int row, const LeastStep& least,
                          std::int32_t* columns) {
  const Lanes lanes;
  const float* const depths = image.inverse_depth.data() + image.row_begin(row);
  const float* const row_above = image.inverse_depth.data() + image.row_begin(std::max(0, row - 1));
  const float* const second_above = image.inverse_depth.data() + image.row_begin(std::max(0, row - 2));
  const float* const certainties = image.certainty.data() + image.row_begin(row);
  const Vector zero = hn::Zero(lanes);
  std::int32_t count = 0;
  for (std::size_t i = 0; i < image.stride; i += hn::Lanes(lanes)) {
    const bool is_first = row == 0 && i == 0;
    const Vector here = hn::LoadU(lanes, depths + i);
    const Vector before = is_first ? zero : first_measured(depths + i - 1, depths + i - 2);
    const Vector above = first_measured(row_above + i, second_above + i);
    const Vector off = hn::Max(hn::Abs(hn::Sub(here, before)), hn::Abs(hn::Sub(here, above)));
    const auto is_small =
        hn::Or(hn::Le(hn::Mul(off, hn::LoadU(lanes, certainties + i)), hn::Set(lanes, least.sigmas)),
               hn::Le(off, hn::Mul(hn::Set(lanes, least.depth_m), hn::Mul(here, here))));
    const auto is_between = hn::And(hn::Gt(before, zero), hn::Gt(above, zero));
    const auto is_step = hn::AndNot(hn::And(is_small, is_between), hn::Gt(here, zero));
    std::array<std::uint8_t, 8> bits{};
    hn::StoreMaskBits(lanes, is_step, bits.data());
    for (unsigned left = bits[0]; left != 0; left &= left - 1)
      columns[count++] = static_cast<std::int32_t>(i) + std::countr_zero(left);
  }
  return count;
}

}  // namespace
}  // namespace floornav::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace floornav {

HWY_EXPORT(steps_of_row);

std::int32_t find_steps(const MeasuredImage& image, int row, const LeastStep& least, std::int32_t* columns) {
  return HWY_DYNAMIC_DISPATCH(steps_of_row)(image, row, least, columns);
}

}  // namespace floornav
#endif
