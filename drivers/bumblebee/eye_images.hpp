#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

namespace floornav {

/// How a raw frame holds its eyes' images: a byte of each in turn.
struct FrameLayout {
  int width = 0;      ///< px, of one eye
  int height = 0;     ///< px
  int eyes = 2;       ///< 2: right, left; 3: right, centre, left
  std::string bayer;  ///< of a colour camera, "GBRG" say; empty: mono

  [[nodiscard]] std::int64_t bytes() const { return std::int64_t{width} * height * eyes; }
};

/// Takes the images of raw frames apart, and the colours out.
class EyeImages {
 public:
  /// Throws std::runtime_error for a Bayer pattern that does not exist.
  explicit EyeImages(const FrameLayout& layout);

  /// Grey images, in the layout's order; valid until the next call. Throws std::runtime_error for a frame of
  /// another size.
  const std::vector<cv::Mat>& split(std::span<const std::uint8_t> frame);

 private:
  FrameLayout layout_;
  int to_grey_ = -1;  ///< OpenCV's conversion; -1: none
  std::vector<cv::Mat> raw_;
  std::vector<cv::Mat> grey_;
};

}  // namespace floornav
