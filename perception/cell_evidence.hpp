#pragma once

#include <span>
#include <vector>

#include "perception/cell_points.hpp"
#include "perception/cell_rise.hpp"
#include "perception/evidence.hpp"
#include "perception/side_end.hpp"

namespace floornav {

/// Scratch memory of one worker.
struct CellScratch {
  std::vector<std::int32_t> surfel_points;  ///< a surfel: its points in the cell, 0 between calls
  std::vector<float> heights;
  std::vector<EndPixel> end_pixels;
};

/// What the points on the surfel that decides a cell say together.
struct DecidingSurfel {
  std::int16_t surfel = -1;  ///< index into FloorEvidence::surfels; -1: none decides
  float mean_z_m = 0.0F;     ///< of its points as moved onto the plane
  float max_z_m = 0.0F;
  bool slanted = false;  ///< left to the caller: its points count as measured
  CellRise rise;         ///< its group is left to the caller

  /// Noise throws a point no higher than this.
  [[nodiscard]] float thrown_m() const;
};

/// Finds the surfel that decides a cell: the highest that holds a fair share of its points. Of two surfels
/// that lie closer than noise throws a point, the one with more points counts. `points` must not be empty.
DecidingSurfel find_deciding_surfel(std::span<const CellPoint> points, std::size_t surfels,
                                    CellScratch& scratch);

/// Sums up what a cell's points say: the mean height with its variance, and the robust top. The cell number
/// stays as it is.
///
/// The mean is the deciding plane's height there plus the rise above it that is no accident (`rise_m`). The
/// top is the plane's top unless enough points stand clearly above it; then it is a quantile of those, never
/// the highest point. Where no surfel decides, or a slanted one, they are the points' own mean and quantile,
/// without what their noise adds to it.
void summarize_cell(std::span<const CellPoint> points, const DecidingSurfel& decider, float rise_m,
                    CellScratch& scratch, CellEvidence& cell);

}  // namespace floornav
