#include "drivers/bumblebee/calibration/stored_calibration.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

namespace floornav {
namespace {

/// A name and the numbers behind it.
struct Entry {
  std::string name;
  std::vector<double> numbers;
};

std::optional<double> number_of(const std::string& word) {
  double number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error != std::errc{} || end != word.data() + word.size() || !std::isfinite(number)) return std::nullopt;
  return number;
}

std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> words(1);
  bool remark = false;
  for (const char c : text) {
    if (c == '#') remark = true;
    if (c == '\n') remark = false;
    const bool blank = remark || c <= ' ' || c == ',';
    if (!blank)
      words.back() += c;
    else if (!words.back().empty())
      words.emplace_back();
  }
  if (words.back().empty()) words.pop_back();
  return words;
}

std::vector<Entry> entries_of(const std::string& text) {
  std::vector<Entry> entries;
  for (const std::string& word : words_of(text)) {
    if (const auto number = number_of(word); number && !entries.empty())
      entries.back().numbers.push_back(*number);
    else
      entries.push_back({word, {}});
  }
  return entries;
}

SplineWarp warp_of(const Entry& entry) {
  constexpr double kMostCoefficients = 256;
  const std::vector<double>& n = entry.numbers;
  if (n.size() < 2 || !(n[0] >= 4 && n[0] <= kMostCoefficients && n[1] >= 4 && n[1] <= kMostCoefficients))
    throw std::runtime_error("a Warp does not begin with 4 to 256 columns and rows");
  SplineWarp warp;
  warp.columns = static_cast<int>(n[0]);
  warp.rows = static_cast<int>(n[1]);
  const auto each = static_cast<std::size_t>(warp.columns) * static_cast<std::size_t>(warp.rows);
  if (n.size() != 2 + 2 * each)
    throw std::runtime_error(fmt::format("a Warp of {} x {} has {} coefficients instead of {}", warp.columns,
                                         warp.rows, n.size() - 2, 2 * each));
  const auto middle = n.begin() + 2 + static_cast<std::ptrdiff_t>(each);
  warp.to_x.assign(n.begin() + 2, middle);
  warp.to_y.assign(middle, n.end());
  return warp;
}

cv::Point2d pair_of(const Entry& entry, double least, double most) {
  const auto possible = [&](double v) { return v >= least && v <= most; };
  if (entry.numbers.size() != 2 || !possible(entry.numbers[0]) || !possible(entry.numbers[1]))
    throw std::runtime_error(fmt::format("{} is not two numbers from {} to {}", entry.name, least, most));
  return {entry.numbers[0], entry.numbers[1]};
}

void append(std::string& text, const std::vector<double>& numbers) {
  for (std::size_t i = 0; i < numbers.size(); ++i)
    text += fmt::format("{}{:.8g}", i % 8 == 0 ? "\n" : " ", numbers[i]);
}

}  // namespace

StoredCalibration parse_stored_calibration(const std::string& text) {
  StoredCalibration found;
  for (const Entry& entry : entries_of(text)) {
    if (entry.name == "FocalLength") found.focal_length = pair_of(entry, 0.1, 50);
    if (entry.name == "ImageCenter") found.image_center = pair_of(entry, 0, 1);
    if (entry.name == "BaseLine") found.baselines_m = entry.numbers;
    if (entry.name == "Warp") found.eyes.push_back(warp_of(entry));
  }
  if (found.focal_length.x == 0) throw std::runtime_error("no FocalLength");
  if (found.image_center.x == 0) throw std::runtime_error("no ImageCenter");
  const auto possible = [](double b) { return b >= 0.005 && b <= 5; };
  if (found.baselines_m.empty() || !std::all_of(found.baselines_m.begin(), found.baselines_m.end(), possible))
    throw std::runtime_error("no BaseLine from 0.005 to 5 m");
  if (found.eyes.size() != 2 && found.eyes.size() != 3)
    throw std::runtime_error(fmt::format("{} eyes with a Warp instead of 2 or 3", found.eyes.size()));
  return found;
}

std::string stored_calibration_text(const StoredCalibration& calibration) {
  std::string text = fmt::format("FocalLength {:.8g} {:.8g}\nImageCenter {:.8g} {:.8g}\nBaseLine",
                                 calibration.focal_length.x, calibration.focal_length.y,
                                 calibration.image_center.x, calibration.image_center.y);
  for (const double baseline : calibration.baselines_m) text += fmt::format(" {:.8g}", baseline);
  for (const SplineWarp& warp : calibration.eyes) {
    text += fmt::format("\nWarp {} {}", warp.columns, warp.rows);
    append(text, warp.to_x);
    append(text, warp.to_y);
  }
  return text + "\n";
}

Rectification rectification_of(const StoredCalibration& calibration, cv::Size size, bool narrow, int shrink) {
  const std::vector<SplineWarp>& eyes = calibration.eyes;
  if (narrow && eyes.size() != 3) throw std::runtime_error("the calibration has no narrow pair");
  const SplineWarp& right = eyes.front();
  const SplineWarp& left = narrow ? eyes[1] : eyes.back();
  Pinhole ideal;
  ideal.width = size.width;
  ideal.height = size.height;
  ideal.fx = static_cast<float>(calibration.focal_length.x * size.width);
  ideal.fy = static_cast<float>(calibration.focal_length.y * size.height);
  ideal.cx = static_cast<float>(calibration.image_center.x * size.width);
  ideal.cy = static_cast<float>(calibration.image_center.y * size.height);
  const auto raw_of = [size](const SplineWarp& warp) {
    return [&warp, size](cv::Point2d at) {
      const cv::Point2d to = warp.at(at.x / size.width, at.y / size.height);
      return cv::Point2d(to.x * size.width, to.y * size.height);
    };
  };
  const std::vector<double>& baselines = calibration.baselines_m;
  const double baseline_m = !narrow                ? baselines.front()
                            : baselines.size() > 1 ? baselines[1]
                                                   : baselines.front() / 2;
  return {ideal, baseline_m, raw_of(left), raw_of(right), shrink};
}

}  // namespace floornav
