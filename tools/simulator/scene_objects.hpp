#pragma once

#include "tools/simulator/scene.hpp"
#include "tools/simulator/scene_section.hpp"

namespace floornav {

/// Adds one element of a scene file's `objects` (box, ramp, wall ...) to the scene. Throws SceneError.
void read_object(SceneSection& object, Scene& scene);

}  // namespace floornav
