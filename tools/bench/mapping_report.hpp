#pragma once

#include <array>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "tools/bench/map_accuracy.hpp"
#include "tools/bench/map_change.hpp"
#include "tools/bench/map_cost.hpp"
#include "tools/bench/map_heights.hpp"
#include "tools/bench/steps.hpp"

namespace floornav {

/// What `floornav-bench mapping` measured; what was not asked for is empty.
struct MappingFigures {
  FuseCost fuse;
  std::vector<MapSizeCost> sizes;  ///< of the smallest map and the largest
  MapAccuracyOptions accuracy_options;
  MapAccuracy accuracy;
  MapChangeOptions change_options;
  MapChange change;
  HeightGainOptions gain_options;
  std::array<HeightGain, 2> gain;
  std::vector<StepRow> steps;
};

/// Each figure with its goal, for people.
void print(const MappingFigures& figures);

nlohmann::json json_of(const MappingFigures& figures);

}  // namespace floornav
