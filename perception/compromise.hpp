#pragma once

#include <cstdint>
#include <string>

#include "perception/settings.hpp"

namespace floornav {

/// Where the four knobs stand with which the paper trades accuracy for time (goal of the paper, section 1):
/// how many points, how much search space, how fine the floor, how many inclinations. Level 0 is what the
/// settings say; each level gives up one thing more.
struct Compromise {
  static constexpr int kLevels = 6;

  int level = 0;
  int point_stride = 1;        ///< every n-th pixel of every n-th row
  int hypotheses_divisor = 1;  ///< of planes.max_hypotheses
  int patch_factor = 1;        ///< of planes.min_points: smaller patches of floor are not told apart
  int max_planes = 0;          ///< a section; 0: as set

  static Compromise at(int level);
  /// The settings with this compromise.
  [[nodiscard]] PlaneSettings applied_to(const PlaneSettings& settings) const;
  /// Estimated work of a point that level 0 would see, from the ROI to its cell; the same on every machine.
  [[nodiscard]] double work_per_point_ns() const;
  /// For a person: "every 2nd pixel, 1/4 of the hypotheses"; empty at level 0.
  [[nodiscard]] std::string text() const;
};

/// Estimated work of a frame's pixels before its sections begin.
inline constexpr double kWorkPerPixel_ns = 10.0;

/// Chooses the level for each frame so that its work fits into the time.
class CompromiseControl {
 public:
  /// `budget_ns`: what the frame may take. `points`, `pixels`: of the frame before, at full density.
  Compromise choose(std::int64_t budget_ns, std::int64_t points, std::int64_t pixels);

 private:
  int level_ = 0;
};

}  // namespace floornav
