#pragma once

#include <array>
#include <cstdint>

#include "runtime/geometry/parallel.hpp"
#include "tools/bench/table1.hpp"

namespace floornav {

/// Table 1's heights with one noise, by the last frame of a slow drive alone and by all ten.
struct HeightGain {
  Table1Row one_frame;
  Table1Row ten_frames;
};

struct HeightGainOptions {
  int configurations = 60;
  SensorKind sensor = SensorKind::kKinect;
  std::uint64_t seed = 1001;
};

/// Courses of Table 1, 4 x 3 sections, exact poses; independent noise, then correlated.
std::array<HeightGain, 2> measure_height_gain(const HeightGainOptions& options, Parallel& parallel);

}  // namespace floornav
