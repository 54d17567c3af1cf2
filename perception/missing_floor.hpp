#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "perception/cell_points.hpp"
#include "perception/cell_sections.hpp"
#include "perception/cell_window.hpp"
#include "perception/measured_image.hpp"
#include "perception/sensor_view.hpp"
#include "perception/settings.hpp"
#include "runtime/geometry/parallel.hpp"

namespace floornav {

/// Finds cells where floor was to be seen and almost nothing came back.
///
/// Rays that brought nothing back are charged to the cell in which they should have met floor, unless the
/// border of the image or the shadow of something nearer (the projector's, or what one eye of a stereo pair
/// cannot see) explains them. A cell to which enough are charged, and without points, counts those that did
/// come back.
class MissingFloorFinder {
 public:
  MissingFloorFinder(const RoiSettings& roi, const SectionGrid& grid) : roi_(roi), grid_(grid) {}

  /// Writes 1 to `missing` (a cell of the window) for such cells among those for which `is_asked` holds; the
  /// others stay. `sections`: those that are known so far, from the nearest on.
  void find(const MeasuredImage& image, const SensorView& view, std::span<const SectionResult> sections,
            const CellWindow& window, const CellSections& cell_sections, const CellPoints& points,
            const std::function<bool(std::int32_t)>& is_asked, Parallel& parallel,
            std::vector<std::uint8_t>& missing);

 private:
  /// Neighbouring pixels of a row without return.
  struct Gap {
    int begin, end;                ///< columns
    float nearest_inverse_depth;   ///< 1/m, of the nearer of its two ends
    float farthest_inverse_depth;  ///< of the other one; 0 at the image's border
    bool at_border;                ///< of the image
  };
  /// Where one frame's rays should meet floor.
  struct Aim {
    Eigen::Matrix3f R_world_sensor, R_body_sensor;
    Eigen::Vector3f origin;  ///< of the sensor, body frame
    Eigen::Vector3d sensor;  ///< world
    float max_depth, min_depth;
  };
  /// What one worker charges.
  struct Charges {
    std::vector<std::int32_t> count;  ///< a cell
    std::vector<std::int32_t> cells;  ///< those with a count
  };
  void find_expected_floors(const SensorView& view, std::span<const SectionResult> sections);
  [[nodiscard]] float expected_inverse_depth(const Eigen::Vector3f& ray, const Aim& aim) const;
  [[nodiscard]] std::int32_t aimed_cell(const Eigen::Vector3f& ray, float expected, const Aim& aim,
                                        const CellWindow& window) const;
  void charge_row(const MeasuredImage& image, const SensorView& view, int row, const Aim& aim,
                  const CellWindow& window, Charges& charges) const;
  void charge_gap(const Gap& gap, const SensorView& view, int row, const Aim& aim, const CellWindow& window,
                  Charges& charges) const;
  [[nodiscard]] bool is_missing(std::int32_t cell, const MeasuredImage& image, const SensorView& view,
                                const Aim& aim, const CellWindow& window, int section,
                                std::int32_t unreturned) const;
  [[nodiscard]] static bool is_explained(const Gap& gap, float expected_inverse_depth,
                                         const SensorView& view);

  RoiSettings roi_;
  SectionGrid grid_;
  InverseDepthPlane body_floor_;                   ///< z = 0 of the body frame
  std::vector<InverseDepthPlane> expected_floor_;  ///< a section
  std::vector<Charges> workers_;
  std::vector<std::int32_t> unreturned_;  ///< a cell
  std::vector<std::int32_t> suspects_;    ///< cells to be looked at
};

}  // namespace floornav
