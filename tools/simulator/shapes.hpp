#pragma once

#include <vector>

#include <Eigen/Core>

namespace floornav {

/// A rectangle on the ground, turned by its heading.
struct Footprint {
  Eigen::Vector2d center_m{0, 0};
  Eigen::Vector2d axis{1, 0};    ///< unit vector of the rectangle's own x axis
  Eigen::Vector2d half_m{0, 0};  ///< half its size along its own x and y

  /// A point of the world in the rectangle's own axes, from its centre.
  [[nodiscard]] Eigen::Vector2d local(const Eigen::Vector2d& world) const {
    const Eigen::Vector2d d = world - center_m;
    return {axis.dot(d), axis.x() * d.y() - axis.y() * d.x()};
  }
  [[nodiscard]] Eigen::Vector2d world(const Eigen::Vector2d& local) const {
    return center_m + local.x() * axis + local.y() * Eigen::Vector2d(-axis.y(), axis.x());
  }
  [[nodiscard]] bool contains(const Eigen::Vector2d& local) const {
    return local.x() >= -half_m.x() && local.x() <= half_m.x() && local.y() >= -half_m.y() &&
           local.y() <= half_m.y();
  }
};

/// The plane z = slope . (x, y): the floor where nothing else is.
struct Ground {
  Eigen::Vector2d slope{0, 0};
  [[nodiscard]] double z_m(const Eigen::Vector2d& world) const { return slope.dot(world); }
};

/// A pit in the ground with upright walls and a level bottom.
struct Hole {
  Footprint footprint;
  double bottom_m = 0;  ///< z
};

/// Everything between a level bottom and a plane on top: boxes, walls, steps, ramps, table tops.
struct Block {
  Footprint footprint;
  double bottom_m = 0;          ///< z
  double top_m = 0;             ///< z over the footprint's centre
  Eigen::Vector2d slope{0, 0};  ///< of the top, along the footprint's own axes

  [[nodiscard]] double top_at(const Eigen::Vector2d& local) const { return top_m + slope.dot(local); }
  /// The highest point of the top.
  [[nodiscard]] double highest_m() const { return top_m + slope.cwiseAbs().dot(footprint.half_m); }
};

/// An upright cylinder.
struct Cylinder {
  Eigen::Vector2d center_m{0, 0};
  double radius_m = 0;
  double bottom_m = 0;  ///< z
  double top_m = 0;     ///< z
};

/// Carpet: waves along the footprint's own x axis, each from base_m up to base_m + amplitude_m and down
/// again.
struct Waves {
  Footprint footprint;
  double base_m = 0;       ///< z
  double amplitude_m = 0;  ///< from trough to crest
  int count = 1;           ///< whole waves over the footprint's length

  /// z at a place in the footprint's own axes, and its derivative along the own x axis.
  [[nodiscard]] double top_at(double local_x) const;
  [[nodiscard]] double slope_at(double local_x) const;
};

/// The world at one instant.
struct Shapes {
  Ground ground;
  std::vector<Hole> holes;  ///< they do not overlap
  std::vector<Block> blocks;
  std::vector<Cylinder> cylinders;
  std::vector<Waves> waves;
};

}  // namespace floornav
