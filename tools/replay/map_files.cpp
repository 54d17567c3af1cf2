#include "tools/replay/map_files.hpp"

#include <limits>
#include <stdexcept>

#include <fmt/format.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "tools/replay/text_file.hpp"

namespace floornav {

namespace {

constexpr std::uint8_t kFreePixel = 254;
constexpr std::uint8_t kBlockedPixel = 0;
constexpr std::uint8_t kUnknownPixel = 205;

std::uint8_t pixel_of(VertexState state) {
  switch (state) {
    case VertexState::kFree:
      return kFreePixel;
    case VertexState::kBlocked:
      return kBlockedPixel;
    case VertexState::kUnknown:
      break;
  }
  return kUnknownPixel;
}

/// Writes an image whose pixel for a cell is `value(index of the cell)`.
template <class Pixel, class Value>
void write_image(const CellRectangle& cells, const std::filesystem::path& file, Value value) {
  cv::Mat_<Pixel> image(cells.height, cells.width);
  std::size_t cell = 0;
  for (int row = cells.height - 1; row >= 0; --row)
    for (int column = 0; column < cells.width; ++column, ++cell) image(row, column) = value(cell);
  bool written = false;
  try {
    written = cv::imwrite(file.string(), image);
  } catch (const cv::Exception&) {
    written = false;
  }
  if (!written) throw std::runtime_error(fmt::format("{}: cannot be written", file.string()));
}

void write_yaml(const CellRectangle& cells, const std::filesystem::path& file) {
  TextFile yaml(file);
  yaml.write(fmt::format(
      "# Local frame. origin: x, y in m of the lower left corner of the lower left pixel, yaw.\n"
      "image: map.pgm\nresolution: {}\norigin: [{:.4f}, {:.4f}, 0.0]\nnegate: 0\noccupied_thresh: 0.65\n"
      "free_thresh: 0.196\nmode: trinary\n"
      "# Same pixels, float32, NaN where unknown: belief 0 to 1, height in m.\n"
      "belief: belief.tiff\nheight: height.tiff\n",
      cells.resolution_m, cells.x_min_m(), cells.y_min_m()));
  yaml.close();
}

}  // namespace

void write_map_files(const MapRaster& map, const std::filesystem::path& folder) {
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  write_image<std::uint8_t>(map.cells, folder / "map.pgm",
                            [&](std::size_t i) { return pixel_of(map.state[i]); });
  write_image<float>(map.cells, folder / "belief.tiff", [&](std::size_t i) {
    return map.state[i] == VertexState::kUnknown ? kNone : static_cast<float>(map.belief[i]) / 255.0F;
  });
  write_image<float>(map.cells, folder / "height.tiff", [&](std::size_t i) { return map.height_m[i]; });
  write_yaml(map.cells, folder / "map.yaml");
}

}  // namespace floornav
