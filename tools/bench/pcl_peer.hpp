#pragma once

#include <cstdint>
#include <span>

#include "perception/roi_cloud.hpp"

namespace floornav {

/// PCL's StatisticalOutlierRemoval, compiled for the processor that builds it: the peer of our outlier
/// removal. Built where CMake is told -DFLOORNAV_PCL_PEER=ON.
class PclOutliers {
 public:
  PclOutliers(int neighbors, double epsilon) : neighbors_(neighbors), epsilon_(epsilon) {}

  /// Decides for every point of a cloud, section by section. Returns the milliseconds of this thread's CPU
  /// time that it took, without what it takes to put the points into PCL's cloud.
  double remove(const RoiCloud& cloud, std::span<std::uint8_t> keep) const;

 private:
  int neighbors_;
  double epsilon_;
};

}  // namespace floornav
