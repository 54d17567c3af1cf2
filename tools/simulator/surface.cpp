#include "tools/simulator/surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace floornav {
namespace {

constexpr double kTouch_m = 1e-6;
constexpr std::size_t kMostLayers = 64;

/// A solid's stretch at one place.
struct Layer {
  double bottom_m;
  double top_m;
  double slope;
};

/// The solids at one place; a fixed array, since this is asked for millions of places.
struct Layers {
  std::array<Layer, kMostLayers> layer;
  std::size_t count = 0;
  void add(const Layer& l) {
    if (count == kMostLayers) throw std::length_error("more than 64 things of a scene lie over one place");
    layer[count++] = l;
  }
};

Layers layers_at(const Shapes& shapes, const Eigen::Vector2d& place) {
  Layers layers;
  for (const Block& block : shapes.blocks) {
    const Eigen::Vector2d local = block.footprint.local(place);
    if (block.footprint.contains(local))
      layers.add({block.bottom_m, block.top_at(local), block.slope.norm()});
  }
  for (const Cylinder& cylinder : shapes.cylinders)
    if ((place - cylinder.center_m).squaredNorm() <= cylinder.radius_m * cylinder.radius_m)
      layers.add({cylinder.bottom_m, cylinder.top_m, 0.0});
  for (const Waves& waves : shapes.waves) {
    const Eigen::Vector2d local = waves.footprint.local(place);
    if (waves.footprint.contains(local))
      layers.add({waves.base_m, waves.top_at(local.x()), std::fabs(waves.slope_at(local.x()))});
  }
  return layers;
}

Layer ground_at(const Shapes& shapes, const Eigen::Vector2d& place) {
  for (const Hole& hole : shapes.holes)
    if (hole.footprint.contains(hole.footprint.local(place))) return {0.0, hole.bottom_m, 0.0};
  return {0.0, shapes.ground.z_m(place), shapes.ground.slope.norm()};
}

}  // namespace

SurfacePoint surface_at(const Shapes& shapes, const Eigen::Vector2d& place) {
  Layers layers = layers_at(shapes, place);
  const auto end = layers.layer.begin() + static_cast<std::ptrdiff_t>(layers.count);
  std::sort(layers.layer.begin(), end,
            [](const Layer& a, const Layer& b) { return a.bottom_m < b.bottom_m; });
  const Layer ground = ground_at(shapes, place);
  SurfacePoint surface{ground.top_m, ground.slope};
  for (auto layer = layers.layer.begin(); layer != end; ++layer) {
    if (layer->bottom_m > surface.z_m + kTouch_m) {
      surface.clearance_m = layer->bottom_m - surface.z_m;
      break;
    }
    if (layer->top_m > surface.z_m) {
      surface.z_m = layer->top_m;
      surface.slope = layer->slope;
    }
  }
  return surface;
}

double top_at(const Shapes& shapes, const Eigen::Vector2d& place, double ceiling_m) {
  const Layers layers = layers_at(shapes, place);
  double top = ground_at(shapes, place).top_m;
  for (std::size_t i = 0; i < layers.count; ++i)
    if (layers.layer[i].bottom_m < ceiling_m) top = std::max(top, layers.layer[i].top_m);
  return top;
}

}  // namespace floornav
