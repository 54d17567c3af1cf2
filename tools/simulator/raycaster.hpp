#pragma once

#include <limits>
#include <span>

#include "runtime/geometry/pinhole.hpp"
#include "runtime/geometry/pose.hpp"
#include "tools/simulator/shapes.hpp"

namespace floornav {

/// Depth of a pixel whose ray meets nothing.
inline constexpr float kNoHit = std::numeric_limits<float>::infinity();

/// The exact depth Z along the optical axis (m) of what each pixel's ray meets first, row by row; `depth`
/// holds width x height values. A camera inside a solid does not see that solid.
void cast_depth(const Shapes& shapes, const Pinhole& camera, const Pose& T_world_sensor,
                std::span<float> depth);

/// The same for what stands in the scene besides: nearer things replace what `depth` holds.
void cast_solids(const Shapes& shapes, const Pinhole& camera, const Pose& T_world_sensor,
                 std::span<float> depth);

}  // namespace floornav
