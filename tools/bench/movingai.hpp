#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "planner/search/search_grid.hpp"

namespace floornav {

/// A map of the Moving AI benchmarks as a search grid: '.', 'G' and 'S' are passable, a diagonal step needs
/// both straight neighbours. Throws std::runtime_error naming the file and what is wrong with it.
SearchGrid read_movingai_map(const std::filesystem::path& file);

/// One problem of a scenario file.
struct MovingAiProblem {
  GridCell start;
  GridCell goal;
  double optimal = 0;        ///< published length of the shortest path
  double last_digit = 0.01;  ///< what one unit of the last printed digit of `optimal` is worth
};

/// The problems of a scenario file in order. Throws std::runtime_error naming file and line.
std::vector<MovingAiProblem> read_movingai_problems(const std::filesystem::path& file);

/// Length of a path of neighbouring cells: steps are 1 and the square root of 2, counted, so that no rounding
/// adds up.
double path_length(const std::vector<GridCell>& path);

}  // namespace floornav
