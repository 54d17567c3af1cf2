#include "tools/import/depth_image.hpp"

#include <array>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "tools/import/image_file.hpp"

namespace floornav {

DepthImage read_depth_image(const std::filesystem::path& file) {
  const cv::Mat image = read_image(file, ImageForm::kAsItIs);
  if (image.type() != CV_16UC1)
    throw std::runtime_error(fmt::format("{}: has {} channel(s) of {} bits; a depth image has one of 16",
                                         file.string(), image.channels(), 8 * image.elemSize1()));
  DepthImage depth{image.cols, image.rows, {}};
  depth.pixels.reserve(image.total());
  for (int row = 0; row < image.rows; ++row)
    depth.pixels.insert(depth.pixels.end(), image.ptr<std::uint16_t>(row),
                        image.ptr<std::uint16_t>(row) + image.cols);
  return depth;
}

std::vector<std::filesystem::path> depth_images_in(const std::filesystem::path& folder) {
  constexpr std::array<std::string_view, 4> kEndings{".png", ".tif", ".tiff", ".pgm"};
  return images_in(folder, kEndings);
}

}  // namespace floornav
