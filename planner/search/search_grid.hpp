#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace floornav {

/// A cell of a search grid, column and row from 0.
struct GridCell {
  std::int32_t x = 0;
  std::int32_t y = 0;
  friend bool operator==(const GridCell&, const GridCell&) = default;
};

/// Steps to the eight neighbours of a cell, counter-clockwise from +x; odd ones are diagonal. A map's edge
/// masks count in the same order (mapping/grid_map.hpp).
inline constexpr std::array<std::int32_t, 8> kStepX{1, 1, 0, -1, -1, -1, 0, 1};
inline constexpr std::array<std::int32_t, 8> kStepY{0, 1, 1, 1, 0, -1, -1, -1};

/// Cost of one step over cells of weight 0.
struct StepCosts {
  std::uint32_t straight = 0;
  std::uint32_t diagonal = 0;
};

/// 8119 / 5741 is a convergent of the square root of 2: of two routes whose numbers of diagonal steps differ
/// by less than 5741, the cheaper one in these integers is the shorter one exactly. For grids of uniform
/// cost.
inline constexpr StepCosts kExactSteps{5741, 8119};
/// A smaller convergent, 2e-6 off, that keeps the queue of a weighted search within the first-level cache.
inline constexpr StepCosts kWeightedSteps{408, 577};

/// An eight-connected grid to search: which steps lead out of each cell and what they cost. Cell (x, y) has
/// index y * width + x.
struct SearchGrid {
  static constexpr std::int32_t kMaxSide = 65535;
  static constexpr std::uint32_t kWeightUnit = 32;  ///< the weight that doubles a step's cost

  std::int32_t width = 0;
  std::int32_t height = 0;
  StepCosts steps = kExactSteps;
  /// Every edge is open both ways or none, and every open diagonal lies in a square whose four sides are
  /// open: a search may leave out steps that such squares make needless.
  bool whole_squares = false;
  std::vector<std::uint8_t> edges;  ///< bit k: the step to neighbour k is open; none may lead off the grid
  std::vector<std::uint8_t>
      weights;  ///< empty: all 0. A step costs 1 + mean weight of its two cells / kWeightUnit

  [[nodiscard]] std::size_t index(GridCell c) const {
    return static_cast<std::size_t>(c.y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(c.x);
  }
  [[nodiscard]] bool contains(GridCell c) const {
    return c.x >= 0 && c.y >= 0 && c.x < width && c.y < height;
  }

  /// Cost of a step between two neighbours, `base` being steps.straight or steps.diagonal.
  static constexpr std::uint32_t weighted(std::uint32_t base, std::uint32_t weight_a,
                                          std::uint32_t weight_b) {
    return base * (2 * kWeightUnit + weight_a + weight_b) / (2 * kWeightUnit);
  }
};

/// Edge masks of a grid of passable (non-zero) and blocked cells under the corner rule: a diagonal step needs
/// both straight neighbours that it passes between. `passable` holds width * height cells.
std::vector<std::uint8_t> edges_of_passable(const std::vector<std::uint8_t>& passable, std::int32_t width,
                                            std::int32_t height);

}  // namespace floornav
