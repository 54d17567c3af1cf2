#pragma once

#include <string>

#include "kinect/depth_msg_t.hpp"
#include "tools/import/depth_image.hpp"

namespace floornav {

/// Depth counts and what one of them is.
struct KinectDepth {
  DepthImage image;
  double scale_m = 0.001;  ///< m a count
};

/// The depth of a kinect.frame_msg_t: in mm or raw 11-bit shift, plain or compressed by zlib. A shift s is a
/// depth of 8 fx 0.075 m / (1090 - s), as the users of these messages took it; fx in px. Throws
/// std::runtime_error that says what is wrong with any other message.
KinectDepth depth_of(const kinect::depth_msg_t& message, double fx);

}  // namespace floornav
