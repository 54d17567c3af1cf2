#include "mapping/evidence_reader.hpp"

#include <algorithm>
#include <cmath>

namespace floornav {
namespace {

constexpr float kUpright = 50.0F;       // rise per metre of what has no slope: 89 degrees
constexpr float kSteepestPlane = 1.0F;  // rise per metre: 45 degrees
constexpr std::int32_t kPointsThatStandOut = Level::kTrusted;  // a robust top rests on several points

/// Variance of one point, by that of the mean. Of many points the mean's is what they have in common.
float point_var_m2(const CellEvidence& cell) {
  constexpr std::int32_t kMany = 20;
  return cell.var_z_m2 * static_cast<float>(std::min(cell.points, kMany));
}

}  // namespace

bool EvidenceReader::is_valid(const CellEvidence& cell, const FloorEvidence& evidence) {
  if (cell.points < 0 || cell.surfel < -1 ||
      cell.surfel >= static_cast<std::int64_t>(evidence.surfels.size()))
    return false;
  if (std::isinf(cell.ray_z_m)) return false;
  if (cell.points == 0) return true;
  if (cell.surfel >= 0 && !evidence.surfels[static_cast<std::size_t>(cell.surfel)].normal.allFinite())
    return false;
  return std::isfinite(cell.mean_z_m) && std::isfinite(cell.top_z_m) && std::isfinite(cell.var_z_m2) &&
         cell.var_z_m2 >= 0;
}

Sighting EvidenceReader::plane_of(const CellEvidence& cell, const Surfel& surfel) const {
  const Eigen::Vector3f up = surfel.normal.z() < 0 ? Eigen::Vector3f(-surfel.normal) : surfel.normal;
  const float vertical = std::max(up.z(), 1.0F / kUpright);
  Sighting sighting;
  sighting.z_m = cell.mean_z_m;
  sighting.var_m2 = cell.var_z_m2 + view_var_m2_;
  sighting.gradient_x = -up.x() / vertical;
  sighting.gradient_y = -up.y() / vertical;
  sighting.points = cell.points;
  sighting.lowest_z_m = cell.mean_z_m;
  return sighting;
}

bool EvidenceReader::stands_out(const CellEvidence& cell, const Surface& plane, double pitch_m) const {
  const float rise_m = std::hypot(plane.gradient_x, plane.gradient_y) * static_cast<float>(pitch_m);
  return cell.top_z_m - cell.mean_z_m > max_step_m_ + rise_m + 3.0F * std::sqrt(point_var_m2(cell));
}

void EvidenceReader::read(const CellEvidence& cell, const FloorEvidence& evidence, Coverage coverage,
                          std::vector<Sighting>& sightings) const {
  if (cell.points == 0) return;
  Sighting column;
  column.z_m = std::max(cell.top_z_m, cell.mean_z_m);
  column.var_m2 = point_var_m2(cell) + view_var_m2_;
  column.gradient_x = kUpright;
  column.column = true;
  column.points = cell.points;
  column.lowest_z_m = cell.mean_z_m;
  if (cell.surfel < 0) {
    sightings.push_back(column);
    return;
  }
  Sighting plane = plane_of(cell, evidence.surfels[static_cast<std::size_t>(cell.surfel)]);
  if (std::hypot(plane.gradient_x, plane.gradient_y) > kSteepestPlane) {
    column.gradient_x = plane.gradient_x;
    column.gradient_y = plane.gradient_y;
    sightings.push_back(column);
    return;
  }
  plane.set_reach(cell.top_z_m - cell.mean_z_m, static_cast<float>(evidence.lattice.pitch_m));
  plane.in_part = coverage != Coverage::kWhole;
  if (coverage != Coverage::kGlimpse) sightings.push_back(plane);
  if (!stands_out(cell, plane, evidence.lattice.pitch_m)) return;
  column.points = std::min(cell.points, kPointsThatStandOut);
  column.lowest_z_m = cell.top_z_m;
  sightings.push_back(column);
}

}  // namespace floornav
