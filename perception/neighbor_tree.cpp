#include "perception/neighbor_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>

#include <nanoflann.hpp>

namespace floornav {

namespace {

constexpr std::size_t kLeafSize = 16;
constexpr int kPointsPerPiece = 2048;
constexpr std::size_t kFew = 64;  ///< points for which no tree is built

/// nanoflann's access to the points.
struct TreePoints {
  const PointsView& points;
  [[nodiscard]] std::size_t kdtree_get_point_count() const { return points.size(); }
  [[nodiscard]] float kdtree_get_pt(std::uint32_t index, std::size_t dimension) const {
    return dimension == 0 ? points.x[index] : dimension == 1 ? points.y[index] : points.z[index];
  }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, TreePoints>, TreePoints,
                                                 3, std::uint32_t>;

/// The smallest squared distances in ascending order. The search ends once all of them are zero: among many
/// identical points a tree would otherwise visit every one.
class NearestDistances {
 public:
  explicit NearestDistances(std::size_t capacity) : capacity_(capacity) {
    squared_[capacity_ - 1] = std::numeric_limits<float>::max();
  }
  bool addPoint(float squared, std::uint32_t) {
    if (squared >= worstDist()) return true;
    std::size_t i = std::min(count_, capacity_ - 1);
    for (; i > 0 && squared_[i - 1] > squared; --i) squared_[i] = squared_[i - 1];
    squared_[i] = squared;
    count_ = std::min(count_ + 1, capacity_);
    return worstDist() > 0.0F;
  }
  [[nodiscard]] float worstDist() const { return squared_[capacity_ - 1]; }
  [[nodiscard]] bool full() const { return count_ == capacity_; }
  [[nodiscard]] std::size_t size() const { return count_; }

  /// Mean of all but the first, which is the point itself.
  [[nodiscard]] float mean_of_others() const {
    float sum = 0.0F;
    for (std::size_t i = 1; i < count_; ++i) sum += std::sqrt(squared_[i]);
    return sum / static_cast<float>(count_ - 1);
  }

 private:
  std::array<float, static_cast<std::size_t>(kMaxNeighbors) + 1> squared_;
  std::size_t capacity_;
  std::size_t count_ = 0;
};

std::size_t others_of(const PointsView& points, int neighbors) {
  return std::min(static_cast<std::size_t>(std::min(neighbors, kMaxNeighbors)), points.size() - 1);
}

/// Looks at every point: for a few of them quicker than to build a tree of all.
float mean_distance_among_all(const PointsView& points, std::size_t others, std::size_t index) {
  constexpr std::size_t kBlock = 256;
  std::array<float, kBlock> squared;
  NearestDistances nearest(others + 1);
  const float x = points.x[index], y = points.y[index], z = points.z[index];
  for (std::size_t begin = 0; begin < points.size() && nearest.worstDist() > 0.0F; begin += kBlock) {
    const std::size_t size = std::min(kBlock, points.size() - begin);
    for (std::size_t i = 0; i < size; ++i) {
      const float dx = x - points.x[begin + i], dy = y - points.y[begin + i], dz = z - points.z[begin + i];
      squared[i] = (dx * dx + dy * dy) + dz * dz;
    }
    for (std::size_t i = 0; i < size; ++i) nearest.addPoint(squared[i], static_cast<std::uint32_t>(i));
  }
  return nearest.mean_of_others();
}

/// Searches for `count` points; the number of the i-th is point(i).
template <class Point>
void search_tree(const PointsView& points, int neighbors, int count, Point point, Parallel& parallel,
                 std::span<float> mean_m) {
  const std::size_t others = others_of(points, neighbors);
  const TreePoints tree_points{points};
  const Tree tree(3, tree_points, nanoflann::KDTreeSingleIndexAdaptorParams(kLeafSize));
  parallel.run((count + kPointsPerPiece - 1) / kPointsPerPiece, [&](int piece, int) {
    const int end = std::min(count, (piece + 1) * kPointsPerPiece);
    for (int i = piece * kPointsPerPiece; i < end; ++i) {
      const std::size_t index = point(static_cast<std::size_t>(i));
      const std::array<float, 3> query{points.x[index], points.y[index], points.z[index]};
      NearestDistances nearest(others + 1);
      tree.findNeighbors(nearest, query.data(), nanoflann::SearchParams());
      mean_m[index] = nearest.mean_of_others();
    }
  });
}

}  // namespace

void mean_neighbor_distances(const PointsView& points, int neighbors, Parallel& parallel,
                             std::span<float> mean_m) {
  if (points.size() < 2) {
    std::fill(mean_m.begin(), mean_m.end(), 0.0F);
    return;
  }
  search_tree(
      points, neighbors, static_cast<int>(points.size()), [](std::size_t i) { return i; }, parallel, mean_m);
}

void mean_neighbor_distances(const PointsView& points, int neighbors, std::span<const std::int32_t> wanted,
                             Parallel& parallel, std::span<float> mean_m) {
  if (wanted.empty()) return;
  if (wanted.size() <= kFew) {
    const std::size_t others = others_of(points, neighbors);
    const auto search = [&](int number, int) {
      const auto index = static_cast<std::size_t>(wanted[static_cast<std::size_t>(number)]);
      mean_m[index] = mean_distance_among_all(points, others, index);
    };
    parallel.run(static_cast<int>(wanted.size()), std::ref(search));
    return;
  }
  search_tree(
      points, neighbors, static_cast<int>(wanted.size()),
      [&](std::size_t i) { return static_cast<std::size_t>(wanted[i]); }, parallel, mean_m);
}

void mean_distances_of_few(const PointsView& points, int neighbors, std::span<float> mean_m) {
  if (points.size() < 2) {
    std::fill(mean_m.begin(), mean_m.end(), 0.0F);
    return;
  }
  const std::size_t others = others_of(points, neighbors);
  for (std::size_t i = 0; i < points.size(); ++i) mean_m[i] = mean_distance_among_all(points, others, i);
}

}  // namespace floornav
