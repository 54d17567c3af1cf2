#pragma once

#include "runtime/geometry/pinhole.hpp"

namespace floornav {

/// The ideal camera whose image of this size (px) spans these angles (rad) between the outer edges of its
/// outermost pixels. Throws std::invalid_argument for angles that no pinhole has.
Pinhole pinhole_of_field_of_view(double horizontal_rad, double vertical_rad, int width, int height);

}  // namespace floornav
