#pragma once

#include <cstddef>
#include <span>

#include "runtime/geometry/parallel.hpp"

namespace floornav {

/// Points as structure of arrays, m.
struct PointsView {
  std::span<const float> x, y, z;
  [[nodiscard]] std::size_t size() const { return x.size(); }
};

/// Mean distance of each point to its `neighbors` nearest others (mu_x of section 4.4), with nanoflann's
/// kd-tree. With fewer others all of them count; alone a point gets 0. A squared distance is (dx dx + dy dy)
/// + dz dz and a mean the sum of the roots in ascending order divided by their number, all in float, so that
/// another exact search can decide bit for bit the same.
void mean_neighbor_distances(const PointsView& points, int neighbors, Parallel& parallel,
                             std::span<float> mean_m);

}  // namespace floornav
