#include "tools/import/image_file.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include <fmt/format.h>
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

cv::Mat read_image(const std::filesystem::path& file, ImageForm form) {
  const Bytes bytes = read_bytes(file);
  if (bytes.empty()) refuse(file, "is empty");
  if (is_png(bytes) && !is_whole_png(bytes)) refuse(file, "damaged PNG");
  cv::Mat image;
  try {
    image = cv::imdecode(bytes, form == ImageForm::kGrey ? cv::IMREAD_GRAYSCALE : cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception&) {
    refuse(file, "damaged image");
  }
  if (image.empty()) refuse(file, "no image that can be read");
  return image;
}

std::vector<std::filesystem::path> images_in(const std::filesystem::path& folder,
                                             std::span<const std::string_view> endings) {
  if (!std::filesystem::is_directory(folder)) refuse(folder, "is not a folder");
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (std::ranges::count(endings, entry.path().extension().string()) > 0) files.push_back(entry.path());
  if (files.empty()) refuse(folder, fmt::format("holds no {} image", fmt::join(endings, ", ")));
  std::ranges::sort(files);
  return files;
}

}  // namespace floornav
