#pragma once

#include <span>
#include <vector>

#include "perception/cell_points.hpp"
#include "perception/evidence.hpp"
#include "perception/surfels.hpp"

namespace floornav {

/// Scratch memory of one worker.
struct CellScratch {
  std::vector<std::int32_t> surfel_points;  ///< a surfel: its points in the cell, 0 between calls
  std::vector<float> heights;
  std::vector<PlaneSums> sums;
};

/// Sums up what a cell's points say: which surfel decides it (the highest that holds a fair share of them),
/// the mean height with its variance, and the robust top. The cell number stays as it is. `points` must not
/// be empty.
///
/// The mean is the deciding plane's height there plus the cell's own mean rise above it, drawn towards the
/// plane as far as the rise is not significant: d max(0, 1 - s^2 var / d^2) with s = `significance_sigmas`.
/// So flat floor stays flat and a true centimetre shows. The top is the plane's top unless enough points
/// stand clearly above it; then it is a quantile of those, never the highest point.
void summarize_cell(std::span<const CellPoint> points, std::size_t surfels, float significance_sigmas,
                    CellScratch& scratch, CellEvidence& cell);

}  // namespace floornav
