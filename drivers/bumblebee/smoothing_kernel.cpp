#include "drivers/bumblebee/smoothing_kernel.hpp"

#include <algorithm>
#include <cstddef>

#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "drivers/bumblebee/smoothing_kernel.cpp"  // NOLINT: compiled for each target
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace floornav::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

constexpr int kStride = 2;  ///< every other neighbour in a row is enough

/// The means at columns x on; `step`: floats between two rows.
template <class D>
HWY_INLINE void smooth(D lanes, const float* rough, std::ptrdiff_t step, cv::Size reach, float* to) {
  using V = hn::Vec<D>;
  const V zero = hn::Zero(lanes), two = hn::Set(lanes, 2.0F);
  const V same_surface = hn::Set(lanes, 1.0F);  // px off the plane
  const V center = hn::LoadU(lanes, rough);
  const V twice = hn::Add(center, center);
  V sum = center, count = hn::Set(lanes, 1.0F);
  for (int dy = 0; dy <= reach.height; ++dy)
    for (int dx = dy == 0 ? kStride : -reach.width; dx <= reach.width; dx += kStride) {
      const V a = hn::LoadU(lanes, rough + dy * step + dx);
      const V b = hn::LoadU(lanes, rough - dy * step - dx);
      const V both = hn::Add(a, b);
      const auto same =
          hn::And(hn::Gt(hn::Min(a, b), zero), hn::Lt(hn::Abs(hn::Sub(both, twice)), same_surface));
      sum = hn::Add(sum, hn::IfThenElseZero(same, both));
      count = hn::Add(count, hn::IfThenElseZero(same, two));
    }
  hn::StoreU(hn::IfThenElseZero(hn::Gt(center, zero), hn::Div(sum, count)), lanes, to);
}

void smooth_row(const float* rough, std::ptrdiff_t step, int columns, cv::Size window_reach, float* to) {
  const cv::Size reach(window_reach.width / kStride * kStride, window_reach.height);
  const hn::CappedTag<float, 8> lanes;
  const hn::CappedTag<float, 1> single;
  const auto at_once = static_cast<int>(hn::Lanes(lanes));
  int x = reach.width;
  for (; x + at_once <= columns - reach.width; x += at_once) smooth(lanes, rough + x, step, reach, to + x);
  for (; x < columns - reach.width; ++x) smooth(single, rough + x, step, reach, to + x);
}

}  // namespace
}  // namespace floornav::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace floornav {

HWY_EXPORT(smooth_row);

void smooth_disparities(const cv::Mat1f& rough, cv::Size window, cv::Range rows, cv::Mat1f& smooth) {
  const int columns = rough.cols;
  for (int y = rows.start; y < rows.end; ++y) {
    const float* const from = rough[y];
    float* const to = smooth[y];
    const cv::Size reach(window.width / 2, std::min({window.height / 2, y, rough.rows - 1 - y}));
    std::copy_n(from, columns, to);
    HWY_DYNAMIC_DISPATCH(smooth_row)(from, static_cast<std::ptrdiff_t>(rough.step1()), columns, reach, to);
  }
}

}  // namespace floornav
#endif
