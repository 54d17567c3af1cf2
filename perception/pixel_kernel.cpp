#include "perception/pixel_kernel.hpp"

#include <algorithm>
#include <array>

// Vectors of a size unknown to the compiler cannot be members: such processors take the next best target.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "perception/pixel_kernel.cpp"  // NOLINT: each target compiles this file again
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace floornav::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Lanes = hn::CappedTag<float, MeasuredImage::kPadding_px>;
using Vector = hn::Vec<Lanes>;
using Integers = hn::RebindToSigned<Lanes>;
constexpr std::size_t kLanes = hn::MaxLanes(Lanes());

/// Measures a vector of pixels. `uncertainty` may be null.
HWY_INLINE void measure(const std::uint16_t* counts, const std::uint8_t* uncertainty,
                        const MeasurementModel& model, float* inverse_depth, float* certainty) {
  constexpr float kMinInverseDepth = 0.01F;
  const Lanes lanes;
  const Integers integers;
  const Vector zero = hn::Zero(lanes), one = hn::Set(lanes, 1.0F);
  const Vector count =
      hn::ConvertTo(lanes, hn::PromoteTo(integers, hn::LoadU(hn::Rebind<std::uint16_t, Lanes>(), counts)));
  const Vector value = hn::Mul(count, hn::Set(lanes, model.scale));
  const Vector inverse = model.is_depth ? hn::Div(one, hn::Max(value, hn::Set(lanes, 1e-9F)))
                                        : hn::Mul(value, hn::Set(lanes, model.per_disparity));
  const auto measured = hn::And(hn::Gt(value, zero), hn::Gt(inverse, hn::Set(lanes, kMinInverseDepth)));
  Vector sigma_px = hn::Set(lanes, model.sigma_px);
  if (uncertainty != nullptr) {
    const Vector own = hn::ConvertTo(
        lanes, hn::PromoteTo(integers, hn::LoadU(hn::Rebind<std::uint8_t, Lanes>(), uncertainty)));
    sigma_px =
        hn::IfThenElse(hn::Gt(own, zero), hn::Mul(own, hn::Set(lanes, model.uncertainty_scale)), sigma_px);
  }
  const Vector sigma = hn::Mul(sigma_px, hn::Set(lanes, model.per_disparity));
  const Vector squared = hn::Mul(inverse, inverse);
  const Vector added = hn::Mul(hn::Set(lanes, model.added_m2), hn::Mul(squared, squared));
  hn::StoreU(hn::IfThenElseZero(measured, inverse), lanes, inverse_depth);
  hn::StoreU(hn::Div(one, hn::Sqrt(hn::Add(hn::Mul(sigma, sigma), added))), lanes, certainty);
}

void measure_pixels(const DepthFrame& frame, const MeasurementModel& model, int row, MeasuredImage& image) {
  const auto width = static_cast<std::size_t>(image.width);
  const std::size_t first = static_cast<std::size_t>(row) * width;
  const std::uint16_t* const counts = frame.pixels.data() + first;
  const std::uint8_t* const uncertainty =
      frame.uncertainty.empty() ? nullptr : frame.uncertainty.data() + first;
  float* const inverse_depth = image.inverse_depth.data() + image.row_begin(row);
  float* const certainty = image.certainty.data() + image.row_begin(row);
  const std::size_t whole = width / kLanes * kLanes;
  for (std::size_t i = 0; i < whole; i += kLanes)
    measure(counts + i, uncertainty == nullptr ? nullptr : uncertainty + i, model, inverse_depth + i,
            certainty + i);
  std::array<std::uint16_t, kLanes> last_counts{};
  std::array<std::uint8_t, kLanes> last_uncertainty{};
  for (std::size_t i = whole; i < image.stride; i += kLanes) {
    std::copy(counts + std::min(i, width), counts + width, last_counts.begin());
    if (uncertainty != nullptr)
      std::copy(uncertainty + std::min(i, width), uncertainty + width, last_uncertainty.begin());
    measure(last_counts.data(), uncertainty == nullptr ? nullptr : last_uncertainty.data(), model,
            inverse_depth + i, certainty + i);
    last_counts.fill(0);
  }
}

/// Section of a coordinate along one axis, as a float; `inside` becomes false where it is in none.
template <class Mask>
HWY_INLINE Vector along(const SectionGrid::Axis& axis, Vector coordinate_m, Mask& inside) {
  const Lanes lanes;
  const Vector grown = axis.squared ? hn::Mul(coordinate_m, hn::Abs(coordinate_m)) : coordinate_m;
  const Vector place = hn::Mul(hn::Sub(grown, hn::Set(lanes, axis.min)), hn::Set(lanes, axis.per_unit));
  const Vector end = hn::Set(lanes, static_cast<float>(axis.count));
  inside = hn::And(inside, hn::And(hn::Ge(place, hn::Zero(lanes)), hn::Lt(place, end)));
  return place;
}

RowCounts sections_of_row(const MeasuredImage& image, int row, const RowRegion& region,
                          const SectionGrid& grid, std::int16_t* section) {
  const Lanes lanes;
  const Integers integers;
  const hn::Rebind<std::int16_t, Lanes> shorts;
  const float* const inverse_depth = image.inverse_depth.data() + image.row_begin(row);
  const float* const certainty = image.certainty.data() + image.row_begin(row);
  const Vector zero = hn::Zero(lanes), one = hn::Set(lanes, 1.0F);
  const auto columns = hn::Set(integers, grid.y_res());
  const auto none = hn::Set(integers, -1);
  std::size_t measured_count = 0, far_enough_count = 0, certain_count = 0, inside_count = 0;
  for (std::size_t i = 0; i < image.stride; i += kLanes) {
    const Vector inverse = hn::LoadU(lanes, inverse_depth + i);
    const auto measured = hn::Gt(inverse, zero);
    if (hn::AllFalse(lanes, measured)) {
      hn::StoreU(hn::DemoteTo(shorts, none), shorts, section + i);
      continue;
    }
    const auto far_enough = hn::And(measured, hn::Le(inverse, hn::Set(lanes, region.max_inverse_depth)));
    const Vector depth = hn::Div(one, inverse);
    const auto certain = hn::And(
        far_enough, hn::Le(hn::Mul(depth, depth),
                           hn::Mul(hn::Set(lanes, region.max_sigma_z), hn::LoadU(lanes, certainty + i))));
    const Vector ray_x = hn::LoadU(lanes, region.ray_x + i);
    const auto coordinate = [&](int axis) HWY_ATTR {
      const Vector ray = hn::Add(hn::Mul(hn::Set(lanes, region.per_ray_x[axis]), ray_x),
                                 hn::Set(lanes, region.of_row[axis]));
      return hn::Add(hn::Set(lanes, region.origin[axis]), hn::Mul(depth, ray));
    };
    const Vector z = coordinate(2);
    auto inside = hn::And(
        certain, hn::And(hn::Ge(z, hn::Set(lanes, region.z_min)), hn::Le(z, hn::Set(lanes, region.z_max))));
    const Vector x_place = along(grid.x_axis(), coordinate(0), inside);
    const Vector y_place = along(grid.y_axis(), coordinate(1), inside);
    const auto index =
        hn::Add(hn::Mul(hn::ConvertTo(integers, x_place), columns), hn::ConvertTo(integers, y_place));
    const auto found = hn::IfThenElse(hn::RebindMask(integers, inside), index, none);
    hn::StoreU(hn::DemoteTo(shorts, found), shorts, section + i);
    measured_count += hn::CountTrue(lanes, measured);
    far_enough_count += hn::CountTrue(lanes, far_enough);
    certain_count += hn::CountTrue(lanes, certain);
    inside_count += hn::CountTrue(lanes, inside);
  }
  const auto difference = [](std::size_t a, std::size_t b) { return static_cast<std::int64_t>(a - b); };
  return {difference(image.stride, measured_count), difference(measured_count, far_enough_count),
          difference(far_enough_count, certain_count), difference(certain_count, inside_count)};
}

}  // namespace
}  // namespace floornav::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace floornav {

HWY_EXPORT(measure_pixels);
HWY_EXPORT(sections_of_row);

MeasurementModel::MeasurementModel(const DepthFrame& frame, float roughness_m)
    : is_depth(frame.meaning == PixelMeaning::kDepth),
      scale(frame.scale),
      per_disparity(1.0F / (frame.camera.fx * frame.baseline_m)),
      sigma_px(frame.disparity_sigma_px),
      uncertainty_scale(frame.uncertainty_scale) {
  constexpr float kRounding = 0.288675F;  // deviation of a uniform distribution of width 1
  const float rounding_m = is_depth ? scale * kRounding : 0.0F;
  added_m2 = roughness_m * roughness_m + rounding_m * rounding_m;
}

void measure_row(const DepthFrame& frame, const MeasurementModel& model, int row, MeasuredImage& image) {
  HWY_DYNAMIC_DISPATCH(measure_pixels)(frame, model, row, image);
}

RowCounts find_sections(const MeasuredImage& image, int row, const RowRegion& region, const SectionGrid& grid,
                        std::int16_t* section) {
  return HWY_DYNAMIC_DISPATCH(sections_of_row)(image, row, region, grid, section);
}

}  // namespace floornav
#endif
