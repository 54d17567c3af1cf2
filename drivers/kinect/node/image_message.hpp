#pragma once

#include "drivers/kinect/color_image.hpp"
#include "floornav/image_t.hpp"

namespace floornav {

/// The image as JPEG of this quality, 1 to 100.
image_t image_message(const ColorImage& image, std::int64_t utime_us, int jpeg_quality);

}  // namespace floornav
