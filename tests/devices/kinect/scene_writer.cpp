#include "tests/devices/kinect/scene_writer.hpp"

#include <stdexcept>

namespace floornav {

SceneWriter::SceneWriter(const std::filesystem::path& file, const SceneHeader& header)
    : name_(file), file_(file, std::ios::binary), header_(header) {
  header_.frames = 0;
  file_.write(reinterpret_cast<const char*>(&header_), sizeof header_);
}

void SceneWriter::add(std::span<const std::uint16_t> depths) {
  file_.write(reinterpret_cast<const char*>(depths.data()),
              static_cast<std::streamsize>(depths.size_bytes()));
  ++header_.frames;
}

void SceneWriter::close(int period_us) {
  header_.period_us = period_us;
  file_.seekp(0);
  file_.write(reinterpret_cast<const char*>(&header_), sizeof header_);
  file_.close();
  if (!file_) throw std::runtime_error(name_.string() + ": cannot be written");
}

}  // namespace floornav
