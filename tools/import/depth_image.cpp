#include "tools/import/depth_image.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <zlib.h>

namespace floornav {

namespace {

using Bytes = std::vector<std::uint8_t>;

[[noreturn]] void refuse(const std::filesystem::path& file, std::string_view why) {
  throw std::runtime_error(fmt::format("{}: {}", file.string(), why));
}

Bytes read_bytes(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in || std::filesystem::is_directory(file)) refuse(file, "cannot be opened");
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

std::uint32_t big_endian(std::span<const std::uint8_t> four) {
  return std::uint32_t{four[0]} << 24 | std::uint32_t{four[1]} << 16 | std::uint32_t{four[2]} << 8 | four[3];
}

constexpr std::array<std::uint8_t, 8> kPngSignature{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};

bool is_png(const Bytes& bytes) {
  return bytes.size() >= kPngSignature.size() &&
         std::equal(kPngSignature.begin(), kPngSignature.end(), bytes.begin());
}

/// Every chunk whole and with its checksum, up to the end chunk: libpng would print, and let some of it pass.
bool is_whole_png(std::span<const std::uint8_t> bytes) {
  constexpr std::size_t kFrame = 12;  // length, type, checksum
  for (auto rest = bytes.subspan(kPngSignature.size()); rest.size() >= kFrame;) {
    const std::size_t length = big_endian(rest);
    if (length > rest.size() - kFrame) return false;
    const auto type_and_data = rest.subspan(4, 4 + length);
    const auto checksum = crc32(0, type_and_data.data(), static_cast<uInt>(type_and_data.size()));
    if (checksum != big_endian(rest.subspan(8 + length))) return false;
    if (std::equal(type_and_data.begin(), type_and_data.begin() + 4, "IEND")) return true;
    rest = rest.subspan(kFrame + length);
  }
  return false;
}

}  // namespace

DepthImage read_depth_image(const std::filesystem::path& file) {
  const Bytes bytes = read_bytes(file);
  if (bytes.empty()) refuse(file, "is empty");
  if (is_png(bytes) && !is_whole_png(bytes)) refuse(file, "damaged PNG");
  cv::Mat image;
  try {
    image = cv::imdecode(bytes, cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception&) {
    refuse(file, "damaged image");
  }
  if (image.empty()) refuse(file, "no image that can be read");
  if (image.type() != CV_16UC1)
    refuse(file, fmt::format("has {} channel(s) of {} bits; a depth image has one of 16", image.channels(),
                             8 * image.elemSize1()));
  DepthImage depth{image.cols, image.rows, {}};
  depth.pixels.reserve(image.total());
  for (int row = 0; row < image.rows; ++row)
    depth.pixels.insert(depth.pixels.end(), image.ptr<std::uint16_t>(row),
                        image.ptr<std::uint16_t>(row) + image.cols);
  return depth;
}

std::vector<std::filesystem::path> depth_images_in(const std::filesystem::path& folder) {
  if (!std::filesystem::is_directory(folder)) refuse(folder, "is not a folder");
  constexpr std::array<std::string_view, 4> kEndings{".png", ".tif", ".tiff", ".pgm"};
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (std::ranges::count(kEndings, entry.path().extension().string()) > 0) files.push_back(entry.path());
  if (files.empty()) refuse(folder, "holds no .png, .tif, .tiff or .pgm image");
  std::ranges::sort(files);
  return files;
}

}  // namespace floornav
