#include "perception/cell_sections.hpp"

#include <algorithm>

namespace floornav {

void CellSections::find(const CellWindow& window, const SectionGrid& grid, const Pose& T_world_body) {
  section_.resize(static_cast<std::size_t>(window.count()));
  near_.resize(section_.size());
  const Pose T_body_world = T_world_body.inverse();
  const double z = T_world_body.translation().z();
  const double pitch = window.lattice().pitch_m;
  const Eigen::Vector3f to_corner_x = (T_body_world.linear().col(0) * (0.5 * pitch)).cast<float>();
  const Eigen::Vector3f to_corner_y = (T_body_world.linear().col(1) * (0.5 * pitch)).cast<float>();
  const auto section_at = [&](const Eigen::Vector3f& p) { return grid.at(p.x(), p.y()); };
  for (std::int32_t number = 0; number < window.count(); ++number) {
    const CellIndex cell = window.cell(number);
    const Eigen::Vector3d world(window.lattice().center_of(cell.ix), window.lattice().center_of(cell.iy), z);
    const Eigen::Vector3f center = (T_body_world * world).cast<float>();
    const int section = section_at(center);
    const auto in_first_row = [&](const Eigen::Vector3f& corner) {
      return section_at(corner) < grid.y_res();
    };
    const auto n = static_cast<std::size_t>(number);
    section_[n] = static_cast<std::int16_t>(section);
    near_[n] = section >= 0 && section < grid.y_res() && in_first_row(center + to_corner_x + to_corner_y) &&
               in_first_row(center + to_corner_x - to_corner_y) &&
               in_first_row(center - to_corner_x + to_corner_y) &&
               in_first_row(center - to_corner_x - to_corner_y);
  }
}

}  // namespace floornav
