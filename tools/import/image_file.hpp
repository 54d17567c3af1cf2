#pragma once

#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include <opencv2/core.hpp>

namespace floornav {

enum class ImageForm { kAsItIs, kGrey };

/// Reads an image, as the file has it or as 8-bit grey. Throws std::runtime_error "FILE: what is wrong".
cv::Mat read_image(const std::filesystem::path& file, ImageForm form);

/// The files of a folder with one of these endings (".png"), by name. Throws std::runtime_error where there
/// is none.
std::vector<std::filesystem::path> images_in(const std::filesystem::path& folder,
                                             std::span<const std::string_view> endings);

}  // namespace floornav
