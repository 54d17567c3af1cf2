#pragma once

#include <filesystem>
#include <vector>

#include <Eigen/Core>

namespace floornav {

/// A cloud in image order, row by row, in the sensor's frame (x right, y down, z forward), m; not finite = no
/// point.
struct OrganisedCloud {
  int width = 0;
  int height = 0;
  std::vector<Eigen::Vector3f> points;
};

/// Reads x, y and z of an organised .pcd (0.7): ascii, binary or binary_compressed. VIEWPOINT is left alone.
/// Throws std::runtime_error "FILE: what is wrong" for a damaged file and for a cloud that is not an image
/// (HEIGHT 1).
OrganisedCloud read_pcd(const std::filesystem::path& file);

}  // namespace floornav
