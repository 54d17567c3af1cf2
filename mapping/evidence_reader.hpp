#pragma once

#include <cstdint>
#include <vector>

#include "mapping/cell_memory.hpp"
#include "mapping/view_coverage.hpp"
#include "perception/evidence.hpp"

namespace floornav {

/// Turns what perception tells of a cell into surfaces to remember.
class EvidenceReader {
 public:
  /// `view_var_m2` is added to the sensor's variance; `max_step_m`: T of eq. (2).
  EvidenceReader(float view_var_m2, float max_step_m) : view_var_m2_(view_var_m2), max_step_m_(max_step_m) {}

  /// False where the numbers of a cell cannot be: not finite, a negative variance, a surfel that does not
  /// exist.
  [[nodiscard]] static bool is_valid(const CellEvidence& cell, const FloorEvidence& evidence);

  /// Appends what the cell saw; nothing for a cell with sight lines only. Of a plane that was hardly
  /// seen nothing is told. A flat surfel is a plane at the mean height of its points, with one
  /// more surface where single points stand out of it by more than T and their noise (a pole, a cable); a
  /// surfel steeper than 45 degrees, or points on no surfel, are a column up to their top.
  void read(const CellEvidence& cell, const FloorEvidence& evidence, Coverage coverage,
            std::vector<Sighting>& sightings) const;

 private:
  [[nodiscard]] Sighting plane_of(const CellEvidence& cell, const Surfel& surfel) const;
  [[nodiscard]] bool stands_out(const CellEvidence& cell, const Surface& plane, double pitch_m) const;

  float view_var_m2_;
  float max_step_m_;
};

}  // namespace floornav
