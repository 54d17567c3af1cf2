#include "perception/window_kernel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

// Vectors of a size unknown to the compiler cannot be members: such processors take the next best target.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "perception/window_kernel.cpp"  // NOLINT: each target compiles this file again
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace floornav::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Lanes = hn::CappedTag<float, WindowImage::kMaxLanes>;
using Vector = hn::Vec<Lanes>;

constexpr float kUnfilled = 3e38F;
constexpr float kFirstRadius = 0.05F;  ///< of the depth: where the first window held too few neighbours
constexpr int kGroup = 8;              ///< neighbours are sorted and merged by eights

/// Ascending.
struct Eight {
  Vector a, b, c, d, e, f, g, h;
};

HWY_INLINE void order(Vector& low, Vector& high) {
  const Vector least = hn::Min(low, high);
  high = hn::Max(low, high);
  low = least;
}

/// A sorting network of 19 comparisons.
HWY_INLINE void sort(Eight& v) {
  order(v.a, v.c), order(v.b, v.d), order(v.e, v.g), order(v.f, v.h);
  order(v.a, v.e), order(v.b, v.f), order(v.c, v.g), order(v.d, v.h);
  order(v.a, v.b), order(v.c, v.d), order(v.e, v.f), order(v.g, v.h);
  order(v.c, v.e), order(v.d, v.f);
  order(v.b, v.e), order(v.d, v.g);
  order(v.b, v.c), order(v.d, v.e), order(v.f, v.g);
}

/// Sorts what falls and then rises, or rises and then falls.
HWY_INLINE void sort_bitonic(Eight& v) {
  order(v.a, v.e), order(v.b, v.f), order(v.c, v.g), order(v.d, v.h);
  order(v.a, v.c), order(v.b, v.d), order(v.e, v.g), order(v.f, v.h);
  order(v.a, v.b), order(v.c, v.d), order(v.e, v.f), order(v.g, v.h);
}

HWY_INLINE Eight lower_of(const Eight& v, const Eight& w) {
  return {hn::Min(v.a, w.h), hn::Min(v.b, w.g), hn::Min(v.c, w.f), hn::Min(v.d, w.e),
          hn::Min(v.e, w.d), hn::Min(v.f, w.c), hn::Min(v.g, w.b), hn::Min(v.h, w.a)};
}

HWY_INLINE Eight upper_of(const Eight& v, const Eight& w) {
  return {hn::Max(v.a, w.h), hn::Max(v.b, w.g), hn::Max(v.c, w.f), hn::Max(v.d, w.e),
          hn::Max(v.e, w.d), hn::Max(v.f, w.c), hn::Max(v.g, w.b), hn::Max(v.h, w.a)};
}

/// The smallest squared distances of a block's pixels, ascending: a vector a rank, in groups of eight.
class Nearest {
 public:
  explicit Nearest(int neighbors) : groups_((neighbors + kGroup - 1) / kGroup), last_(neighbors - 1) {}

  HWY_INLINE void clear() {
    const Lanes lanes;
    const Vector unfilled = hn::Set(lanes, kUnfilled);
    for (int rank = 0; rank < groups_ * kGroup; ++rank) hn::Store(unfilled, lanes, at(rank));
  }
  /// Takes in eight distances, sorted.
  HWY_INLINE void merge(Eight more) {
    for (int group = 0; group < groups_; ++group) {
      const Eight held = load(group);
      Eight low = lower_of(held, more);
      sort_bitonic(low);
      store(group, low);
      if (group + 1 == groups_) return;
      more = upper_of(held, more);
      sort_bitonic(more);
    }
  }
  [[nodiscard]] HWY_INLINE Vector farthest() const { return hn::Load(Lanes(), at(last_)); }
  [[nodiscard]] HWY_INLINE Vector mean() const {
    const Lanes lanes;
    Vector sum = hn::Zero(lanes);
    for (int rank = 0; rank <= last_; ++rank) sum = hn::Add(sum, hn::Sqrt(hn::Load(lanes, at(rank))));
    return hn::Div(sum, hn::Set(lanes, static_cast<float>(last_ + 1)));
  }

 private:
  [[nodiscard]] HWY_INLINE float* at(int rank) { return squared_.data() + rank * WindowImage::kMaxLanes; }
  [[nodiscard]] HWY_INLINE const float* at(int rank) const {
    return squared_.data() + rank * WindowImage::kMaxLanes;
  }
  [[nodiscard]] HWY_INLINE Eight load(int group) const {
    const Lanes lanes;
    const int r = group * kGroup;
    return {hn::Load(lanes, at(r)),     hn::Load(lanes, at(r + 1)), hn::Load(lanes, at(r + 2)),
            hn::Load(lanes, at(r + 3)), hn::Load(lanes, at(r + 4)), hn::Load(lanes, at(r + 5)),
            hn::Load(lanes, at(r + 6)), hn::Load(lanes, at(r + 7))};
  }
  HWY_INLINE void store(int group, const Eight& v) {
    const Lanes lanes;
    const int r = group * kGroup;
    hn::Store(v.a, lanes, at(r)), hn::Store(v.b, lanes, at(r + 1)), hn::Store(v.c, lanes, at(r + 2));
    hn::Store(v.d, lanes, at(r + 3)), hn::Store(v.e, lanes, at(r + 4)), hn::Store(v.f, lanes, at(r + 5));
    hn::Store(v.g, lanes, at(r + 6)), hn::Store(v.h, lanes, at(r + 7));
  }

  alignas(64) std::array<float, static_cast<std::size_t>(kMaxNeighbors* WindowImage::kMaxLanes)> squared_;
  int groups_;
  int last_;  ///< rank of the farthest neighbour that counts
};

/// A block of pixels and its squared distances to others.
struct Block {
  const float *x, *y, *z;  ///< the planes at the block's first pixel
  Vector px, py, pz;

  [[nodiscard]] HWY_INLINE Vector squared(std::ptrdiff_t offset) const {
    const Lanes lanes;
    const Vector dx = hn::Sub(px, hn::LoadU(lanes, x + offset));
    const Vector dy = hn::Sub(py, hn::LoadU(lanes, y + offset));
    const Vector dz = hn::Sub(pz, hn::LoadU(lanes, z + offset));
    return hn::Add(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), hn::Mul(dz, dz));
  }
  [[nodiscard]] HWY_INLINE Eight squared(const std::ptrdiff_t* o) const {
    return {squared(o[0]), squared(o[1]), squared(o[2]), squared(o[3]),
            squared(o[4]), squared(o[5]), squared(o[6]), squared(o[7])};
  }
};

/// Offsets of the pixels in square rings around one, the nearest of a ring first: ring `half` holds 8 half.
class Rings {
 public:
  explicit Rings(std::ptrdiff_t stride) {
    std::size_t next = 0;
    for (int half = 1; half <= WindowImage::kMaxHalf_px; ++half) {
      for (int along = 0; along <= half; ++along)
        for (int side = 0; side < 4; ++side)
          for (const int sign : {1, -1}) {
            if (along == 0 && sign < 0) continue;
            if (along == half && sign < 0) continue;  // a corner belongs to one side
            const int across[2] = {half, sign * along};
            const int turned[4][2] = {{across[0], across[1]},
                                      {-across[1], across[0]},
                                      {-across[0], -across[1]},
                                      {across[1], -across[0]}};
            offset_[next++] = turned[side][0] * stride + turned[side][1];
          }
    }
  }
  [[nodiscard]] const std::ptrdiff_t* begin(int half) const { return offset_.data() + 4 * half * (half - 1); }

 private:
  std::array<std::ptrdiff_t, 4 * WindowImage::kMaxHalf_px*(WindowImage::kMaxHalf_px + 1)> offset_;
};

/// Takes in the eights of a ring; once enough neighbours are known, only those that can matter.
HWY_INLINE void add_ring(const Block& block, const std::ptrdiff_t* offsets, int half, bool all,
                         Nearest& nearest) {
  for (int eight = 0; eight < half; ++eight) {
    Eight more = block.squared(offsets + eight * kGroup);
    if (!all) {
      const Vector least = hn::Min(hn::Min(hn::Min(more.a, more.b), hn::Min(more.c, more.d)),
                                   hn::Min(hn::Min(more.e, more.f), hn::Min(more.g, more.h)));
      if (hn::AllFalse(Lanes(), hn::Lt(least, nearest.farthest()))) continue;
    }
    sort(more);
    nearest.merge(more);
  }
}

void search_block(const WindowImage& image, const Rings& rings, int enough, int row, int column,
                  Nearest& nearest, float* mean_m) {
  const Lanes lanes;
  const std::ptrdiff_t place = image.at(row, column);
  const float *x = image.x() + place, *y = image.y() + place, *z = image.z() + place;
  const Block block{x, y, z, hn::LoadU(lanes, x), hn::LoadU(lanes, y), hn::LoadU(lanes, z)};
  const auto holds_point = hn::Lt(block.pz, hn::Set(lanes, WindowImage::kNothing));
  if (hn::AllFalse(lanes, holds_point)) return;
  nearest.clear();
  for (int half = 1;; ++half) {
    add_ring(block, rings.begin(half), half, half <= enough, nearest);
    if (half < enough) continue;
    const Vector bound = hn::Mul(block.pz, hn::Min(hn::LoadU(lanes, image.column_bound(half) + column),
                                                   hn::Set(lanes, image.row_bound(half, row))));
    const Vector farthest = nearest.farthest();
    const auto open = hn::And(holds_point, hn::Gt(farthest, hn::Mul(bound, bound)));
    const bool is_last = half == WindowImage::kMaxHalf_px;
    if (!is_last && !hn::AllFalse(lanes, open)) continue;
    hn::StoreU(hn::IfThenElse(open, hn::Neg(hn::Sqrt(farthest)), nearest.mean()), lanes, mean_m + place);
    return;
  }
}

void search_rows(const WindowImage& image, int neighbors, int first_row, int end_row, float* mean_m) {
  const Rings rings(image.stride());
  Nearest nearest(neighbors);
  int enough = 1;  // half width of the least window with as many others
  while ((2 * enough + 1) * (2 * enough + 1) - 1 < neighbors) ++enough;
  const int step = static_cast<int>(hn::Lanes(Lanes()));
  for (int row = first_row; row < end_row; ++row)
    for (int column = 0; column < image.width(); column += step)
      search_block(image, rings, enough, row, column, nearest, mean_m);
}

/// The smallest squared distances of one pixel, ascending.
struct NearestOfOne {
  std::array<float, kMaxNeighbors> squared;
  int count;

  explicit NearestOfOne(int neighbors) : count(neighbors) { squared.fill(kUnfilled); }
  [[nodiscard]] float farthest() const { return squared[static_cast<std::size_t>(count) - 1]; }
  void add(float value) {
    if (!(value < farthest())) return;
    auto i = static_cast<std::size_t>(count) - 1;
    for (; i > 0 && squared[i - 1] > value; --i) squared[i] = squared[i - 1];
    squared[i] = value;
  }
  [[nodiscard]] float mean() const {
    float sum = 0.0F;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) sum += std::sqrt(squared[i]);
    return sum / static_cast<float>(count);
  }
};

/// Takes in the pixels [begin, end) of a row but the one at `self`.
void add_row(const WindowImage& image, std::ptrdiff_t begin, std::ptrdiff_t end, std::ptrdiff_t self,
             NearestOfOne& nearest) {
  const Lanes lanes;
  const auto step = static_cast<std::ptrdiff_t>(hn::Lanes(lanes));
  alignas(64) std::array<float, WindowImage::kMaxLanes> values;
  const float *x = image.x(), *y = image.y(), *z = image.z();
  const Vector px = hn::Set(lanes, x[self]), py = hn::Set(lanes, y[self]), pz = hn::Set(lanes, z[self]);
  for (std::ptrdiff_t q = begin; q < end; q += step) {
    const Vector squared = Block{x, y, z, px, py, pz}.squared(q);
    if (hn::AllFalse(lanes, hn::Lt(squared, hn::Set(lanes, nearest.farthest())))) continue;
    hn::Store(squared, lanes, values.data());
    for (std::ptrdiff_t k = 0; k < std::min(step, end - q); ++k)
      if (q + k != self) nearest.add(values[static_cast<std::size_t>(k)]);
  }
}

float search_pixel(const WindowImage& image, int neighbors, int row, int column, float radius_m,
                   int max_pixels) {
  constexpr float kWidening = 4.0F;
  const std::ptrdiff_t self = image.at(row, column);
  const float z = image.z()[self];
  float radius = radius_m < WindowImage::kNothing ? radius_m : kFirstRadius * z;
  while (true) {
    const int columns = image.columns_within(radius, column, z), rows = image.rows_within(radius, row, z);
    const int left = std::max(column - columns, 0), right = std::min(column + columns + 1, image.width());
    const int top = std::max(row - rows, 0), bottom = std::min(row + rows + 1, image.height());
    if ((right - left) * (bottom - top) > max_pixels) return -radius;
    NearestOfOne nearest(neighbors);
    for (int r = top; r < bottom; ++r) add_row(image, image.at(r, left), image.at(r, right), self, nearest);
    const float farthest = std::sqrt(nearest.farthest());
    const bool is_whole = right - left == image.width() && bottom - top == image.height();
    if (is_whole || farthest <= radius) return nearest.mean();
    radius = farthest < WindowImage::kNothing ? farthest : kWidening * radius;
  }
}

}  // namespace
}  // namespace floornav::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace floornav {

HWY_EXPORT(search_rows);
HWY_EXPORT(search_pixel);

void search_windows(const WindowImage& image, int neighbors, int first_row, int end_row,
                    std::span<float> mean_m) {
  HWY_DYNAMIC_DISPATCH(search_rows)(image, neighbors, first_row, end_row, mean_m.data());
}

float search_wider(const WindowImage& image, int neighbors, int row, int column, float radius_m,
                   int max_pixels) {
  return HWY_DYNAMIC_DISPATCH(search_pixel)(image, neighbors, row, column, radius_m, max_pixels);
}

}  // namespace floornav
#endif
