#include "tools/import/tum_folder.hpp"

#include <algorithm>
#include <fstream>
#include <functional>
#include <sstream>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "tools/import/decimal_time.hpp"

namespace floornav {

namespace {

/// Calls `take` with the words of each line that is not empty and no comment; false from it names the line in
/// an error.
void for_each_line(const std::filesystem::path& file,
                   const std::function<bool(std::int64_t utime_us, std::istringstream& words)>& take) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error(fmt::format("{}: cannot be opened", file.string()));
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    std::istringstream words(line);
    std::string time;
    if (!(words >> time) || time.front() == '#') continue;
    const auto utime_us = utime_from_seconds(time);
    if (!utime_us || !take(*utime_us, words))
      throw std::runtime_error(fmt::format("{}: line {} is not in the TUM form", file.string(), number));
  }
}

}  // namespace

std::vector<ListedImage> read_image_list(const std::filesystem::path& list) {
  std::vector<ListedImage> images;
  for_each_line(list, [&](std::int64_t utime_us, std::istringstream& words) {
    std::string name;
    if (!(words >> name)) return false;
    images.push_back({utime_us, list.parent_path() / name});
    return true;
  });
  std::ranges::stable_sort(images, {}, &ListedImage::utime_us);
  return images;
}

std::vector<StampedPose> read_trajectory(const std::filesystem::path& file) {
  std::vector<StampedPose> poses;
  for_each_line(file, [&](std::int64_t utime_us, std::istringstream& words) {
    double position[3];
    double xyzw[4];
    if (!(words >> position[0] >> position[1] >> position[2] >> xyzw[0] >> xyzw[1] >> xyzw[2] >> xyzw[3]))
      return false;
    const double wxyz[4] = {xyzw[3], xyzw[0], xyzw[1], xyzw[2]};
    try {
      poses.push_back({utime_us, pose_from_arrays(position, wxyz)});
    } catch (const std::invalid_argument&) {
      return false;
    }
    return true;
  });
  std::ranges::stable_sort(poses, {}, &StampedPose::utime_us);
  const auto repeated = std::ranges::unique(poses, {}, &StampedPose::utime_us);
  poses.erase(repeated.begin(), repeated.end());
  return poses;
}

}  // namespace floornav
