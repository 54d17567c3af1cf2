#include "tests/devices/firewire/eye_scene_writer.hpp"

#include <algorithm>
#include <stdexcept>

namespace floornav {

EyeSceneWriter::EyeSceneWriter(const std::filesystem::path& file, const StereoRig& rig, int period_us,
                               bool there_and_back)
    : name_(file), file_(file, std::ios::binary) {
  const StereoRigSpec& spec = rig.spec();
  const std::string calibration = stored_calibration_text(rig.calibration());
  header_.width = spec.ideal.width;
  header_.height = spec.ideal.height;
  header_.eyes = static_cast<std::int32_t>(spec.eyes_m.size());
  header_.period_us = period_us;
  header_.there_and_back = there_and_back ? 1 : 0;
  const std::string bayer = spec.bayer.empty() ? "YYYY" : spec.bayer;
  std::copy_n(bayer.begin(), header_.bayer.size(), header_.bayer.begin());
  header_.calibration_bytes = static_cast<std::int32_t>(calibration.size());
  file_.write(reinterpret_cast<const char*>(&header_), sizeof header_);
  file_ << calibration;
}

void EyeSceneWriter::add(const std::vector<cv::Mat>& eyes) {
  for (const cv::Mat& eye : eyes)
    file_.write(reinterpret_cast<const char*>(eye.data), static_cast<std::streamsize>(eye.total()));
  ++header_.frames;
}

void EyeSceneWriter::close() {
  file_.seekp(0);
  file_.write(reinterpret_cast<const char*>(&header_), sizeof header_);
  file_.close();
  if (!file_) throw std::runtime_error(name_.string() + ": cannot be written");
}

}  // namespace floornav
