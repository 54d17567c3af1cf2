#include "drivers/kinect/node/image_message.hpp"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace floornav {

image_t image_message(const ColorImage& image, std::int64_t utime_us, int jpeg_quality) {
  // OpenCV has no view of bytes that it may not write to; it does not write.
  const cv::Mat rgb(image.height, image.width, CV_8UC3, const_cast<std::uint8_t*>(image.rgb.data()));
  cv::Mat bgr;
  cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
  image_t message{};
  message.utime = utime_us;
  message.width = image.width;
  message.height = image.height;
  message.pixelformat = image_t::PIXEL_FORMAT_MJPEG;
  cv::imencode(".jpg", bgr, message.data, {cv::IMWRITE_JPEG_QUALITY, jpeg_quality});
  message.size = static_cast<std::int32_t>(message.data.size());
  return message;
}

}  // namespace floornav
