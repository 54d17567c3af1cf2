#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "planner/search/search_grid.hpp"

namespace floornav {

/// Which steps a search need take on from a cell, given the step that led there. Of the ways that cost the
/// same, the one that goes diagonally first is enough (canonical orderings, Sturtevant and Rabin, AIIDE
/// 2016), and a way around two sides of a square is not needed where its diagonal is open and costs no more.
/// For grids whose squares are whole (SearchGrid::whole_squares).
template <bool kWeighted>
class CanonicalSteps {
 public:
  explicit CanonicalSteps(const SearchGrid& grid)
      : edges_(grid.edges.data()), weights_(grid.weights.data()), costs_(grid.steps) {
    for (std::size_t k = 0; k < 8; ++k)
      offsets_[k] = static_cast<std::ptrdiff_t>(kStepY[k]) * grid.width + kStepX[k];
  }

  /// Steps on from the cell at `index`, to which the steps in the mask `from` lead at the same cost.
  [[nodiscard]] unsigned after(std::size_t index, unsigned from) const {
    unsigned steps = 0;
    for (; from != 0; from &= from - 1) {
      const auto k = static_cast<unsigned>(std::countr_zero(from));
      steps |= (k & 1U) != 0 ? after_diagonal(index, k) : after_straight(index, k);
    }
    return steps & edges_[index];
  }

 private:
  static constexpr unsigned bit(unsigned k) { return 1U << (k & 7U); }
  [[nodiscard]] std::size_t at(std::size_t index, unsigned k) const {
    return index + static_cast<std::size_t>(offsets_[k & 7U]);
  }

  /// On, and to a side where the cell before had no open diagonal there that costs no more.
  [[nodiscard]] unsigned after_straight(std::size_t index, unsigned k) const {
    const std::size_t before = at(index, k + 4);
    unsigned steps = bit(k);
    for (const unsigned turn : {1U, 7U}) {
      const unsigned between = k + turn, side = k + 2 * turn;
      if ((edges_[before] & bit(between)) == 0)
        steps |= bit(between) | bit(side);
      else if constexpr (kWeighted)
        steps |= dearer_around(index, before, between, side);
    }
    return steps;
  }

  /// Of the steps to a side, those that the diagonal of the cell before does not make needless: it leads to
  /// cells of other weights.
  [[nodiscard]] unsigned dearer_around(std::size_t index, std::size_t before, unsigned between,
                                       unsigned side) const {
    const unsigned here = weights_[index], from = weights_[before], beside = weights_[at(index, side)];
    if (here == beside && here == from && (edges_[index] & bit(between)) != 0 &&
        weights_[at(index, between)] == here)
      return 0;
    unsigned steps = 0;
    const auto straight = [&](unsigned a, unsigned b) { return SearchGrid::weighted(costs_.straight, a, b); };
    const auto diagonal = [&](unsigned a, unsigned b) { return SearchGrid::weighted(costs_.diagonal, a, b); };
    if (diagonal(from, beside) > straight(from, here) + straight(here, beside)) steps |= bit(side);
    if ((edges_[index] & bit(between)) != 0) {
      const unsigned ahead = weights_[at(index, between)];
      if (diagonal(from, beside) + straight(beside, ahead) > straight(from, here) + diagonal(here, ahead))
        steps |= bit(between);
    }
    return steps;
  }

  /// On and to both sides of that; back around a corner of the square where that corner weighs more.
  [[nodiscard]] unsigned after_diagonal(std::size_t index, unsigned k) const {
    unsigned steps = bit(k) | bit(k + 1) | bit(k + 7);
    if constexpr (kWeighted) {
      const unsigned here = weights_[index];
      for (const unsigned turn : {1U, 7U})  // the corner lies at k + 3 turn, beyond it the cell at k + 2 turn
        if (weights_[at(index, k + 3 * turn)] > here) steps |= bit(k + 2 * turn);
    }
    return steps;
  }

  const std::uint8_t* edges_;
  const std::uint8_t* weights_;
  StepCosts costs_;
  std::array<std::ptrdiff_t, 8> offsets_{};
};

}  // namespace floornav
