#include "tools/simulator/raycaster.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <Eigen/Geometry>

// Rays are p(Z) = origin + Z d, with d linear in the pixel's column: each kernel works on one row of one
// shape within the columns that can see it, branch-free so that the compiler vectorises it.

namespace floornav {
namespace {

constexpr float kNear_m = 0.01F;

struct PixelBounds {
  int u_begin = 0;
  int u_end = 0;
  int v_begin = 0;
  int v_end = 0;
};

/// Origin and directions of a camera's rays in a shape's own axes.
class Rays {
 public:
  Rays(const Pinhole& camera, const Pose& T_shape_sensor)
      : origin(T_shape_sensor.translation().cast<float>()), camera_(camera), R_(T_shape_sensor.linear()) {}

  /// d at column u of the row: base + u step.
  struct Row {
    Eigen::Vector3f base;
    Eigen::Vector3f step;
  };
  [[nodiscard]] Row row(int v) const {
    const double y = (v - static_cast<double>(camera_.cy)) / static_cast<double>(camera_.fy);
    const double x = -static_cast<double>(camera_.cx) / static_cast<double>(camera_.fx);
    return {(R_ * Eigen::Vector3d(x, y, 1.0)).cast<float>(),
            (R_.col(0) / static_cast<double>(camera_.fx)).cast<float>()};
  }

  Eigen::Vector3f origin;

 private:
  Pinhole camera_;
  Eigen::Matrix3d R_;
};

Pose shape_from_world(const Footprint& footprint) {
  Pose T = Pose::Identity();
  T.linear().topLeftCorner<2, 2>() << footprint.axis.x(), footprint.axis.y(), -footprint.axis.y(),
      footprint.axis.x();
  T.translation().head<2>() = -(T.linear().topLeftCorner<2, 2>() * footprint.center_m);
  return T;
}

/// The pixels that a box (footprint from z = bottom to top) can cover, its part behind the camera left out.
PixelBounds bounds_of(const Footprint& footprint, double bottom_m, double top_m, const Pinhole& camera,
                      const Pose& T_world_sensor) {
  const Pose T_sensor_world = T_world_sensor.inverse();
  std::array<Eigen::Vector3f, 8> corners;
  for (std::size_t i = 0; i < 8; ++i) {
    const Eigen::Vector2d xy = footprint.world({(i & 1) != 0 ? footprint.half_m.x() : -footprint.half_m.x(),
                                                (i & 2) != 0 ? footprint.half_m.y() : -footprint.half_m.y()});
    corners[i] =
        (T_sensor_world * Eigen::Vector3d(xy.x(), xy.y(), (i & 4) != 0 ? top_m : bottom_m)).cast<float>();
  }
  Eigen::AlignedBox2f seen;
  for (std::size_t i = 0; i < 8; ++i) {
    if (corners[i].z() >= kNear_m) seen.extend(camera.project(corners[i]));
    for (const std::size_t bit : {1U, 2U, 4U}) {
      const Eigen::Vector3f& a = corners[i];
      const Eigen::Vector3f& b = corners[i ^ bit];
      if (a.z() < kNear_m && b.z() >= kNear_m)
        seen.extend(camera.project(a + (kNear_m - a.z()) / (b.z() - a.z()) * (b - a)));
    }
  }
  if (seen.isEmpty()) return {};
  const auto clip = [](float x, int end) {
    return static_cast<int>(std::clamp(x, 0.0F, static_cast<float>(end)));
  };
  return {clip(seen.min().x() - 1, camera.width), clip(seen.max().x() + 2, camera.width),
          clip(seen.min().y() - 1, camera.height), clip(seen.max().y() + 2, camera.height)};
}

struct Column {  // a row's directions at one column
  float x, y, z;
};
inline Column direction(const Rays::Row& row, int u) {
  const auto f = static_cast<float>(u);
  return {row.base.x() + f * row.step.x(), row.base.y() + f * row.step.y(), row.base.z() + f * row.step.z()};
}

inline float lesser(float a, float b) {
  return a < b ? a : b;
}
inline float greater(float a, float b) {
  return a > b ? a : b;
}

/// A half-space {p : n.p <= c} narrows the ray's stretch [enter, exit]; `room` = c - n.origin, `rate` = n.d.
inline void cut(float room, float rate, float& enter, float& exit) {
  const float t = room / (rate + 0.0F);  // + 0: -0 would turn the sign of the infinity
  enter = greater(enter, rate < 0.0F ? t : -kNoHit);
  exit = lesser(exit, rate < 0.0F ? kNoHit : t);
}

/// The slab |p| <= half.
inline void cut_slab(float origin, float d, float half, float& enter, float& exit) {
  const float inverse = 1.0F / d;
  const float a = (-half - origin) * inverse;
  const float b = (half - origin) * inverse;
  enter = greater(enter, lesser(a, b));
  exit = lesser(exit, greater(a, b));
}

inline float nearer_hit(float enter, float exit, float depth) {
  return (enter < exit) & (enter > kNear_m) & (enter < depth) ? enter : depth;
}

float* row_of(std::span<float> depth, const Pinhole& camera, int v) {
  return depth.data() + static_cast<std::ptrdiff_t>(v) * camera.width;
}

void cast_ground(const Ground& ground, const Pinhole& camera, const Pose& T_world_sensor,
                 std::span<float> depth) {
  const Rays rays(camera, T_world_sensor);
  const Eigen::Vector2f slope = ground.slope.cast<float>();
  const auto room = static_cast<float>(ground.slope.dot(T_world_sensor.translation().head<2>()) -
                                       T_world_sensor.translation().z());
  for (int v = 0; v < camera.height; ++v) {
    const Rays::Row row = rays.row(v);
    float* out = row_of(depth, camera, v);
    for (int u = 0; u < camera.width; ++u) {
      const Column d = direction(row, u);
      const float t = room / (d.z - slope.x() * d.x - slope.y() * d.y);
      out[u] = t > kNear_m ? t : kNoHit;
    }
  }
}

/// Where the ground's hit lies in the hole, the ray goes on to its walls or bottom. `depth` holds the ground
/// alone.
void cast_hole(const Hole& hole, const Ground& ground, const Pinhole& camera, const Pose& T_world_sensor,
               std::span<float> depth) {
  const Footprint& footprint = hole.footprint;
  const double rim_m = ground.z_m(footprint.center_m) + footprint.half_m.norm() * ground.slope.norm();
  const PixelBounds box = bounds_of(footprint, hole.bottom_m, rim_m, camera, T_world_sensor);
  const Rays rays(camera, shape_from_world(footprint) * T_world_sensor);
  const Eigen::Vector3f o = rays.origin;
  const Eigen::Vector2f half = footprint.half_m.cast<float>();
  const float to_bottom = static_cast<float>(hole.bottom_m) - o.z();
  for (int v = box.v_begin; v < box.v_end; ++v) {
    const Rays::Row row = rays.row(v);
    float* out = row_of(depth, camera, v);
    for (int u = box.u_begin; u < box.u_end; ++u) {
      const Column d = direction(row, u);
      const float x = o.x() + out[u] * d.x;
      const float y = o.y() + out[u] * d.y;
      const bool inside = (std::fabs(x) < half.x()) & (std::fabs(y) < half.y());
      float enter = 0;
      float exit = d.z < 0.0F ? to_bottom / d.z : kNoHit;
      cut_slab(o.x(), d.x, half.x(), enter, exit);
      cut_slab(o.y(), d.y, half.y(), enter, exit);
      out[u] = inside & (exit > out[u]) ? exit : out[u];
    }
  }
}

void cast_block(const Block& block, const Pinhole& camera, const Pose& T_world_sensor,
                std::span<float> depth) {
  const PixelBounds box =
      bounds_of(block.footprint, block.bottom_m, block.highest_m(), camera, T_world_sensor);
  const Pose T_shape_sensor = shape_from_world(block.footprint) * T_world_sensor;
  const Rays rays(camera, T_shape_sensor);
  const Eigen::Vector3d origin = T_shape_sensor.translation();
  const Eigen::Vector3f o = rays.origin;
  const Eigen::Vector2f half = block.footprint.half_m.cast<float>();
  const Eigen::Vector2f slope = block.slope.cast<float>();
  const auto above_bottom = static_cast<float>(origin.z() - block.bottom_m);
  const auto below_top = static_cast<float>(block.top_at(origin.head<2>()) - origin.z());
  for (int v = box.v_begin; v < box.v_end; ++v) {
    const Rays::Row row = rays.row(v);
    float* out = row_of(depth, camera, v);
    for (int u = box.u_begin; u < box.u_end; ++u) {
      const Column d = direction(row, u);
      float enter = 0;
      float exit = kNoHit;
      cut_slab(o.x(), d.x, half.x(), enter, exit);
      cut_slab(o.y(), d.y, half.y(), enter, exit);
      cut(above_bottom, -d.z, enter, exit);
      cut(below_top, d.z - slope.x() * d.x - slope.y() * d.y, enter, exit);
      out[u] = nearer_hit(enter, exit, out[u]);
    }
  }
}

void cast_cylinder(const Cylinder& cylinder, const Pinhole& camera, const Pose& T_world_sensor,
                   std::span<float> depth) {
  const Footprint square{cylinder.center_m, {1, 0}, {cylinder.radius_m, cylinder.radius_m}};
  const PixelBounds box = bounds_of(square, cylinder.bottom_m, cylinder.top_m, camera, T_world_sensor);
  const Rays rays(camera, shape_from_world(square) * T_world_sensor);
  const Eigen::Vector3f o = rays.origin;
  const auto radius2 = static_cast<float>(cylinder.radius_m * cylinder.radius_m);
  const float above_bottom = o.z() - static_cast<float>(cylinder.bottom_m);
  const float below_top = static_cast<float>(cylinder.top_m) - o.z();
  for (int v = box.v_begin; v < box.v_end; ++v) {
    const Rays::Row row = rays.row(v);
    float* out = row_of(depth, camera, v);
    for (int u = box.u_begin; u < box.u_end; ++u) {
      const Column d = direction(row, u);
      const float a = d.x * d.x + d.y * d.y;
      const float cross = o.x() * d.y - o.y() * d.x;
      const float discriminant = a * radius2 - cross * cross;
      const float root = std::sqrt(discriminant > 0.0F ? discriminant : 0.0F);
      const float middle = -(o.x() * d.x + o.y() * d.y);
      float enter = discriminant > 0.0F ? (middle - root) / a : kNoHit;
      float exit = (middle + root) / a;
      cut(above_bottom, -d.z, enter, exit);
      cut(below_top, d.z, enter, exit);
      out[u] = nearer_hit(enter, exit, out[u]);
    }
  }
}

/// The first place in [enter, exit] where the ray is below the waves, found by marching and halving.
float march(const Waves& waves, const Eigen::Vector3f& o, const Column& d, float enter, float exit) {
  const auto height_above = [&](float t) {
    return o.z() + t * d.z - static_cast<float>(waves.top_at(static_cast<double>(o.x() + t * d.x)));
  };
  if (height_above(enter) <= 0.0F) return enter;
  const float stride_m = static_cast<float>(2.0 * waves.footprint.half_m.x() / waves.count) / 16.0F;
  const float length_m = std::fabs(d.x) * (exit - enter);
  const int steps = 2 + static_cast<int>(std::fmin(length_m / stride_m, 1000.0F));
  for (int i = 1; i <= steps; ++i) {
    float low = enter + (exit - enter) * static_cast<float>(i) / static_cast<float>(steps);
    if (height_above(low) > 0.0F) continue;
    float high = enter + (exit - enter) * static_cast<float>(i - 1) / static_cast<float>(steps);
    for (int k = 0; k < 16; ++k) {
      const float half = 0.5F * (low + high);
      (height_above(half) > 0.0F ? high : low) = half;
    }
    return low;
  }
  return kNoHit;
}

void cast_waves(const Waves& waves, const Pinhole& camera, const Pose& T_world_sensor,
                std::span<float> depth) {
  const double crest_m = waves.base_m + waves.amplitude_m;
  const PixelBounds box = bounds_of(waves.footprint, waves.base_m, crest_m, camera, T_world_sensor);
  const Rays rays(camera, shape_from_world(waves.footprint) * T_world_sensor);
  const Eigen::Vector3f o = rays.origin;
  const Eigen::Vector2f half = waves.footprint.half_m.cast<float>();
  for (int v = box.v_begin; v < box.v_end; ++v) {
    const Rays::Row row = rays.row(v);
    float* out = row_of(depth, camera, v);
    for (int u = box.u_begin; u < box.u_end; ++u) {
      const Column d = direction(row, u);
      float enter = kNear_m;
      float exit = out[u];
      cut_slab(o.x(), d.x, half.x(), enter, exit);
      cut_slab(o.y(), d.y, half.y(), enter, exit);
      cut(o.z() - static_cast<float>(waves.base_m), -d.z, enter, exit);
      cut(static_cast<float>(crest_m) - o.z(), d.z, enter, exit);
      if (enter < exit) out[u] = lesser(out[u], march(waves, o, d, enter, exit));
    }
  }
}

}  // namespace

void cast_depth(const Shapes& shapes, const Pinhole& camera, const Pose& T_world_sensor,
                std::span<float> depth) {
  cast_ground(shapes.ground, camera, T_world_sensor, depth);
  for (const Hole& hole : shapes.holes) cast_hole(hole, shapes.ground, camera, T_world_sensor, depth);
  cast_solids(shapes, camera, T_world_sensor, depth);
}

void cast_solids(const Shapes& shapes, const Pinhole& camera, const Pose& T_world_sensor,
                 std::span<float> depth) {
  for (const Block& block : shapes.blocks) cast_block(block, camera, T_world_sensor, depth);
  for (const Cylinder& cylinder : shapes.cylinders) cast_cylinder(cylinder, camera, T_world_sensor, depth);
  for (const Waves& waves : shapes.waves) cast_waves(waves, camera, T_world_sensor, depth);
}

}  // namespace floornav
