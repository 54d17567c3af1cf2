#include "drivers/bumblebee/edge_check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace floornav {
namespace {

constexpr int kReach_x = 4;  ///< half of the window, px
constexpr int kReach_y = 2;
constexpr int kFar_px = 8;  ///< where other surfaces are looked for

/// Mean absolute difference of the window and its place in the right image, brightness difference taken out.
float misfit(const cv::Mat1b& left, const cv::Mat1b& right, cv::Point at, float disparity) {
  const float place = static_cast<float>(at.x) - disparity;
  const auto whole = static_cast<int>(std::floor(place));
  const float t = place - static_cast<float>(whole);
  if (whole - kReach_x < 0 || whole + kReach_x + 1 >= right.cols)
    return std::numeric_limits<float>::infinity();
  constexpr int kPixels = (2 * kReach_x + 1) * (2 * kReach_y + 1);
  std::array<float, kPixels> differences{};
  std::size_t n = 0;
  float sum = 0;
  for (int y = at.y - kReach_y; y <= at.y + kReach_y; ++y) {
    const std::uint8_t* const from = left[y] + at.x;
    const std::uint8_t* const to = right[y] + whole;
    for (int u = -kReach_x; u <= kReach_x; ++u) {
      const auto a = static_cast<float>(to[u]);
      const float difference = static_cast<float>(from[u]) - (a + t * (static_cast<float>(to[u + 1]) - a));
      differences[n++] = difference;
      sum += difference;
    }
  }
  const float mean = sum / kPixels;
  float misfit = 0;
  for (const float difference : differences) misfit += std::abs(difference - mean);
  return misfit / kPixels;
}

/// The disparity that the surface some pixels away would have here if its slope carries on; 0: none is there.
float carried_on(const cv::Mat1f& disparity, cv::Point at, cv::Point step) {
  constexpr float kOneSurface_px = 4.0F;
  const cv::Rect image({0, 0}, disparity.size());
  if (!image.contains(at + step)) return 0;
  const float near = disparity(at + step);
  if (!(near > 0) || !image.contains(at + 2 * step)) return near;
  const float far = disparity(at + 2 * step);
  return far > 0 && std::abs(far - near) < kOneSurface_px ? 2 * near - far : near;
}

/// Whether a pixel and those around lie on one plane: no edge is near.
bool on_one_plane(const cv::Mat1f& disparity, int x, int y) {
  constexpr float kFlat_px = 0.75F;
  const float* const row = disparity[y];
  const float left = row[x - kFar_px];
  const float right = row[x + kFar_px];
  const float above = disparity[y - kFar_px][x];
  const float below = disparity[y + kFar_px][x];
  return (std::min(std::min(left, right), std::min(above, below)) > 0) &
         (std::abs(left + right - 2 * row[x]) < kFlat_px) & (std::abs(above + below - 2 * row[x]) < kFlat_px);
}

/// Whether one of the surfaces around explains a pixel better than its own disparity.
bool belongs_to_another(const cv::Mat1b& left, const cv::Mat1b& right, const cv::Mat1f& disparity,
                        cv::Point at) {
  constexpr float kJump_px = 1.5F;  // between two surfaces
  constexpr float kBetter = 0.8F;
  const std::array<cv::Point, 4> steps = {{{-kFar_px, 0}, {kFar_px, 0}, {0, -kFar_px}, {0, kFar_px}}};
  const float own = disparity(at);
  float own_misfit = -1;
  for (const cv::Point& step : steps) {
    const float other = carried_on(disparity, at, step);
    if (!(other > 0) || std::abs(other - own) < kJump_px) continue;
    if (own_misfit < 0) own_misfit = misfit(left, right, at, own);
    if (misfit(left, right, at, other) < kBetter * own_misfit) return true;
  }
  return false;
}

}  // namespace

void check_edges(const cv::Mat1b& left, const cv::Mat1b& right, const cv::Mat1f& disparity, cv::Range rows,
                 cv::Mat1f& checked) {
  for (int y = rows.start; y < rows.end; ++y) {
    const float* const from = disparity[y];
    float* const to = checked[y];
    std::copy_n(from, disparity.cols, to);
    if (y < kReach_y || y + kReach_y >= disparity.rows) continue;
    const bool rows_around = y >= kFar_px && y + kFar_px < disparity.rows;
    for (int x = kReach_x; x + kReach_x < disparity.cols; ++x) {
      const bool all_around = rows_around && x >= kFar_px && x + kFar_px < disparity.cols;
      if (!(from[x] > 0) || (all_around && on_one_plane(disparity, x, y))) continue;
      if (belongs_to_another(left, right, disparity, {x, y})) to[x] = 0;
    }
  }
}

}  // namespace floornav
