#pragma once

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

namespace floornav {

/// A table as floornav-replay writes it: a row is its columns' values by name, an empty one is NaN.
using Row = std::map<std::string, double>;
inline std::vector<Row> read_csv(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  std::vector<std::string> names;
  std::istringstream heading(line);
  for (std::string name; std::getline(heading, name, ',');) names.push_back(name);
  std::vector<Row> rows;
  while (std::getline(in, line)) {
    std::istringstream words(line);
    Row& row = rows.emplace_back();
    for (const std::string& name : names) {
      std::string word;
      std::getline(words, word, ',');
      row[name] = word.empty() ? std::nan("") : std::stod(word);
    }
  }
  return rows;
}

enum class Cell { kUnknown, kFree, kBlocked };

/// map.yaml and map.pgm as a user of map_server would read them.
class PublishedMap {
 public:
  explicit PublishedMap(const std::filesystem::path& folder)
      : pixels_(cv::imread((folder / "map.pgm").string(), cv::IMREAD_UNCHANGED)),
        heights_m_(cv::imread((folder / "height.tiff").string(), cv::IMREAD_UNCHANGED)) {
    std::ifstream yaml(folder / "map.yaml");
    for (std::string line; std::getline(yaml, line);) {
      if (line.starts_with("resolution:")) resolution_m_ = std::stod(line.substr(11));
      if (line.starts_with("origin:")) std::sscanf(line.c_str(), "origin: [%lf, %lf", &x_m_, &y_m_);
    }
  }
  /// Index of the map's cell at a place; cell (0, 0) has its lower left corner at the local frame's origin.
  [[nodiscard]] std::pair<int, int> cell_of(double x_m, double y_m) const {
    return {static_cast<int>(std::floor(x_m / resolution_m_)),
            static_cast<int>(std::floor(y_m / resolution_m_))};
  }
  [[nodiscard]] Cell at(std::pair<int, int> cell) const {
    const auto [row, column] = pixel_of(cell);
    if (column < 0 || row < 0 || column >= pixels_.cols || row >= pixels_.rows) return Cell::kUnknown;
    const double occupied = (255 - pixels_.at<std::uint8_t>(row, column)) / 255.0;
    return occupied > 0.65 ? Cell::kBlocked : occupied < 0.196 ? Cell::kFree : Cell::kUnknown;
  }
  /// z of a cell that was seen.
  [[nodiscard]] double height_at(std::pair<int, int> cell) const {
    const auto [row, column] = pixel_of(cell);
    return static_cast<double>(heights_m_.at<float>(row, column));
  }
  [[nodiscard]] double resolution_m() const { return resolution_m_; }

 private:
  /// Row and column.
  [[nodiscard]] std::pair<int, int> pixel_of(std::pair<int, int> cell) const {
    return {pixels_.rows - 1 - (cell.second - static_cast<int>(std::lround(y_m_ / resolution_m_))),
            cell.first - static_cast<int>(std::lround(x_m_ / resolution_m_))};
  }

  cv::Mat pixels_;
  cv::Mat heights_m_;
  double resolution_m_ = 0;
  double x_m_ = 0;
  double y_m_ = 0;
};

}  // namespace floornav
