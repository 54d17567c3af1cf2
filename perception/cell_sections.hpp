#pragma once

#include <cstdint>
#include <vector>

#include "perception/cell_window.hpp"
#include "perception/sections.hpp"

namespace floornav {

/// Which section each cell of the window belongs to: that of its centre.
class CellSections {
 public:
  void find(const CellWindow& window, const SectionGrid& grid, const Pose& T_world_body);

  /// Cells of the window.
  [[nodiscard]] std::size_t size() const { return section_.size(); }
  /// -1 outside the ROI.
  [[nodiscard]] std::int16_t of(std::int32_t cell) const { return section_[static_cast<std::size_t>(cell)]; }
  /// True where no corner of the cell reaches into a row beyond the nearest: all of its evidence is known
  /// when the nearest row is done.
  [[nodiscard]] bool is_near(std::int32_t cell) const { return near_[static_cast<std::size_t>(cell)] != 0; }

 private:
  std::vector<std::int16_t> section_;  ///< a cell
  std::vector<std::uint8_t> near_;     ///< a cell
};

}  // namespace floornav
