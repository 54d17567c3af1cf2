#include "tools/bench/movingai.hpp"

#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>
#include <stdexcept>

namespace floornav {
namespace {

std::ifstream open_text(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error(file.string() + ": cannot be read");
  return in;
}

/// What one unit of the last digit of a decimal number is worth.
double last_digit_of(const std::string& number) {
  const auto point = number.find('.');
  if (point == std::string::npos) return 1.0;
  const auto decimals = static_cast<int>(number.size() - point - 1);
  return std::pow(10.0, -decimals);
}

}  // namespace

SearchGrid read_movingai_map(const std::filesystem::path& file) {
  std::ifstream in = open_text(file);
  std::string type, key;
  SearchGrid grid;
  in >> key >> type;
  for (int i = 0; i < 2; ++i) {
    std::int32_t value = 0;
    in >> key >> value;
    if (key == "height") grid.height = value;
    if (key == "width") grid.width = value;
  }
  in >> key;
  if (!in || key != "map" || grid.width < 1 || grid.height < 1 || grid.width > SearchGrid::kMaxSide ||
      grid.height > SearchGrid::kMaxSide)
    throw std::runtime_error(file.string() + ": not a Moving AI map (type, height, width, map)");
  std::vector<std::uint8_t> passable;
  for (std::int32_t y = 0; y < grid.height; ++y) {
    std::string row;
    if (!(in >> row) || static_cast<std::int32_t>(row.size()) != grid.width)
      throw std::runtime_error(file.string() + ": row " + std::to_string(y) + " is not as wide as the map");
    for (const char c : row) passable.push_back(c == '.' || c == 'G' || c == 'S');
  }
  grid.edges = edges_of_passable(passable, grid.width, grid.height);
  grid.whole_squares = true;
  return grid;
}

std::vector<MovingAiProblem> read_movingai_problems(const std::filesystem::path& file) {
  std::ifstream in = open_text(file);
  std::string line;
  if (!std::getline(in, line) || !line.starts_with("version"))
    throw std::runtime_error(file.string() + ": not a Moving AI scenario (version)");
  std::vector<MovingAiProblem> problems;
  for (int number = 2; std::getline(in, line); ++number) {
    std::istringstream fields(line);
    std::string bucket, map, optimal;
    std::int32_t width = 0, height = 0;
    MovingAiProblem p;
    if (!(fields >> bucket)) continue;
    fields >> map >> width >> height >> p.start.x >> p.start.y >> p.goal.x >> p.goal.y >> optimal;
    if (!fields) throw std::runtime_error(file.string() + ":" + std::to_string(number) + ": not a problem");
    p.optimal = std::stod(optimal);
    p.last_digit = last_digit_of(optimal);
    problems.push_back(p);
  }
  return problems;
}

double path_length(const std::vector<GridCell>& path) {
  std::int64_t straight = 0, diagonal = 0;
  for (std::size_t i = 1; i < path.size(); ++i)
    (path[i].x != path[i - 1].x && path[i].y != path[i - 1].y ? diagonal : straight) += 1;
  return static_cast<double>(straight) + static_cast<double>(diagonal) * std::numbers::sqrt2;
}

}  // namespace floornav
