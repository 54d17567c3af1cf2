#pragma once

#include <string>

#include "runtime/geometry/settings.hpp"

namespace floornav {

/// Region of interest (sections 3.4 and 4.2): a cuboid in the body frame, and the noise bounds of eq. (3) and
/// (4).
struct RoiSettings {
  double x_min_m = 0.0;
  double x_max_m = 4.9;
  double y_min_m = -2.0;
  double y_max_m = 2.0;
  double z_min_m = -0.3;        ///< below the floor, to see a step down
  double z_max_m = 0.75;        ///< the robot's height with its sensors
  double min_range_m = 0.3;     ///< nearest depth that counts
  double max_sigma_z_m = 0.06;  ///< a point whose depth is less certain is trimmed
  double roughness_m = 0.0015;  ///< 1 sigma that surfaces and calibration add to the sensor's depth noise
};

/// Sub-sections of the ROI (section 4.3).
struct SectionSettings {
  int x_res = 4;  ///< sections along x
  int y_res = 3;  ///< sections along y
  /// Along x: all equally long, or each as long as lets the sensor's error grow equally much, eq. (5).
  std::string layout = "uniform";
};

/// Statistical outlier removal (section 4.4).
struct OutlierSettings {
  int neighbors = 8;     ///< K
  double epsilon = 3.0;  ///< of eq. (6), in standard deviations
  /// How the neighbours are found, with the same result: by nanoflann's kd-tree, in a window of the image, or
  /// the window where it is the faster one.
  std::string search = "auto";
};

/// Recursive RANSAC (sections 4.5 and 4.6.1).
struct PlaneSettings {
  double normal_tolerance_deg =
      15.0;  ///< E: largest angle between the floor's normal and the section's last known one
  double max_floor_tilt_deg = 30.0;  ///< steeper normals are not remembered as a section's floor
  double threshold_sigmas = 2.5;     ///< alpha, in standard deviations of the sensor's disparity noise
  int max_hypotheses = 200;          ///< scored a plane
  int max_planes = 12;               ///< recursion limit: planes a section
  int min_points = 60;               ///< fewer points are no plane
  int seed = 1;                      ///< of the random choices
};

/// What each lattice cell saw.
struct CellSettings {
  double pitch_m = 0.05;             ///< side of a cell of the world-anchored lattice
  double significance_sigmas = 2.5;  ///< a cell leaves its plane when its own points say so this clearly
  int sight_line_stride_px = 4;      ///< every n-th pixel of every n-th row clears and expects
};

/// What is given up so that a frame is done in time: see Compromise.
struct TimeSettings {
  double deadline_ms = 100.0;  ///< live, from a frame's arrival; at most the camera's period
  std::string compromise =
      "auto";            ///< as far as the deadline asks for it, or never; far sections are skipped anyway
  int point_stride = 1;  ///< every n-th pixel of every n-th row, always
};

struct PerceptionSettings {
  RoiSettings roi;
  SectionSettings sections;
  OutlierSettings outliers;
  PlaneSettings planes;
  CellSettings cells;
  TimeSettings time;
};

template <class Visitor>
void visit_settings(Visitor& visit, RoiSettings& s) {
  visit("x_min_m", s.x_min_m, Allowed{-20.0, 20.0});
  visit("x_max_m", s.x_max_m, Allowed{-20.0, 20.0});
  visit("y_min_m", s.y_min_m, Allowed{-20.0, 20.0});
  visit("y_max_m", s.y_max_m, Allowed{-20.0, 20.0});
  visit("z_min_m", s.z_min_m, Allowed{-5.0, 5.0});
  visit("z_max_m", s.z_max_m, Allowed{-5.0, 5.0});
  visit("min_range_m", s.min_range_m, Allowed{0.01, 10.0});
  visit("max_sigma_z_m", s.max_sigma_z_m, Allowed{0.001, 1.0});
  visit("roughness_m", s.roughness_m, Allowed{0.0, 0.1});
}

template <class Visitor>
void visit_settings(Visitor& visit, SectionSettings& s) {
  visit("x_res", s.x_res, Allowed{1, 64});
  visit("y_res", s.y_res, Allowed{1, 64});
  visit("layout", s.layout, {"uniform", "error_growth"});
}

template <class Visitor>
void visit_settings(Visitor& visit, OutlierSettings& s) {
  visit("neighbors", s.neighbors, Allowed{1, 64});
  visit("epsilon", s.epsilon, Allowed{0.1, 100.0});
  visit("search", s.search, {"nanoflann", "window", "auto"});
}

template <class Visitor>
void visit_settings(Visitor& visit, PlaneSettings& s) {
  visit("normal_tolerance_deg", s.normal_tolerance_deg, Allowed{0.1, 60.0});
  visit("max_floor_tilt_deg", s.max_floor_tilt_deg, Allowed{1.0, 80.0});
  visit("threshold_sigmas", s.threshold_sigmas, Allowed{0.5, 20.0});
  visit("max_hypotheses", s.max_hypotheses, Allowed{1, 100000});
  visit("max_planes", s.max_planes, Allowed{1, 30000});
  visit("min_points", s.min_points, Allowed{3, 1000000});
  visit("seed", s.seed, Allowed{0, 2147483647});
}

template <class Visitor>
void visit_settings(Visitor& visit, CellSettings& s) {
  visit("pitch_m", s.pitch_m, Allowed{0.01, 1.0});
  visit("significance_sigmas", s.significance_sigmas, Allowed{0.0, 20.0});
  visit("sight_line_stride_px", s.sight_line_stride_px, Allowed{1, 64});
}

template <class Visitor>
void visit_settings(Visitor& visit, TimeSettings& s) {
  visit("deadline_ms", s.deadline_ms, Allowed{1.0, 10000.0});
  visit("compromise", s.compromise, {"auto", "never"});
  visit("point_stride", s.point_stride, Allowed{1, 16});
}

template <class Visitor>
void visit_settings(Visitor& visit, PerceptionSettings& s) {
  visit("roi", s.roi);
  visit("sections", s.sections);
  visit("outliers", s.outliers);
  visit("planes", s.planes);
  visit("cells", s.cells);
  visit("time", s.time);
}

}  // namespace floornav
