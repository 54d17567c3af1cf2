#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "tools/bench/table1.hpp"

namespace floornav {

/// One setting of one of the paper's four knobs, the others as they are by default (Kinect, 4 x 3 sections).
struct TradeOff {
  std::string knob;
  std::string setting;
  Table1Row errors;
  double perception_ms = 0;  ///< processor time of a frame's perception on one core, median
};

/// How the dominant plane of every section is found: section 4.6.1's first pass.
struct SearchCost {
  std::string way;
  double hypotheses = 0;  ///< scored a frame, mean
  double ms = 0;          ///< processor time a frame, median
};

/// What the paper claims of its method besides Table 1.
struct MethodClaims {
  std::vector<SearchCost> searches;  ///< seeded with the last known normals, unseeded, on the whole cloud
  double share_on_planes = 0;        ///< of the points in the ROI, with unlimited recursion
  double share_by_default = 0;       ///< with the default recursion limit
  double float_bytes = 0;            ///< a frame's points as x, y, z floats
  double cloud_bytes = 0;            ///< as depth_cloud_t
  double surfel_bytes = 0;           ///< as surfels_t
};

std::vector<TradeOff> measure_trade_offs(int configurations, std::uint64_t seed,
                                         const std::function<void(const std::string&)>& progress);
MethodClaims measure_claims(int configurations, std::uint64_t seed);

}  // namespace floornav
