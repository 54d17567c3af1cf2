#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "runtime/geometry/parallel.hpp"

namespace floornav {

/// Points as structure of arrays, m.
struct PointsView {
  std::span<const float> x, y, z;
  [[nodiscard]] std::size_t size() const { return x.size(); }
};

/// More neighbours than this are not searched for.
inline constexpr int kMaxNeighbors = 64;

/// Mean distance of each point to its `neighbors` nearest others (mu_x of section 4.4), with nanoflann's
/// kd-tree. With fewer others all of them count; alone a point gets 0. A squared distance is (dx dx + dy dy)
/// + dz dz and a mean the sum of the roots in ascending order divided by their number, all in float, so that
/// another exact search can decide bit for bit the same.
void mean_neighbor_distances(const PointsView& points, int neighbors, Parallel& parallel,
                             std::span<float> mean_m);

/// The same for the points whose number is in `wanted` alone; the others' means stay.
void mean_neighbor_distances(const PointsView& points, int neighbors, std::span<const std::int32_t> wanted,
                             Parallel& parallel, std::span<float> mean_m);

/// The same by comparing each point with each other: for a few points.
void mean_distances_of_few(const PointsView& points, int neighbors, std::span<float> mean_m);

}  // namespace floornav
