#include "mapping/told_height.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace floornav {
namespace {

/// Heights that noise throws farther apart do not prove each other.
constexpr float kToldApart_m = 0.005F;
constexpr float kMuchSharper = 4.0F;    ///< in variance
constexpr float kAcross = 0.75F;        ///< pitches off the line of a side: what is no farther lies on it
constexpr float kSteepestEdge = 0.54F;  ///< that rises along a side; what differs more is something else
constexpr float kSignificance = 4.5F;
constexpr float kExplained = 0.8F;  ///< of what the neighbours differ, by one rise
constexpr float kSeenPart = 0.2F;   ///< of a vertex' width: from the middle of what was seen to its end

/// The mean of heights with what other heights tell of the same place.
class ToldMean {
 public:
  explicit ToldMean(float var_m2) : var_m2_(var_m2), weights_(1.0F / var_m2) {}

  /// Another one that differs by `off_m`; left out where that is more than noise, or than `most_m`.
  void add(float off_m, float var_m2, float most_m) {
    if (std::abs(off_m) > std::min(noise_m(var_m2), most_m)) return;
    weights_ += 1.0F / var_m2;
    sum_m_ += off_m / var_m2;
  }
  /// How far apart noise throws two heights of the same place.
  [[nodiscard]] float noise_m(float var_m2) const { return 3.0F * std::sqrt(var_m2 + var_m2_); }
  [[nodiscard]] float off_m() const { return sum_m_ / weights_; }

 private:
  float var_m2_, weights_;
  float sum_m_ = 0.0F;
};

std::optional<Surface> seen_beside(const VertexRef& place, std::size_t k) {
  const VertexRef beside = place.neighbour(k);
  if (!beside || !beside.vertex().is(Vertex::kSeen)) return std::nullopt;
  const Surface surface = beside.surface();
  return surface.var_m2 > 0 ? std::optional(surface) : std::nullopt;
}

/// How much higher the upper edge of a side is at the end of what was seen of it here than in the middle, by
/// what lies beside it on the same side; as far as that is no accident of the noise.
float rise_along(const VertexRef& place, const Surface& side, float resolution_m) {
  const float steepness = std::hypot(side.gradient_x, side.gradient_y);
  if (!side.column || !(steepness > 0.0F)) return 0.0F;
  const float along_x = -side.gradient_y / steepness, along_y = side.gradient_x / steepness;
  float knowledge = 0.0F, sum = 0.0F, squares = 0.0F;
  for (std::size_t k = 0; k < 8; ++k) {
    const auto known = seen_beside(place, k);
    if (!known) continue;
    const auto x = static_cast<float>(kNeighbourX[k]), y = static_cast<float>(kNeighbourY[k]);
    if (std::abs(x * along_y - y * along_x) > kAcross) continue;
    const float up_m = known->z_m + known->reach_m(resolution_m) - side.z_m;
    if (std::abs(up_m) > kSteepestEdge * resolution_m) continue;
    const float along_m = (x * along_x + y * along_y) * resolution_m;
    const float weight = 1.0F / (known->var_m2 + side.var_m2);
    knowledge += weight * along_m * along_m;
    sum += weight * along_m * up_m;
    squares += weight * up_m * up_m;
  }
  const float explained = knowledge > 0.0F ? sum * sum / knowledge : 0.0F;
  const float least = kSignificance * kSignificance;
  if (explained <= std::max(least, kExplained * squares)) return 0.0F;
  return kSeenPart * resolution_m * (1.0F - least / explained) * std::abs(sum) / knowledge;
}

}  // namespace

Surface highest_place(const VertexRef& place, float resolution_m, float step_m) {
  const Surface own = place.surface();
  Surface surface = own;
  surface.z_m += own.reach_m(resolution_m);
  ToldMean mean(own.var_m2);
  for (std::size_t k = 0; k < 8; ++k) {
    const auto beside = seen_beside(place, k);
    if (!beside) continue;
    if (kMuchSharper * beside->var_m2 <= own.var_m2)
      mean.add(beside->z_m - surface.z_m, beside->var_m2, 0.5F * step_m);
    const auto opposite = k < 4 ? seen_beside(place, k + 4) : std::nullopt;
    if (!opposite) continue;
    const float var_m2 = 0.25F * (beside->var_m2 + opposite->var_m2);
    if (mean.noise_m(var_m2) < kToldApart_m)
      mean.add(0.5F * (beside->z_m + opposite->z_m) - own.z_m, var_m2, kToldApart_m);
  }
  surface.z_m += mean.off_m() + rise_along(place, surface, resolution_m);
  return surface;
}

}  // namespace floornav
