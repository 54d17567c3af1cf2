#include "drivers/bumblebee/disparity_refinement.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace floornav {
namespace {

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

}  // namespace

/// Left minus warped right, and the gradient along the row, mean of both images. The right image's value and
/// rise come from the cubic through four pixels (Catmull-Rom).
void DisparityRefinement::compare(const std::uint8_t* left, const std::uint8_t* right, const float* disparity,
                                  int columns, Row& row) const {
  row.known.assign(at(columns), 0.0F);
  row.rest.assign(at(columns), 0.0F);
  row.gradient.assign(at(columns), 0.0F);
  const auto end = static_cast<float>(columns - 3);
  for (int x = 1; x + 1 < columns; ++x) {
    const float place = static_cast<float>(x) - disparity[x];
    if (!(disparity[x] > 0 && place >= 1 && place < end)) continue;
    const auto whole = static_cast<int>(place);
    const float t = place - static_cast<float>(whole);
    const auto a = static_cast<float>(right[whole - 1]);
    const auto b = static_cast<float>(right[whole]);
    const auto c = static_cast<float>(right[whole + 1]);
    const auto d = static_cast<float>(right[whole + 2]);
    const float k1 = 0.5F * (c - a);
    const float k2 = a - 2.5F * b + 2 * c - 0.5F * d;
    const float k3 = 0.5F * (d - a) + 1.5F * (b - c);
    const float value = b + t * (k1 + t * (k2 + t * k3));
    const float rise = k1 + t * (2 * k2 + t * 3 * k3);
    const auto ahead = static_cast<float>(left[x + 1] - left[x - 1]);
    row.known[at(x)] = 1.0F;
    row.rest[at(x)] = static_cast<float>(left[x]) - value;
    row.gradient[at(x)] = 0.5F * (0.5F * ahead + rise);
  }
}

void DisparityRefinement::add(const Row& row, float sign) {
  const std::size_t columns = row.known.size();
  const auto margin = at(reach_) + 1;
  float* const known = column_[kKnown].data() + margin;
  float* const rest = column_[kRest].data() + margin;
  float* const gradient = column_[kGradient].data() + margin;
  float* const product = column_[kProduct].data() + margin;
  float* const squares = column_[kSquares].data() + margin;
  float* const rest_squares = column_[kRestSquares].data() + margin;
  for (std::size_t x = 0; x < columns; ++x) {
    const float e = row.rest[x];
    const float g = row.gradient[x];
    known[x] += sign * row.known[x];
    rest[x] += sign * e;
    gradient[x] += sign * g;
    product[x] += sign * g * e;
    squares[x] += sign * g * g;
    rest_squares[x] += sign * e * e;
  }
}

void DisparityRefinement::slide() {
  const std::size_t columns = window_[0].size();
  const auto wide = 2 * at(reach_) + 1;
  std::array<float, kSums> sum{};
  for (std::size_t s = 0; s < kSums; ++s)
    for (std::size_t x = 0; x < wide; ++x) sum[s] += column_[s][x];
  for (std::size_t x = 0; x < columns; ++x)
    for (std::size_t s = 0; s < kSums; ++s) {
      sum[s] += column_[s][x + wide] - column_[s][x];
      window_[s][x] = sum[s];
    }
}

void DisparityRefinement::solve(const float* disparity, float* refined, float* sigma) const {
  constexpr float kMostStep_px = 1.0F;
  constexpr float kSettled_px = 0.25F;
  constexpr float kModel_px = 0.05F;     // 1 sigma of what interpolation and the window's shape add
  constexpr float kLeastTexture = 4.0F;  // mean square of the gradient, grey levels a pixel
  constexpr float kNever = std::numeric_limits<float>::infinity();
  const std::size_t columns = window_[0].size();
  for (std::size_t x = 0; x < columns; ++x) {
    const float n = std::max(1.0F, window_[kKnown][x]);
    const float g = window_[kGradient][x];
    const float e = window_[kRest][x];
    const float texture = window_[kSquares][x] - g * g / n;
    const float step = (g * e / n - window_[kProduct][x]) / std::max(texture, 1.0F);
    const float rest = std::max(0.0F, window_[kRestSquares][x] - e * e / n);
    const bool solvable = (disparity[x] > 0) & (window_[kKnown][x] >= 1) & (texture >= kLeastTexture * n);
    const float moved = disparity[x] + std::min(kMostStep_px, std::max(-kMostStep_px, step));
    refined[x] = solvable ? std::max(0.0F, moved) : disparity[x];
    const float told = std::sqrt(rest / (n * std::max(texture, 1.0F)) + kModel_px * kModel_px);
    sigma[x] = solvable & (std::abs(step) < kSettled_px) ? told : kNever;
  }
}

void DisparityRefinement::refine(const cv::Mat1b& left, const cv::Mat1b& right, const cv::Mat1f& disparity,
                                 cv::Range rows, cv::Mat1f& refined, cv::Mat1f& sigma) {
  const int columns = left.cols;
  const int tall = 2 * reach_ + 1;
  ring_.resize(at(tall));
  for (auto& sums : column_) sums.assign(at(columns + 2 * reach_ + 2), 0.0F);
  for (auto& sums : window_) sums.resize(at(columns));
  for (int y = rows.start - reach_; y < rows.end + reach_; ++y) {
    Row& row = ring_[at((y + tall) % tall)];
    if (y - tall >= rows.start - reach_ && y - tall >= 0) add(row, -1.0F);
    if (y >= 0 && y < left.rows) {
      compare(left[y], right[y], disparity[y], columns, row);
      add(row, 1.0F);
    } else {
      row = {};
    }
    const int middle = y - reach_;
    if (middle < rows.start) continue;
    slide();
    solve(disparity[middle], refined[middle], sigma[middle]);
  }
}

}  // namespace floornav
