#include "tests/devices/firewire/bus/seen_eyes.hpp"

#include <cstring>
#include <stdexcept>

#include "tests/devices/scene_step.hpp"

namespace floornav {
namespace {

std::size_t image_bytes(const EyeSceneHeader& header) {
  return static_cast<std::size_t>(header.width) * static_cast<std::size_t>(header.height);
}

}  // namespace

SeenEyes::SeenEyes(const char* path) : file_(path, sizeof(EyeSceneHeader)) {
  std::memcpy(&header_, file_.bytes().data(), sizeof header_);
  const std::size_t wanted = sizeof header_ + static_cast<std::size_t>(header_.calibration_bytes) +
                             image_bytes(header_) * static_cast<std::size_t>(header_.eyes * header_.frames);
  if (header_.magic != EyeSceneHeader::kMagic || header_.frames < 1 || wanted != file_.bytes().size())
    throw std::runtime_error(std::string(path) + ": no file of eye images");
}

std::string_view SeenEyes::calibration() const {
  return {reinterpret_cast<const char*>(file_.bytes().data()) + sizeof header_,
          static_cast<std::size_t>(header_.calibration_bytes)};
}

std::span<const std::uint8_t> SeenEyes::image(std::int64_t step, int eye) const {
  const std::int64_t frame = scene_frame_at(step, header_.frames, header_.there_and_back != 0);
  const std::size_t before = sizeof header_ + static_cast<std::size_t>(header_.calibration_bytes) +
                             static_cast<std::size_t>(frame * header_.eyes + eye) * image_bytes(header_);
  return {reinterpret_cast<const std::uint8_t*>(file_.bytes().data()) + before, image_bytes(header_)};
}

}  // namespace floornav
