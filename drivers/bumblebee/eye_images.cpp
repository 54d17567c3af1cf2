#include "drivers/bumblebee/eye_images.hpp"

#include <map>
#include <stdexcept>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

namespace floornav {
namespace {

/// OpenCV names a pattern by the second row's second and third pixel.
int conversion_of(const std::string& bayer) {
  static const std::map<std::string, int> kConversions = {{"RGGB", cv::COLOR_BayerBG2GRAY},
                                                          {"GRBG", cv::COLOR_BayerGB2GRAY},
                                                          {"GBRG", cv::COLOR_BayerGR2GRAY},
                                                          {"BGGR", cv::COLOR_BayerRG2GRAY}};
  const auto found = kConversions.find(bayer);
  if (found == kConversions.end()) throw std::runtime_error(fmt::format("\"{}\" is no Bayer pattern", bayer));
  return found->second;
}

}  // namespace

EyeImages::EyeImages(const FrameLayout& layout) : layout_(layout) {
  if (!layout.bayer.empty()) to_grey_ = conversion_of(layout.bayer);
}

const std::vector<cv::Mat>& EyeImages::split(std::span<const std::uint8_t> frame) {
  if (static_cast<std::int64_t>(frame.size()) != layout_.bytes())
    throw std::runtime_error(fmt::format("a frame of {} bytes instead of {}", frame.size(), layout_.bytes()));
  // OpenCV has no view of bytes that it may not write to; it does not write.
  const cv::Mat all(layout_.height, layout_.width, CV_8UC(layout_.eyes),
                    const_cast<std::uint8_t*>(frame.data()));
  cv::split(all, raw_);
  if (to_grey_ < 0) return raw_;
  grey_.resize(raw_.size());
  for (std::size_t eye = 0; eye < raw_.size(); ++eye) cv::cvtColor(raw_[eye], grey_[eye], to_grey_);
  return grey_;
}

}  // namespace floornav
