#pragma once

namespace floornav {

/// z of the normals of planes that are flatter than 30 degrees: they have a height of their own at a place.
/// Planes between these and sides are slanted: of things far away mostly a compromise between side and top.
inline constexpr float kLevelUpright = 0.87F;
/// z of the normals of planes that are steeper than 60 degrees: sides.
inline constexpr float kSideUpright = 0.5F;

}  // namespace floornav
