#pragma once

#include <Eigen/Core>

#include "mapping/map_tiles.hpp"
#include "perception/evidence.hpp"
#include "runtime/geometry/settings.hpp"

namespace floornav {

/// How far a frame's heights are corrected before they are fused.
struct AlignmentSettings {
  bool enabled = true;
  double max_lift_m = 0.05;   ///< most that a frame is moved up or down
  double max_tilt_deg = 5.0;  ///< most that it is turned about a horizontal axis
  /// Frames of which the poses count as much as that a floor which begins near z = 0 lies there, and level:
  /// within 3 cm and 1 degree. 0: the poses alone tell.
  double level_start_frames = 10;
};

template <class Visitor>
void visit_settings(Visitor& visit, AlignmentSettings& s) {
  visit("enabled", s.enabled);
  visit("max_lift_m", s.max_lift_m, Allowed{0.0, 0.5});
  visit("max_tilt_deg", s.max_tilt_deg, Allowed{0.0, 10.0});
  visit("level_start_frames", s.level_start_frames, Allowed{0.0, 1000.0});
}

/// A plane of height errors: what a frame's heights are too high by.
struct HeightError {
  Eigen::Vector2d center_m = Eigen::Vector2d::Zero();
  double lift_m = 0;                               ///< at the centre
  Eigen::Vector2d rise = Eigen::Vector2d::Zero();  ///< per metre along x and y

  [[nodiscard]] double at(double x_m, double y_m) const {
    return lift_m + rise.dot(Eigen::Vector2d(x_m, y_m) - center_m);
  }
  /// A part of it, 0..1.
  [[nodiscard]] HeightError share(double part) const { return {center_m, part * lift_m, part * rise}; }
};

/// Finds by how much height, roll and pitch of a frame's pose are off, from the planes that it sees where the
/// map already remembers one: least squares over the height differences, those of things that have changed
/// losing their weight. 0.3 degrees of pitch are 2.6 cm at 5 m, more than a step of T; frames that agree make
/// no false edges. Too little in common: no correction.
HeightError find_height_error(const FloorEvidence& frame, const MapTiles& map,
                              const AlignmentSettings& settings);

/// By how much a frame's floor lies off the level plane z = 0 of the local frame; none where it clearly lies
/// elsewhere: on a ramp, on another storey.
HeightError find_level_error(const FloorEvidence& frame, const AlignmentSettings& settings);

/// The frame with that error taken out of its heights and normals.
FloorEvidence corrected(const FloorEvidence& frame, const HeightError& error);

}  // namespace floornav
