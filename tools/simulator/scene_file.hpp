#pragma once

#include <string>

#include "tools/simulator/scene.hpp"
#include "tools/simulator/scene_section.hpp"

namespace floornav {

/// Reads a scene file (YAML; tools/simulator/scenes/README.md lists its keys). Throws SceneError with file,
/// key and reason for one that cannot be read, has an unknown key, an impossible value or things that
/// contradict each other.
Scene load_scene(const std::string& path);

/// The same from text; `name` stands for the file in messages.
Scene parse_scene(const std::string& text, const std::string& name);

}  // namespace floornav
