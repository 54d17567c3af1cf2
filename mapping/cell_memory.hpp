#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

namespace floornav {

/// One surface in one lattice cell, as one frame saw it or as many have made it.
struct Surface {
  float z_m = 0;         ///< local world frame; of a column its top
  float var_m2 = 0;      ///< variance of z_m
  float gradient_x = 0;  ///< rise per metre along x
  float gradient_y = 0;  ///< rise per metre along y
  bool column = false;   ///< too steep to have one height, or points on no plane: z_m is the highest of them
  /// Of a plane: how far up its slope it was seen in the cell, in sevenths of the way from the cell's centre,
  /// of which z_m is the height, to its highest corner; -kCorner..kCorner.
  std::int8_t reach = 0;

  static constexpr std::int32_t kCorner = 7;
  /// Rise of what is carried on to where it was not seen. Steeper surfaces, 20 degrees, are no floor, and
  /// those of small things far away are not well known.
  static constexpr float kSteepestCarried = 0.36F;
  /// How much higher than z_m its highest place that was seen lies, in a cell of this size.
  [[nodiscard]] float reach_m(float pitch_m) const {
    return column ? 0.0F : corner_m(pitch_m) * static_cast<float>(reach) / kCorner;
  }
  void set_reach(float above_m, float pitch_m) {
    constexpr float kLevel = 1e-4F;
    const float most_m = corner_m(pitch_m);
    const bool is_level = column || most_m < kLevel * pitch_m;
    const float share = is_level ? 0.0F : std::clamp(above_m / most_m, -1.0F, 1.0F);
    reach = static_cast<std::int8_t>(std::lround(share * kCorner));
  }
  /// How much higher than its centre the highest corner of a cell lies.
  [[nodiscard]] float corner_m(float pitch_m) const {
    return 0.5F * pitch_m * (std::abs(gradient_x) + std::abs(gradient_y));
  }
};

/// A surface in the memory of a cell. Support counts the points that speak for it, up to a limit; frames that
/// should have seen it and did not take from it.
struct Level : Surface {
  static constexpr std::int32_t kTrusted = 3;   ///< from here on it decides
  static constexpr std::int32_t kPerFrame = 4;  ///< most that one frame adds
  static constexpr std::int32_t kMost =
      12;  ///< most that it can hold, so that it can go within a third of a second

  std::uint8_t support = 0;

  [[nodiscard]] bool exists() const { return support > 0; }
  [[nodiscard]] bool trusted() const { return support >= kTrusted; }
};

/// A surface of one frame.
struct Sighting : Surface {
  std::int32_t points = 0;
  float lowest_z_m = 0;  ///< what is known of its lower end
  bool in_part = false;  ///< a good part of the cell was hidden
};

/// All that one frame tells of a cell.
struct CellView {
  std::span<const Sighting> sightings;                     ///< by rising z_m
  float ray_z_m = std::numeric_limits<float>::infinity();  ///< lowest height at which a ray passed through
  bool no_return = false;                                  ///< no floor where one was expected
  bool partly_hidden = false;                              ///< by something nearer
  bool on_edge = false;                                    ///< of the ground, or of what stands on it
};

/// How much two heights may differ and still be one surface.
struct FusionLimits {
  float gate_m = 0.01F;         ///< at least this; else 3 sigma
  float ray_margin_m = 0.02F;   ///< a ray this far under a surface speaks against it
  float memory_var_m2 = 1e-6F;  ///< a fused variance is not smaller
};

/// What the map remembers of a lattice cell: the lowest surface (the floor, where it was seen) and the
/// highest one that the robot would hit (things on the floor, table tops). Those between are not kept.
class CellMemory {
 public:
  static constexpr std::int32_t kMostFloorDoubt = 15;
  static constexpr std::int32_t kOnEdge = 3;  ///< doubt from which on an edge goes through what was seen

  CellMemory() = default;
  /// As it was remembered before.
  CellMemory(const Level& lower, const Level& upper, float overhead_z_m, std::int32_t floor_doubt)
      : lower_(lower),
        upper_(upper),
        overhead_z_m_(overhead_z_m),
        floor_doubt_(static_cast<std::uint8_t>(std::min(floor_doubt, kMostFloorDoubt))) {}

  /// Fuses one frame. A sighting supports the level that it fits (Kalman filter by both variances, so that
  /// nearer views win) or makes a new one. What would raise a column that is already trusted decides only
  /// when a second frame has seen it, and a few points alone above a floor when a third one has, since what
  /// depth edges throw there is seen once or twice; anything else above a floor decides at once. A level
  /// that was not seen loses support where a ray passed below it or something below it was seen; four times
  /// as much where that view is twice as sharp and of the whole cell. False where the view told nothing.
  bool fuse(const CellView& view, const FusionLimits& limits);

  /// The surface that decides: the highest trusted one; null where there is none.
  [[nodiscard]] const Surface* decider() const {
    if (upper_.trusted()) return &upper_;
    return lower_.trusted() ? &lower_ : nullptr;
  }
  /// Moves all that it holds: what was taken for the robot's pose was wrong by that.
  void lift(float by_m, float rise_x, float rise_y);
  /// Two levels more than `max_step_m` and their noise apart: the edge of something goes through the cell.
  [[nodiscard]] bool is_stepped(float max_step_m) const;
  /// A flat top so high above the floor in the same cell that the floor can be seen from the side below it.
  [[nodiscard]] bool has_high_top() const;
  /// Takes from that top's support, after a sight line went right through it.
  void see_through_top();
  [[nodiscard]] const Level& lower() const { return lower_; }
  [[nodiscard]] const Level& upper() const { return upper_; }
  /// Of a cell that was never seen, the frames whose rays found no floor here. Of one that was, three for
  /// each frame in which an edge went through it less one for each other one, soon back to 0. At most
  /// kMostFloorDoubt.
  [[nodiscard]] std::int32_t floor_doubt() const { return floor_doubt_; }
  /// Lowest thing seen above the robot's height; NaN: none.
  [[nodiscard]] float overhead_z_m() const { return overhead_z_m_; }
  void see_overhead(float z_m) { overhead_z_m_ = std::fmin(overhead_z_m_, z_m); }

 private:
  struct Seen {
    bool lower = false;
    bool upper = false;
  };
  [[nodiscard]] Level* level_of(const Sighting& sighting, const FusionLimits& limits, Seen seen);
  void place(const Sighting& sighting, const FusionLimits& limits, Seen& seen);
  void place_above(const Sighting& sighting, Seen& seen);
  void place_below(const Sighting& sighting, Seen& seen);
  bool forget_unseen(const CellView& view, const FusionLimits& limits, Seen seen);
  /// A floor of which as many frames saw a part as saw it whole is not known.
  bool doubt_unsettled_floor(const CellView& view, Seen seen);
  void merge(const FusionLimits& limits);
  /// See floor_doubt(). `was_known`: before this view.
  void update_floor_doubt(const CellView& view, bool was_known);

  Level lower_;
  Level upper_;
  float overhead_z_m_ = std::numeric_limits<float>::quiet_NaN();
  std::uint8_t floor_doubt_ = 0;
};

}  // namespace floornav
