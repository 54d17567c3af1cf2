#pragma once

#include <optional>

#include "tools/simulator/drivable.hpp"

namespace floornav {

/// Length of the shortest way on the truth for a robot of the given radius, to the first place within
/// `tolerance_m` of the goal; nothing where there is none. A way goes in 48 directions: at most 0.8 % longer
/// than one that may go in any.
std::optional<double> shortest_way_m(const TruthGrid& truth, double radius_m, const Eigen::Vector2d& start,
                                     const Eigen::Vector2d& goal, double tolerance_m);

}  // namespace floornav
