#pragma once

#include "runtime/geometry/pinhole.hpp"
#include "tools/import/depth_image.hpp"
#include "tools/import/pcd_file.hpp"

namespace floornav {

/// The pinhole camera on whose rays a cloud lies best, by least squares over x/z and y/z. Throws
/// std::runtime_error where the cloud has too few points in front of the camera to tell.
Pinhole fit_pinhole(const OrganisedCloud& cloud);

/// How far the cloud's points project from their own pixels, px.
struct RayResidual {
  double rms_px = 0;
  double worst_px = 0;
};
RayResidual ray_residual(const OrganisedCloud& cloud, const Pinhole& camera);

/// The cloud's z as an image. Counts are millimetres where that is exact, else as fine as 16 bits reach.
struct ScaledDepth {
  DepthImage image;
  double scale_m = 0.001;       ///< m a count
  double worst_rounding_m = 0;  ///< largest |z - pixel * scale|
};
ScaledDepth depth_of(const OrganisedCloud& cloud);

}  // namespace floornav
