#include "tools/calibrate/board_picture.hpp"

#include <stdexcept>

#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace floornav {

void draw_rectified_pair(const cv::Mat& left, const cv::Mat& right, const Rectification& rectification,
                         const std::filesystem::path& file) {
  constexpr int kLines = 24;
  const cv::Scalar green(80, 200, 80);
  cv::Mat level_left;
  cv::Mat level_right;
  rectification.apply(left, right, level_left, level_right);
  cv::Mat both;
  cv::hconcat(level_left, level_right, both);
  cv::cvtColor(both, both, cv::COLOR_GRAY2BGR);
  for (int i = 1; i < kLines; ++i) {
    const int y = i * both.rows / kLines;
    cv::line(both, {0, y}, {both.cols, y}, green);
  }
  bool written = false;
  try {
    written = cv::imwrite(file.string(), both);
  } catch (const cv::Exception&) {
  }
  if (!written) throw std::runtime_error(fmt::format("{}: cannot be written", file.string()));
}

}  // namespace floornav
