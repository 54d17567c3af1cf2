#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "perception/cell_kernel.hpp"
#include "perception/cell_sections.hpp"
#include "perception/cell_window.hpp"
#include "perception/roi_cloud.hpp"
#include "perception/section_result.hpp"
#include "perception/sensor_view.hpp"
#include "runtime/geometry/parallel.hpp"

namespace floornav {

/// One point as its cell sees it; see PlacedPoints.
struct CellPoint {
  std::int16_t surfel;  ///< index into FloorEvidence::surfels, -1: on no plane
  float z_m;
  float rise_m;
  float var_m2;
  float common_m2;
};

/// Some of the frame's points sorted by cell; within a cell in the cloud's order.
struct CellPoints {
  std::vector<CellPoint> points;
  std::vector<std::int32_t> cell_end;  ///< a cell of the window: end of its points

  [[nodiscard]] std::span<const CellPoint> of(std::int32_t cell) const {
    const std::int32_t begin = cell == 0 ? 0 : cell_end[static_cast<std::size_t>(cell) - 1];
    const std::int32_t end = cell_end[static_cast<std::size_t>(cell)];
    return {points.data() + begin, static_cast<std::size_t>(end - begin)};
  }
};

/// Puts the points of done sections into cells. A point on a plane is moved along its ray onto the plane
/// first: so its noise, which runs along the ray, does not carry it into a neighbouring cell.
class CellSorter {
 public:
  explicit CellSorter(const RoiSettings& roi) : roughness_m_(static_cast<float>(roi.roughness_m)) {}

  /// Begins a frame.
  void begin(const RoiCloud& cloud) { placed_.resize(cloud.size()); }
  /// Places the points of the sections [first, end) of which the planes are known.
  void place(const RoiCloud& cloud, std::span<const std::int16_t> label,
             std::span<const SectionResult> sections, int first, int end, const SensorView& view,
             const CellWindow& window, Parallel& parallel);
  /// Sorts the placed points of the sections [0, end) that lie in cells near the robot, or in the others.
  void sort(const RoiCloud& cloud, std::span<const std::int16_t> label,
            std::span<const SectionResult> sections, int end, const CellSections& cells, bool is_near,
            Parallel& parallel, CellPoints& out);

 private:
  /// Some points of one section.
  struct Piece {
    int section;
    std::int32_t begin, end;
  };
  /// Points that one worker sorts: [begin, end).
  struct Share {
    std::int32_t begin, end;
    std::vector<std::int32_t> next;  ///< no cell, each cell: number of points, then the place of the next one
  };
  void cut_pieces(const RoiCloud& cloud, int first, int end);
  void count_points(Share& share, std::size_t cells) const;
  void lay_out(const CellSections& cells, bool is_near, CellPoints& out);
  void fill_in(Share& share, const RoiCloud& cloud, std::span<const std::int16_t> label,
               std::span<const SectionResult> sections, CellPoints& out) const;

  float roughness_m_;
  std::vector<Piece> pieces_;
  PlanesInWorld planes_;  ///< a surfel
  PlacedPoints placed_;
  std::vector<Share> shares_;
};

}  // namespace floornav
