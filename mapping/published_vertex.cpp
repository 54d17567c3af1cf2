#include "mapping/published_vertex.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace floornav {
namespace {

constexpr int kHeightNoise = 5;  // counts
constexpr float kSigmaNoise = 1.4F;

template <class Stored>
Stored quantised(float value, float unit) {
  using Limits = std::numeric_limits<Stored>;
  const float counts =
      std::clamp(value / unit, static_cast<float>(Limits::min()), static_cast<float>(Limits::max()));
  return static_cast<Stored>(counts + std::copysign(0.5F, counts));
}

/// What `surface` is in the units of a grid tile.
struct Counts {
  std::int16_t height;
  std::uint8_t sigma;
  std::uint8_t slope;

  Counts(const Surface& surface, float slope_deg, const GridTile& tile)
      : height(height_code(surface, tile)),
        sigma(sigma_code(quantised<std::int16_t>(std::sqrt(surface.var_m2), GridTile::kHeightUnit_m))),
        slope(quantised<std::uint8_t>(slope_deg, GridTile::kSlopeUnit_deg)) {}

  [[nodiscard]] bool differ_noticeably(const GridTile& tile, std::size_t vertex) const {
    const auto known = static_cast<float>(sigma_counts(tile.sigma[vertex]));
    const auto now = static_cast<float>(sigma_counts(sigma));
    return std::abs(height - tile.height[vertex]) > kHeightNoise ||
           std::abs(slope - tile.slope[vertex]) > 1 || now > kSigmaNoise * known || known > kSigmaNoise * now;
  }
};

/// True where the value differs from before by more than `noise`.
template <class Value>
bool assign(Value& slot, Value value, int noise = 0) {
  if (std::abs(static_cast<int>(slot) - static_cast<int>(value)) <= noise) return false;
  slot = value;
  return true;
}

bool assign_state(VertexState state, GridTile& published, std::size_t vertex) {
  if (published.state[vertex] == state) return false;
  published.state[vertex] = state;
  return true;
}

}  // namespace

bool differs_noticeably(const Surface& surface, float slope_deg, const GridTile& published,
                        std::size_t vertex) {
  return Counts(surface, slope_deg, published).differ_noticeably(published, vertex);
}

bool publish_seen(const Surface& surface, float slope_deg, bool free, float belief, GridTile& published,
                  std::size_t vertex) {
  bool differs = assign_state(free ? VertexState::kFree : VertexState::kBlocked, published, vertex);
  differs |= assign(published.belief[vertex], quantised<std::uint8_t>(belief, 1.0F / 255.0F), 1);
  const Counts counts(surface, slope_deg, published);
  if (!counts.differ_noticeably(published, vertex)) return differs;
  published.height[vertex] = counts.height;
  published.sigma[vertex] = counts.sigma;
  published.slope[vertex] = counts.slope;
  return true;
}

std::int16_t height_code(const Surface& surface, const GridTile& published) {
  return quantised<std::int16_t>(surface.z_m - published.origin_z_m, GridTile::kHeightUnit_m);
}

bool publish_unseen(bool drop, float floor_m, GridTile& published, std::size_t vertex) {
  const float height_m = drop ? floor_m - published.origin_z_m : 0.0F;
  const auto height = quantised<std::int16_t>(height_m, GridTile::kHeightUnit_m);
  bool differs = assign_state(drop ? VertexState::kBlocked : VertexState::kUnknown, published, vertex);
  differs |= assign(published.belief[vertex], std::uint8_t{0});
  differs |= assign(published.height[vertex], height, kHeightNoise);
  differs |= assign(published.sigma[vertex], sigma_code(drop ? kUnknownSigma : 0));
  differs |= assign(published.slope[vertex], std::uint8_t{0});
  return differs;
}

bool publish_clearance(float overhead_z_m, float floor_m, GridTile& published, std::size_t vertex) {
  std::uint8_t clearance = GridTile::kNothingAbove;
  if (!std::isnan(overhead_z_m))
    clearance = std::min<std::uint8_t>(
        quantised<std::uint8_t>(overhead_z_m - floor_m, GridTile::kClearanceUnit_m), clearance - 1);
  const std::uint8_t known = published.clearance[vertex];
  const bool opens = (clearance == GridTile::kNothingAbove) != (known == GridTile::kNothingAbove);
  if (!opens && std::abs(clearance - known) <= 1) return false;
  published.clearance.set(vertex, clearance);
  return true;
}

}  // namespace floornav
