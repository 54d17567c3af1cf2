#pragma once

#include "perception/inverse_depth_plane.hpp"

namespace floornav {

/// What the floors of one frame's sections say together. A small patch of floor tells its tilt badly, since
/// neighbouring pixels err alike: there the common floor decides the tilt, and more the less the patch knows.
class FloorAgreement {
 public:
  void clear() { common_ = {}; }
  void add(const PlaneFit& floor) { common_ += floor; }

  /// The floor of a section, its tilt drawn towards the common one's; as it is where the two contradict each
  /// other, as floor and ramp do.
  [[nodiscard]] InverseDepthPlane settle(const PlaneFit& floor, const InverseDepthPlane& plane) const;

 private:
  PlaneFit common_;
};

}  // namespace floornav
