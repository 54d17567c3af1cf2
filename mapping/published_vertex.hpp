#pragma once

#include <cstddef>
#include <cstdint>

#include "mapping/cell_memory.hpp"
#include "mapping/grid_map.hpp"

namespace floornav {

/// Whether a surface tells anything new to somebody who knows what was published: more than half a
/// millimetre, half a degree, half as much again or less of uncertainty. What is less is noise of the fusion,
/// and is neither judged nor sent.
bool differs_noticeably(const Surface& surface, float slope_deg, const GridTile& published,
                        std::size_t vertex);

/// All three write what is new to somebody who knows what was published; false where nothing is.
/// A vertex that was seen:
bool publish_seen(const Surface& surface, float slope_deg, bool free, float belief, GridTile& published,
                  std::size_t vertex);
/// Its height as a tile that is sent anyway tells it, whether that is new or not.
std::int16_t height_code(const Surface& surface, const GridTile& published);
/// One that was never seen: unknown, or a drop beside the floor.
bool publish_unseen(bool drop, float floor_m, GridTile& published, std::size_t vertex);
/// The room below `overhead_z_m`, NaN: nothing above.
bool publish_clearance(float overhead_z_m, float floor_m, GridTile& published, std::size_t vertex);

}  // namespace floornav
