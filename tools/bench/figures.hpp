#pragma once

#include <filesystem>
#include <vector>

namespace floornav {

/// Figure 1: the test bed as a Kinect sees it, beside its grid-map of 0.1, 0.2 and 0.3 m; a picture each.
std::vector<std::filesystem::path> draw_figure_1(const std::filesystem::path& folder);

/// Figure 2: the error of depth against distance: eq. (3) and (4), and what the simulated sensors show.
std::vector<std::filesystem::path> draw_figure_2(const std::filesystem::path& folder);

/// Figure 7: the terrain map of a drive through a scene. Throws SceneError for a wrong scene file.
std::vector<std::filesystem::path> draw_figure_7(const std::filesystem::path& scene,
                                                 const std::filesystem::path& folder);

}  // namespace floornav
