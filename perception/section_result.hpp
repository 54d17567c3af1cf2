#pragma once

#include <cstdint>
#include <vector>

#include "perception/evidence.hpp"
#include "perception/section_planes.hpp"

namespace floornav {

/// What was found in one section.
struct SectionResult {
  bool done = false;
  std::int64_t outliers = 0;
  std::vector<SectionPlane> planes;
  std::vector<Surfel> surfels;    ///< of the planes
  std::int16_t first_surfel = 0;  ///< the surfel of planes[k] is first_surfel + k
};

}  // namespace floornav
