#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "mapping/grid_map.hpp"

namespace floornav {

/// The ways through the free floor that keep as far from everything as they can: the ridges of the Voronoi
/// decomposition by the nearest vertex that is not free, thinned to lines.
struct Roadmap {
  struct Node {
    Eigen::Vector2d place_m;
    double clearance_m = 0;  ///< to the nearest vertex that is not free
  };
  struct Way {
    std::int32_t from = 0;  ///< index into nodes
    std::int32_t to = 0;
    std::vector<Eigen::Vector2d> places_m;  ///< with both ends
    double length_m = 0;
    double clearance_m = 0;  ///< the least along it
  };
  std::vector<Node> nodes;  ///< where ways meet or end
  std::vector<Way> ways;
};

/// `least_clearance_m`: what a robot needs; ways that come nearer to something are left out. Ways into
/// corners that are shorter than their end's clearance are left out too.
Roadmap make_roadmap(const GridMap& map, double least_clearance_m);

}  // namespace floornav
