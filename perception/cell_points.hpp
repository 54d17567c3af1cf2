#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "perception/cell_window.hpp"
#include "perception/evidence.hpp"
#include "perception/roi_cloud.hpp"
#include "perception/section_planes.hpp"
#include "perception/sensor_view.hpp"
#include "runtime/geometry/parallel.hpp"

namespace floornav {

/// One point as its cell sees it. Heights: z in the local world frame, m.
struct CellPoint {
  std::int16_t surfel;  ///< index into FloorEvidence::surfels, -1: on no plane
  float z_m;            ///< of the point moved along its ray onto its plane; as measured where it has none
  float rise_m;         ///< vertical distance of the measured surface above the plane; 0 without a plane
  float var_m2;         ///< of rise_m, or of z_m without a plane, by eq. (3) / (4)
  float common_m2;      ///< variance that the cell's points have in common: their mean keeps it
};

/// The points of the frame sorted by cell; within a cell in the cloud's order.
struct CellPoints {
  std::vector<CellPoint> points;
  std::vector<std::int32_t> cell_end;  ///< a cell of the window: end of its points

  [[nodiscard]] std::span<const CellPoint> of(std::int32_t cell) const {
    const std::int32_t begin = cell == 0 ? 0 : cell_end[static_cast<std::size_t>(cell) - 1];
    const std::int32_t end = cell_end[static_cast<std::size_t>(cell)];
    return {points.data() + begin, static_cast<std::size_t>(end - begin)};
  }
};

/// What was found in one section.
struct SectionResult {
  bool done = false;
  std::vector<SectionPlane> planes;
  std::vector<Surfel> surfels;    ///< of the planes
  std::int16_t first_surfel = 0;  ///< the surfel of planes[k] is first_surfel + k
};

/// Puts the points of done sections into cells. A point on a plane is moved along its ray onto the plane
/// first: so its noise, which runs along the ray, does not carry it into a neighbouring cell.
class CellSorter {
 public:
  explicit CellSorter(const RoiSettings& roi) : roughness_m_(static_cast<float>(roi.roughness_m)) {}

  void sort(const RoiCloud& cloud, std::span<const std::int16_t> label,
            std::span<const SectionResult> sections, const SensorView& view, const CellWindow& window,
            Parallel& parallel, CellPoints& out);

 private:
  /// Some points of one section.
  struct Piece {
    int section;
    std::int32_t begin, end;
  };
  /// A plane as the cells need it.
  struct PlaneInWorld {
    InverseDepthPlane plane;
    Eigen::Vector3f normal;  ///< sensor frame
    float upright;           ///< z of the normal in the world frame
  };
  void cut_pieces(const RoiCloud& cloud, std::span<const SectionResult> sections);
  void find_planes(std::span<const SectionResult> sections, const SensorView& view);
  void place_points(const RoiCloud& cloud, std::span<const std::int16_t> label, const Piece& piece,
                    std::int16_t first_surfel, const SensorView& view, const CellWindow& window);

  float roughness_m_;
  std::vector<Piece> pieces_;
  std::vector<PlaneInWorld> planes_;  ///< a surfel
  std::vector<std::int32_t> cell_;    ///< a point of the cloud: its cell, -1 none
  std::vector<CellPoint> placed_;     ///< a point of the cloud
};

}  // namespace floornav
