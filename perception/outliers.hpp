#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "perception/neighbor_search.hpp"
#include "perception/settings.hpp"

namespace floornav {

/// Statistical outlier removal of one section (section 4.4). Writes 1 to `keep` where a point stays and 0
/// where |mu_x - mu_global| > epsilon sigma_global, eq. (6), two-sided, with mean and deviation of all mu_x
/// of the section. Returns the number of outliers. `mean_m` is scratch memory.
std::int64_t remove_outliers(const PointsView& points, const OutlierSettings& settings, Parallel& parallel,
                             std::vector<float>& mean_m, std::span<std::uint8_t> keep);

}  // namespace floornav
