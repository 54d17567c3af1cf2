#include "tests/devices/kinect/plugin/scene.hpp"

#include <stdexcept>
#include <string>

namespace floornav {
namespace {

std::size_t bytes_of(const SceneHeader& header) {
  return sizeof(SceneHeader) + static_cast<std::size_t>(header.width) *
                                   static_cast<std::size_t>(header.height) *
                                   static_cast<std::size_t>(header.frames) * sizeof(std::uint16_t);
}

}  // namespace

Scene::Scene(const char* path) : file_(path, sizeof(SceneHeader)) {
  if (header().magic != SceneHeader::kMagic || header().frames < 1 ||
      bytes_of(header()) != file_.bytes().size())
    throw std::runtime_error(std::string(path) + ": not a scene file");
}

std::span<const std::uint16_t> Scene::frame_at(std::int64_t step) const {
  const std::size_t pixels =
      static_cast<std::size_t>(header().width) * static_cast<std::size_t>(header().height);
  const auto* frames = reinterpret_cast<const std::uint16_t*>(file_.bytes().data() + sizeof(SceneHeader));
  return {frames + static_cast<std::size_t>(header().frame_at(step)) * pixels, pixels};
}

}  // namespace floornav
