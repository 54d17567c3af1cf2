#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "perception/settings.hpp"
#include "perception/window_search.hpp"

namespace floornav {

/// Statistical outlier removal (section 4.4). Which points go does not depend on `outliers.search`.
class OutlierRemover {
 public:
  explicit OutlierRemover(const OutlierSettings& settings) : settings_(settings) {}

  /// Of one section: writes 1 to `keep` where a point stays and 0 where |mu_x - mu_global| > epsilon
  /// sigma_global, eq. (6), two-sided, with mean and deviation of all mu_x of the section. Returns the number
  /// of outliers.
  std::int64_t remove(const ImagePoints& cloud, Parallel& parallel, std::span<std::uint8_t> keep);

 private:
  void find_mean_distances(const ImagePoints& cloud, Parallel& parallel);

  OutlierSettings settings_;
  WindowSearch window_;
  std::vector<float> mean_m_;  ///< mu_x
};

}  // namespace floornav
