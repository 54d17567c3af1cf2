#pragma once

#include "drivers/kinect/node/depth_device.hpp"
#include "drivers/kinect/settings.hpp"
#include "floornav/depth_cloud_t.hpp"

namespace floornav {

/// All of a whole frame's message that stays the same from frame to frame of an open stream.
depth_cloud_t cloud_of(const DepthStream& stream, const KinectSettings& settings);

}  // namespace floornav
