#include "tests/devices/kinect/plugin/scene.hpp"

#include <stdexcept>
#include <string>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace floornav {
namespace {

std::size_t bytes_of(const SceneHeader& header) {
  return sizeof(SceneHeader) + static_cast<std::size_t>(header.width) *
                                   static_cast<std::size_t>(header.height) *
                                   static_cast<std::size_t>(header.frames) * sizeof(std::uint16_t);
}

}  // namespace

Scene::Scene(const char* path) {
  const int file = ::open(path, O_RDONLY | O_CLOEXEC);
  struct stat status {};
  if (file < 0 || ::fstat(file, &status) != 0)
    throw std::runtime_error(std::string(path) + ": no scene file");
  bytes_ = static_cast<std::size_t>(status.st_size);
  memory_ =
      bytes_ < sizeof(SceneHeader) ? MAP_FAILED : ::mmap(nullptr, bytes_, PROT_READ, MAP_SHARED, file, 0);
  ::close(file);
  if (memory_ == MAP_FAILED || header().magic != SceneHeader::kMagic || header().frames < 1 ||
      bytes_of(header()) != bytes_)
    throw std::runtime_error(std::string(path) + ": not a scene file");
}

Scene::~Scene() {
  ::munmap(memory_, bytes_);
}

std::span<const std::uint16_t> Scene::frame_at(std::int64_t step) const {
  const std::size_t pixels =
      static_cast<std::size_t>(header().width) * static_cast<std::size_t>(header().height);
  const auto* frames =
      reinterpret_cast<const std::uint16_t*>(static_cast<const char*>(memory_) + sizeof(SceneHeader));
  return {frames + static_cast<std::size_t>(header().frame_at(step)) * pixels, pixels};
}

}  // namespace floornav
