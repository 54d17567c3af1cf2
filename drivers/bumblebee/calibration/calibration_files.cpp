#include "drivers/bumblebee/calibration/calibration_files.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include "drivers/bumblebee/calibration/bot_param.hpp"

namespace floornav {
namespace {

std::string text_of(const std::filesystem::path& file) {
  constexpr std::uintmax_t kMost = 10'000'000;
  std::ifstream in(file, std::ios::binary);
  if (!in) throw std::runtime_error("cannot be opened");
  if (std::filesystem::file_size(file) > kMost) throw std::runtime_error("too large for a calibration");
  return {std::istreambuf_iterator<char>(in), {}};
}

template <int kRows, int kColumns>
cv::Matx<double, kRows, kColumns> matrix(const std::vector<double>& numbers) {
  cv::Matx<double, kRows, kColumns> result;
  std::copy(numbers.begin(), numbers.end(), result.val);
  return result;
}

std::vector<double> yaml_numbers(const YAML::Node& node, const char* key, std::size_t least,
                                 std::size_t most) {
  YAML::Node list = node[key];
  if (!list) throw std::runtime_error(fmt::format("no {}", key));
  if (list.IsMap()) list = list["data"];
  std::vector<double> numbers;
  try {
    numbers = list.as<std::vector<double>>();
  } catch (const YAML::Exception&) {
    throw std::runtime_error(fmt::format("{} is not a list of numbers", key));
  }
  if (numbers.size() < least || numbers.size() > most)
    throw std::runtime_error(fmt::format("{} has {} numbers instead of {}", key, numbers.size(), least));
  return numbers;
}

/// yaml-cpp knows neither OpenCV's "%YAML:1.0" nor its tag.
YAML::Node yaml_of(std::string text) {
  if (text.starts_with("%YAML")) text.erase(0, text.find('\n'));
  for (std::size_t at = text.find("!!opencv-matrix"); at != std::string::npos;
       at = text.find("!!opencv-matrix"))
    text.erase(at, 15);
  try {
    return YAML::Load(text);
  } catch (const YAML::Exception& error) {
    throw std::runtime_error(fmt::format("line {}: {}", error.mark.line + 1, error.msg));
  }
}

Eye opencv_eye(const YAML::Node& yaml, const char* camera, const char* distortion) {
  const auto width = static_cast<int>(yaml_numbers(yaml, "image_size", 2, 2)[0]);
  const auto height = static_cast<int>(yaml_numbers(yaml, "image_size", 2, 2)[1]);
  return {
      {width, height}, matrix<3, 3>(yaml_numbers(yaml, camera, 9, 9)), yaml_numbers(yaml, distortion, 4, 8)};
}

StereoCalibration from_opencv(const YAML::Node& yaml) {
  StereoCalibration result;
  result.left = opencv_eye(yaml, "M1", "D1");
  result.right = opencv_eye(yaml, "M2", "D2");
  result.R_right_left = matrix<3, 3>(yaml_numbers(yaml, "R", 9, 9));
  const auto t = matrix<3, 1>(yaml_numbers(yaml, "T", 3, 3));
  result.t_right_left_m = {t(0), t(1), t(2)};
  return result;
}

Eye bot_eye(const BotBlock& block) {
  Eye eye;
  eye.size = {static_cast<int>(block.number("width")), static_cast<int>(block.number("height"))};
  eye.camera = {
      block.number("fx"), 0, block.number("cx"), 0, block.number("fy"), block.number("cy"), 0, 0, 1};
  eye.distortion = {block.number("k1"), block.number("k2"), block.number("p1"), block.number("p2"),
                    block.number("k3")};
  return eye;
}

bool is_stereo(const BotBlock& block) {
  return block.blocks.contains("left") && block.blocks.contains("right");
}

const BotBlock& stereo_block(const BotBlock& file, const std::string& name) {
  const auto cameras = file.blocks.find("cameras");
  if (cameras == file.blocks.end()) throw std::runtime_error("no block \"cameras\"");
  std::string names;
  const BotBlock* found = nullptr;
  int count = 0;
  for (const auto& [key, block] : cameras->second.blocks) {
    if (!is_stereo(block)) continue;
    names += (names.empty() ? "" : ", ") + key;
    if (name.empty() || key == name) {
      found = &block;
      ++count;
    }
  }
  if (count == 1) return *found;
  if (names.empty()) throw std::runtime_error("no stereo camera under \"cameras\"");
  throw std::runtime_error(fmt::format("name one of its stereo cameras: {}", names));
}

StereoCalibration from_bot_param(const std::string& text, const std::string& name) {
  const BotBlock file = parse_bot_param(text);
  const BotBlock& block = stereo_block(file, name);
  StereoCalibration result;
  result.left = bot_eye(block.blocks.at("left"));
  result.right = bot_eye(block.blocks.at("right"));
  result.R_right_left = matrix<3, 3>(block.numbers("rotation", 9));
  const std::vector<double> t = block.numbers("translation", 3);
  result.t_right_left_m = {t[0], t[1], t[2]};
  return result;
}

struct SensorYaml {
  Eye eye;
  cv::Matx44d T_body_sensor;
};

SensorYaml euroc_sensor(const std::filesystem::path& file) {
  const YAML::Node yaml = yaml_of(text_of(file));
  const std::vector<double> size = yaml_numbers(yaml, "resolution", 2, 2);
  const std::vector<double> f = yaml_numbers(yaml, "intrinsics", 4, 4);
  SensorYaml sensor;
  sensor.eye = {{static_cast<int>(size[0]), static_cast<int>(size[1])},
                {f[0], 0, f[2], 0, f[1], f[3], 0, 0, 1},
                yaml_numbers(yaml, "distortion_coefficients", 4, 4)};
  sensor.T_body_sensor = matrix<4, 4>(yaml_numbers(yaml, "T_BS", 16, 16));
  return sensor;
}

StereoCalibration from_euroc(const std::filesystem::path& left_file,
                             const std::filesystem::path& right_file) {
  const SensorYaml left = euroc_sensor(left_file);
  const SensorYaml right = euroc_sensor(right_file);
  const cv::Matx44d T_right_left = right.T_body_sensor.inv() * left.T_body_sensor;
  StereoCalibration result{left.eye, right.eye, T_right_left.get_minor<3, 3>(0, 0), {}};
  for (int i = 0; i < 3; ++i) result.t_right_left_m[i] = T_right_left(i, 3);
  return result;
}

StereoCalibration read_any(const std::string& files, const std::string& block) {
  if (const std::size_t comma = files.find(','); comma != std::string::npos)
    return from_euroc(files.substr(0, comma), files.substr(comma + 1));
  const std::string text = text_of(files);
  if (text.find("cameras") != std::string::npos && text.find('{') != std::string::npos &&
      !text.starts_with("%YAML"))
    return from_bot_param(text, block);
  return from_opencv(yaml_of(text));
}

}  // namespace

StereoCalibration read_stereo_calibration(const std::string& files, const std::string& block) {
  try {
    const StereoCalibration calibration = read_any(files, block);
    check(calibration);
    return calibration;
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(fmt::format("{}: {}", files, error.what()));
  }
}

void write_stereo_calibration(const StereoCalibration& calibration, const std::filesystem::path& file) {
  cv::FileStorage out(file.string(), cv::FileStorage::WRITE | cv::FileStorage::FORMAT_YAML);
  if (!out.isOpened()) throw std::runtime_error(fmt::format("{}: cannot be written", file.string()));
  out << "image_size" << calibration.left.size;
  out << "M1" << cv::Mat(calibration.left.camera) << "D1" << cv::Mat(calibration.left.distortion);
  out << "M2" << cv::Mat(calibration.right.camera) << "D2" << cv::Mat(calibration.right.distortion);
  out << "R" << cv::Mat(calibration.R_right_left) << "T" << cv::Mat(calibration.t_right_left_m);
}

}  // namespace floornav
