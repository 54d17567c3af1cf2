#include "drivers/kinect/node/calibration_file.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "runtime/process/settings_reader.hpp"

namespace floornav {
namespace {

std::vector<double> numbers(const YAML::Node& calibration, const char* key, const std::string& file) {
  try {
    return calibration[key]["data"].as<std::vector<double>>();
  } catch (const YAML::Exception&) {
    throw SettingsError(fmt::format("{}: {}.data must be a list of numbers", file, key));
  }
}

double number(const YAML::Node& calibration, const char* key, const std::string& file) {
  try {
    return calibration[key].as<double>();
  } catch (const YAML::Exception&) {
    throw SettingsError(fmt::format("{}: {} must be a number", file, key));
  }
}

/// Scales about the image's corner, which is half a pixel from the first pixel's centre.
float scaled_center(double center, double scale) {
  return static_cast<float>((center + 0.5) * scale - 0.5);
}

}  // namespace

Calibration read_calibration(const std::filesystem::path& path, int width, int height) {
  const std::string file = path.string();
  const YAML::Node yaml = load_yaml(path);
  const std::vector<double> k = numbers(yaml, "camera_matrix", file);
  const std::vector<double> d = yaml["distortion_coefficients"]
                                    ? numbers(yaml, "distortion_coefficients", file)
                                    : std::vector<double>();
  const double image_width = number(yaml, "image_width", file);
  const double image_height = number(yaml, "image_height", file);
  if (k.size() != 9 || !std::all_of(k.begin(), k.end(), [](double v) { return std::isfinite(v); }))
    throw SettingsError(file + ": camera_matrix.data must be nine numbers: fx 0 cx 0 fy cy 0 0 1");
  Calibration calibration;
  if (d.size() > calibration.distortion.size() ||
      !std::all_of(d.begin(), d.end(), [](double v) { return std::abs(v) < 100; }))
    throw SettingsError(file + ": distortion_coefficients.data must be at most k1 k2 p1 p2 k3 (plumb_bob)");
  std::copy(d.begin(), d.end(), calibration.distortion.begin());

  const double scale = width / image_width;
  if (!(image_width > 0) || std::abs(image_height * scale - height) > 0.5)
    throw SettingsError(fmt::format("{}: is for {}x{}, which is no {}x{} at another size", file, image_width,
                                    image_height, width, height));
  Pinhole& camera = calibration.camera;
  camera = {static_cast<float>(k[0] * scale),
            static_cast<float>(k[4] * scale),
            scaled_center(k[2], scale),
            scaled_center(k[5], scale),
            width,
            height};
  const auto plausible = [](float focal, float center, int size) {
    const auto s = static_cast<float>(size);
    return focal > 0.2F * s && focal < 20 * s && center > 0.1F * s && center < 0.9F * s;
  };
  if (!plausible(camera.fx, camera.cx, width) || !plausible(camera.fy, camera.cy, height))
    throw SettingsError(fmt::format("{}: fx {} fy {} cx {} cy {} is no camera of {}x{}", file, k[0], k[4],
                                    k[2], k[5], image_width, image_height));
  return calibration;
}

}  // namespace floornav
