#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "perception/cell_points.hpp"
#include "perception/cell_window.hpp"
#include "perception/depth_frame.hpp"
#include "perception/measurement.hpp"
#include "perception/sections.hpp"
#include "perception/sensor_view.hpp"
#include "perception/settings.hpp"
#include "runtime/geometry/parallel.hpp"

namespace floornav {

/// What the rays of one frame say about cells apart from the points in them.
struct SightLines {
  std::vector<float>
      lowest_z_m;  ///< a cell of the window: lowest height at which a ray passed, +inf: none did
  std::vector<std::int32_t> returned;    ///< a cell: rays aimed at floor there that brought something back
  std::vector<std::int32_t> unreturned;  ///< a cell: rays aimed at floor there that brought nothing back

  [[nodiscard]] bool passed(std::int32_t cell) const {
    return lowest_z_m[static_cast<std::size_t>(cell)] < std::numeric_limits<float>::infinity();
  }
  /// True where floor was to be seen and almost nothing came back.
  [[nodiscard]] bool no_return(std::int32_t cell) const {
    constexpr std::int32_t kMinRays = 3;
    const auto c = static_cast<std::size_t>(cell);
    return unreturned[c] >= kMinRays && unreturned[c] >= 4 * returned[c];
  }
  void clear(std::size_t cells) {
    lowest_z_m.assign(cells, std::numeric_limits<float>::infinity());
    returned.assign(cells, 0);
    unreturned.assign(cells, 0);
  }
  void add(const SightLines& more);
};

/// Follows rays over the cells of done sections. A sample of those that returned clears what lies before
/// their end. Those that did not return are charged to the cell in which they should have met floor, unless
/// the border of the image or the shadow of something nearer (the projector's, or what one eye of a stereo
/// pair cannot see) explains them.
class SightLineTracer {
 public:
  SightLineTracer(const RoiSettings& roi, const CellSettings& cells, const SectionGrid& grid)
      : roi_(roi), cells_(cells), grid_(grid) {}

  void trace(const Measurer& measure, const SensorView& view, std::span<const SectionResult> sections,
             const CellWindow& window, Parallel& parallel, SightLines& out);

 private:
  void find_expected_floors(const SensorView& view, std::span<const SectionResult> sections);
  void find_done_cells(const SensorView& view, std::span<const SectionResult> sections,
                       const CellWindow& window);

  /// Neighbouring pixels of a row without return.
  struct Gap {
    std::int32_t width = 0;               ///< px; 0: the pixel returned
    float nearest_inverse_depth = 0.0F;   ///< 1/m, of the nearer of its two ends
    float farthest_inverse_depth = 0.0F;  ///< of the other one; 0 at the image's border
    bool at_border = false;               ///< of the image
  };
  /// What one worker holds.
  struct Worker {
    std::vector<float> inverse_depth;  ///< of the row in hand, a column; 0: no return
    std::vector<Gap> gap;              ///< of the row in hand, a column
    SightLines lines;
  };
  void measure_row(const Measurer& measure, int width, int row, Worker& worker) const;
  void pass_row(const Measurer& measure, const SensorView& view, int row, const CellWindow& window,
                Worker& worker) const;
  void expect_row(const SensorView& view, int row, const CellWindow& window, Worker& worker) const;
  [[nodiscard]] float expected_inverse_depth(const Eigen::Vector3f& ray, const Eigen::Matrix3f& R_body_sensor,
                                             const Eigen::Vector3f& origin) const;
  [[nodiscard]] static bool is_explained(const Gap& gap, float expected_inverse_depth,
                                         const SensorView& view);

  RoiSettings roi_;
  CellSettings cells_;
  SectionGrid grid_;
  InverseDepthPlane body_floor_;                   ///< z = 0 of the body frame
  std::vector<InverseDepthPlane> expected_floor_;  ///< a section
  std::vector<std::uint8_t> cell_done_;            ///< a cell of the window: lies in a done section
  std::vector<Worker> workers_;
};

}  // namespace floornav
