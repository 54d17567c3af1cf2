#include "perception/cell_kernel.hpp"

#include <array>

#include "perception/uprightness.hpp"

// Vectors of a size unknown to the compiler cannot be members: such processors take the next best target.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "perception/cell_kernel.cpp"  // NOLINT: each target compiles this file again
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace floornav::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// A ray this close to the plane's own direction says nothing about where it meets it.
constexpr float kMinFacing = 0.02F;

/// What all points of a call share.
struct Frame {
  Eigen::Matrix3f R_world_sensor;
  Eigen::Vector2f begin_pitches;  ///< the sensor, from the window's corner
  float per_m;                    ///< pitches a metre
  float sensor_z;
  float roughness2;
  std::int32_t size_x, size_y;
};

/// Places a vector of points: the same arithmetic on vectors and, for what is left over, on single floats.
template <class D>
HWY_INLINE void place(D lanes, std::size_t i, const RoiCloud& cloud, std::span<const std::int16_t> label,
                      const PlanesInWorld& planes, std::int32_t first_plane, const Frame& frame,
                      PlacedPoints& out) {
  using V = hn::Vec<D>;
  const hn::RebindToSigned<D> integers;
  const V zero = hn::Zero(lanes), one = hn::Set(lanes, 1.0F);
  const V ray_x = hn::LoadU(lanes, cloud.ray_x.data() + i), ray_y = hn::LoadU(lanes, cloud.ray_y.data() + i);
  const V z = hn::LoadU(lanes, cloud.z.data() + i);
  const auto labels = hn::PromoteTo(integers, hn::LoadU(hn::Rebind<std::int16_t, D>(), label.data() + i));
  const auto on_plane = hn::RebindMask(lanes, hn::Gt(labels, hn::Set(integers, kNoPlane)));
  const auto counts = hn::Gt(labels, hn::Set(integers, kNoPlane - 1));
  const auto plane = hn::Add(hn::Max(labels, hn::Zero(integers)), hn::Set(integers, first_plane));
  const std::int32_t first = hn::GetLane(plane);
  const bool is_one_plane = hn::AllTrue(integers, hn::Eq(plane, hn::Set(integers, first)));
  const auto of_plane = [&](const std::vector<float>& values) HWY_ATTR {
    return is_one_plane ? hn::Set(lanes, values[static_cast<std::size_t>(first)])
                        : hn::GatherIndex(lanes, values.data(), plane);
  };
  const auto turned = [&](int axis) HWY_ATTR {
    const Eigen::Matrix3f& R = frame.R_world_sensor;
    return hn::Add(
        hn::Add(hn::Mul(hn::Set(lanes, R(axis, 0)), ray_x), hn::Mul(hn::Set(lanes, R(axis, 1)), ray_y)),
        hn::Set(lanes, R(axis, 2)));
  };
  const V facing = hn::Neg(
      hn::Add(hn::Add(hn::Mul(of_plane(planes.normal_x), ray_x), hn::Mul(of_plane(planes.normal_y), ray_y)),
              of_plane(planes.normal_z)));
  const V inverse_depth = hn::Add(
      hn::Add(hn::Mul(of_plane(planes.a), ray_x), hn::Mul(of_plane(planes.b), ray_y)), of_plane(planes.c));
  const auto meets = hn::And(on_plane, hn::Gt(facing, hn::Set(lanes, kMinFacing)));
  const V depth = hn::IfThenElse(meets, hn::Div(one, inverse_depth), z);
  const V upright = of_plane(planes.upright);
  const auto has_height = hn::And(on_plane, hn::Gt(upright, hn::Set(lanes, kLevelUpright)));
  const V down = turned(2);
  const V per_depth =
      hn::IfThenElse(has_height, hn::Div(facing, upright), down);  // vertical metres a metre of depth
  const V sigma_depth = hn::Div(hn::Mul(z, z), hn::LoadU(lanes, cloud.certainty.data() + i));
  const V sigma = hn::Mul(sigma_depth, per_depth);
  const auto is_side = hn::And(on_plane, hn::Le(upright, hn::Set(lanes, kSideUpright)));
  const V depth_of_height = hn::IfThenElse(hn::Or(has_height, is_side), depth, z);
  hn::StoreU(hn::Add(hn::Set(lanes, frame.sensor_z), hn::Mul(depth_of_height, down)), lanes,
             out.z_m.data() + i);
  hn::StoreU(hn::IfThenElseZero(has_height, hn::Mul(hn::Sub(depth, z), per_depth)), lanes,
             out.rise_m.data() + i);
  hn::StoreU(hn::Mul(sigma, sigma), lanes, out.var_m2.data() + i);
  hn::StoreU(hn::Mul(hn::Set(lanes, frame.roughness2), hn::Mul(per_depth, per_depth)), lanes,
             out.common_m2.data() + i);

  const V scale = hn::Mul(depth, hn::Set(lanes, frame.per_m));
  const V x = hn::Add(hn::Set(lanes, frame.begin_pitches.x()), hn::Mul(scale, turned(0)));
  const V y = hn::Add(hn::Set(lanes, frame.begin_pitches.y()), hn::Mul(scale, turned(1)));
  const auto in_window =
      hn::And(hn::And(hn::Ge(x, zero), hn::Lt(x, hn::Set(lanes, static_cast<float>(frame.size_x)))),
              hn::And(hn::Ge(y, zero), hn::Lt(y, hn::Set(lanes, static_cast<float>(frame.size_y)))));
  const auto cell = hn::Add(
      hn::Mul(hn::ConvertTo(integers, hn::IfThenElseZero(in_window, y)), hn::Set(integers, frame.size_x)),
      hn::ConvertTo(integers, hn::IfThenElseZero(in_window, x)));
  const auto placed = hn::And(hn::RebindMask(integers, in_window), counts);
  hn::StoreU(hn::IfThenElse(placed, cell, hn::Set(integers, -1)), integers, out.cell.data() + i);
}

void place_range(const RoiCloud& cloud, std::span<const std::int16_t> label, std::size_t begin,
                 std::size_t end, const PlanesInWorld& planes, std::int32_t first_plane, float roughness_m,
                 const SensorView& view, const CellWindow& window, PlacedPoints& out) {
  const hn::CappedTag<float, 8> lanes;
  const hn::CappedTag<float, 1> single;
  const Frame frame{view.T_world_sensor.linear().cast<float>(),
                    window.pitches_of(view.T_world_sensor.translation()).cast<float>(),
                    static_cast<float>(1.0 / window.lattice().pitch_m),
                    static_cast<float>(view.T_world_sensor.translation().z()),
                    roughness_m * roughness_m,
                    window.size_x(),
                    window.size_y()};
  std::size_t i = begin;
  for (; i + hn::Lanes(lanes) <= end; i += hn::Lanes(lanes))
    place(lanes, i, cloud, label, planes, first_plane, frame, out);
  for (; i < end; ++i) place(single, i, cloud, label, planes, first_plane, frame, out);
}

}  // namespace
}  // namespace floornav::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace floornav {

HWY_EXPORT(place_range);

void PlanesInWorld::clear() {
  for (auto* values : {&a, &b, &c, &normal_x, &normal_y, &normal_z, &upright}) values->clear();
}

void PlanesInWorld::add(const InverseDepthPlane& plane, const Eigen::Matrix3f& R_world_sensor) {
  const Eigen::Vector3f normal = plane.normal();
  a.push_back(plane.a), b.push_back(plane.b), c.push_back(plane.c);
  normal_x.push_back(normal.x()), normal_y.push_back(normal.y()), normal_z.push_back(normal.z());
  upright.push_back((R_world_sensor * normal).z());
}

void PlacedPoints::resize(std::size_t points) {
  cell.resize(points);
  for (auto* values : {&z_m, &rise_m, &var_m2, &common_m2}) values->resize(points);
}

void place_points(const RoiCloud& cloud, std::span<const std::int16_t> label, std::int32_t begin,
                  std::int32_t end, const PlanesInWorld& planes, std::int32_t first_plane, float roughness_m,
                  const SensorView& view, const CellWindow& window, PlacedPoints& out) {
  HWY_DYNAMIC_DISPATCH(place_range)
  (cloud, label, static_cast<std::size_t>(begin), static_cast<std::size_t>(end), planes, first_plane,
   roughness_m, view, window, out);
}

}  // namespace floornav
#endif
