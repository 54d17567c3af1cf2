#include "mapping/floor_height.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>

namespace floornav {
namespace {

constexpr double kBlock_m = 0.8;
constexpr std::int32_t kFarthestBlock = 3;

std::int32_t block_side(double resolution_m) {
  const auto vertices = static_cast<std::uint32_t>(std::clamp(kBlock_m / resolution_m + 1e-6, 1.0, 32.0));
  return static_cast<std::int32_t>(std::bit_floor(vertices));
}

/// Where a vertex lies between the centres of blocks: the lower one and the way from it to the next, 0..1.
struct Between {
  std::int32_t block;
  float fraction;
};

Between between(std::int32_t vertex, std::int32_t side) {
  const std::int32_t block = block_of(2 * vertex + 1 - side, 2 * side);
  return {block, static_cast<float>(2 * vertex + 1 - side - 2 * side * block) / static_cast<float>(2 * side)};
}

}  // namespace

float plane_height_m(const Pose& T_world_body, double x_m, double y_m) {
  const Eigen::Vector3d up = T_world_body.linear().col(2);
  const Eigen::Vector3d body = T_world_body.translation();
  constexpr double kLeastUpright = 0.5;  // a body that lies on its side has no floor plane
  if (up.z() < kLeastUpright) return static_cast<float>(body.z());
  return static_cast<float>(body.z() - (up.x() * (x_m - body.x()) + up.y() * (y_m - body.y())) / up.z());
}

FloorHeight::FloorHeight(double resolution_m) : side_(block_side(resolution_m)) {}

void FloorHeight::update(MapTile& tile) {
  std::vector<float> floor_m;
  for (std::int32_t y = 0; y < MapTile::kSide; y += side_) {
    for (std::int32_t x = 0; x < MapTile::kSide; x += side_) {
      floor_m.clear();
      for (std::int32_t i = 0; i < side_ * side_; ++i) {
        const VertexRef place{&tile, x + i % side_, y + i / side_};
        if (place.vertex().is(Vertex::kFloor)) floor_m.push_back(place.surface().z_m);
      }
      const CellIndex block{(tile.index.ix * MapTile::kSide + x) / side_,
                            (tile.index.iy * MapTile::kSide + y) / side_};
      if (floor_m.empty() ||
          16.0 * static_cast<double>(floor_m.size()) < static_cast<double>(side_) * side_) {
        blocks_.erase(block);
        continue;
      }
      const auto middle = floor_m.begin() + static_cast<std::ptrdiff_t>(floor_m.size() / 2);
      std::nth_element(floor_m.begin(), middle, floor_m.end());
      blocks_[block] = *middle;
    }
  }
}

std::optional<float> FloorHeight::block_height(CellIndex block) const {
  if (const auto it = blocks_.find(block); it != blocks_.end()) return it->second;
  for (std::int32_t ring = 1; ring <= kFarthestBlock; ++ring) {
    float sum_m = 0;
    std::int32_t found = 0;
    for (std::int32_t dy = -ring; dy <= ring; ++dy) {
      for (std::int32_t dx = -ring; dx <= ring; dx += std::abs(dy) == ring ? 1 : 2 * ring) {
        const auto it = blocks_.find({block.ix + dx, block.iy + dy});
        if (it == blocks_.end()) continue;
        sum_m += it->second;
        ++found;
      }
    }
    if (found > 0) return sum_m / static_cast<float>(found);
  }
  return std::nullopt;
}

void FloorHeight::heights_of(const MapTile& tile, float far_from_floor_m,
                             std::vector<float>& heights_m) const {
  const CellIndex corner{tile.index.ix * MapTile::kSide, tile.index.iy * MapTile::kSide};
  const CellIndex first{between(corner.ix, side_).block, between(corner.iy, side_).block};
  const std::int32_t blocks = MapTile::kSide / side_ + 1;
  std::vector<float> around, lines_m;  // along a row of blocks: at their centres, at the columns of vertices
  for (std::int32_t y = 0; y <= blocks; ++y) {
    around.clear();
    for (std::int32_t x = 0; x <= blocks; ++x)
      around.push_back(block_height({first.ix + x, first.iy + y}).value_or(far_from_floor_m));
    for (std::int32_t column = 0; column < MapTile::kSide; ++column) {
      const Between bx = between(corner.ix + column, side_);
      const auto x = static_cast<std::size_t>(bx.block - first.ix);
      lines_m.push_back(std::lerp(around[x], around[x + 1], bx.fraction));
    }
  }
  heights_m.clear();
  for (std::int32_t row = 0; row < MapTile::kSide; ++row) {
    const Between by = between(corner.iy + row, side_);
    const float* const near_m = lines_m.data() + (by.block - first.iy) * MapTile::kSide;
    for (std::int32_t column = 0; column < MapTile::kSide; ++column)
      heights_m.push_back(std::lerp(near_m[column], near_m[MapTile::kSide + column], by.fraction));
  }
}

}  // namespace floornav
