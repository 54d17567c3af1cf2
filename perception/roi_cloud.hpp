#pragma once

#include <cstdint>
#include <vector>

#include "perception/depth_frame.hpp"
#include "perception/evidence.hpp"
#include "perception/measured_image.hpp"
#include "perception/pixel_kernel.hpp"
#include "perception/sections.hpp"
#include "perception/sensor_view.hpp"
#include "perception/settings.hpp"
#include "runtime/geometry/parallel.hpp"

namespace floornav {

/// The points of one frame inside the ROI, as structure of arrays in the sensor frame, sorted by section and
/// within a section row by row of the image.
struct RoiCloud {
  std::vector<float> x, y, z;             ///< m
  std::vector<float> ray_x, ray_y;        ///< direction of the pixel's ray at depth 1
  std::vector<float> inverse_depth;       ///< 1/m
  std::vector<float> certainty;           ///< m: 1 / (1 sigma of inverse_depth)
  std::vector<std::int32_t> pixel;        ///< row * width + column
  std::vector<std::int32_t> block;        ///< of PixelBlocks
  std::vector<std::int32_t> section_end;  ///< section s holds the points [section_begin(s), section_end[s])

  [[nodiscard]] std::int32_t section_begin(int section) const {
    return section == 0 ? 0 : section_end[static_cast<std::size_t>(section) - 1];
  }
  [[nodiscard]] std::int32_t section_size(int section) const {
    return section_end[static_cast<std::size_t>(section)] - section_begin(section);
  }
  [[nodiscard]] std::size_t size() const { return x.size(); }
};

/// Makes points of pixels and clips them to the ROI (sections 3.4 and 4.2) and to the noise bounds of eq. (3)
/// / (4).
class RoiClipper {
 public:
  RoiClipper(const RoiSettings& settings, const SectionGrid& grid) : settings_(settings), grid_(grid) {}

  /// Finds the points and gives each a place in `cloud`; tells what became of the pixels. Bands of rows are
  /// independent work.
  PixelCounts clip(const DepthFrame& frame, const SensorView& view, Parallel& parallel, RoiCloud& cloud);

  /// Fills the places of the sections [first, end); each section once.
  void fill(int first_section, int end_section, Parallel& parallel, RoiCloud& cloud);

  /// All that the last frame measured, inside the ROI or not.
  [[nodiscard]] const MeasuredImage& image() const { return image_; }

 private:
  /// Neighbouring pixels [column, end) of one section in a row.
  struct Run {
    std::int32_t row, column, end;
    std::int32_t section;
  };
  struct Band {
    PixelCounts counts;
    std::vector<Run> runs;
    std::vector<std::int32_t> next;  ///< a section: number of points, then the place of the next one
  };
  void find_rays(const Pinhole& camera);
  void sort_band(const DepthFrame& frame, const SensorView& view, int first_row, int end_row, Band& band);
  void add_runs(int row, const std::int16_t* sections, Band& band) const;
  void lay_out(RoiCloud& cloud);
  void fill_band(int first_section, int end_section, Band& band, RoiCloud& cloud) const;
  void fill_run(const Run& run, std::size_t place, RoiCloud& cloud) const;

  RoiSettings settings_;
  SectionGrid grid_;
  MeasuredImage image_;
  std::vector<Band> bands_;
  std::vector<float> ray_x_, ray_y_;            ///< of a column (padded as the image), of a row
  std::vector<std::int16_t> section_of_pixel_;  ///< a place of the image
};

}  // namespace floornav
