#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "perception/evidence.hpp"

namespace floornav {

/// How much of a cell a frame shows.
enum class Coverage : std::uint8_t {
  kWhole,
  kPart,     ///< a good part of it is hidden
  kGlimpse,  ///< hardly seen, behind the side of something, or floor with the outline of something across it
};

/// How fully a frame shows each cell, judged by the points of the cells around it that show the same surface.
///
/// Beside a thing that hides most of a cell a few points of floor are left, and the foot of a wall lies so
/// near to the floor that some of its points pass for floor behind it. Such a glimpse says nothing of the
/// rest of the cell, and must not make it floor.
class ViewCoverage {
 public:
  /// `same_surface_m`: how far two heights may differ and still be one surface.
  explicit ViewCoverage(float same_surface_m) : same_surface_m_(same_surface_m) {}

  /// Takes a frame. `entries`: places in FloorEvidence::cells.
  void take(const FloorEvidence& evidence, std::span<const std::uint32_t> entries);

  /// Of the plane that decides a cell; things that are no floor count as seen whole.
  [[nodiscard]] Coverage of(const FloorEvidence& evidence, std::uint32_t entry) const;

 private:
  /// A cell's plane; ordered by points.
  struct Plane {
    std::int32_t points = 0;
    std::uint32_t entry = 0;
  };

  void begin(const FloorEvidence& evidence, std::span<const std::uint32_t> entries);
  void find_fullest();
  [[nodiscard]] std::size_t place_of(CellIndex cell) const {
    const std::int32_t place = (cell.ix - origin_.ix) * width_ + cell.iy - origin_.iy;
    return static_cast<std::size_t>(place);
  }
  [[nodiscard]] bool holds(CellIndex cell) const {
    return cell.ix >= origin_.ix && cell.ix < origin_.ix + length_ && cell.iy >= origin_.iy &&
           cell.iy < origin_.iy + width_;
  }
  /// Whether no level plane was seen in some cell around.
  [[nodiscard]] bool is_beside_unseen(CellIndex cell) const;
  [[nodiscard]] bool is_behind_side(const FloorEvidence& evidence, const CellEvidence& cell) const;

  float same_surface_m_;
  std::int32_t range_cells_ = 1;
  Eigen::Vector3d sensor_m_ = Eigen::Vector3d::Zero();
  CellIndex origin_;
  std::int32_t length_ = 0;             ///< along x
  std::int32_t width_ = 0;              ///< along y: the cells that lie one after the other
  std::vector<Plane> fullest_;          ///< a cell: of those around it the one with the most points
  std::vector<Plane> along_y_;          ///< the same, of those in its row only
  std::vector<std::uint8_t> is_level_;  ///< a cell: a level plane decides it
  std::vector<float> side_top_z_m_;     ///< a cell: of the sides in it, -infinity: none
};

}  // namespace floornav
