#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "floornav/depth_cloud_t.hpp"
#include "floornav/drop_t.hpp"
#include "floornav/goal_t.hpp"
#include "floornav/grid_map_t.hpp"
#include "floornav/grid_tile_t.hpp"
#include "floornav/health_t.hpp"
#include "floornav/image_metadata_t.hpp"
#include "floornav/image_t.hpp"
#include "floornav/latency_t.hpp"
#include "floornav/map_request_t.hpp"
#include "floornav/path_point_t.hpp"
#include "floornav/path_t.hpp"
#include "floornav/pose_t.hpp"
#include "floornav/rate_t.hpp"
#include "floornav/rigid_transform_t.hpp"
#include "floornav/section_t.hpp"
#include "floornav/surfel_cell_t.hpp"
#include "floornav/surfel_t.hpp"
#include "floornav/surfels_t.hpp"
#include "floornav/terrain_map_t.hpp"
#include "floornav/terrain_tile_t.hpp"

namespace floornav {

/// Every type of lcmtypes/.
using MessageTypes =
    std::tuple<depth_cloud_t, drop_t, goal_t, grid_map_t, grid_tile_t, health_t, image_metadata_t, image_t,
               latency_t, map_request_t, path_point_t, path_t, pose_t, rate_t, rigid_transform_t, section_t,
               surfel_cell_t, surfel_t, surfels_t, terrain_map_t, terrain_tile_t>;

/// A message of a likely kind, none of its arrays empty; the same for the same seed.
template <class Message>
Message sample_message(std::uint32_t seed);

/// A message as it goes over the wire; empty where it does not encode.
template <class Message>
std::vector<std::uint8_t> encoded(const Message& message) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  const auto size = static_cast<int>(bytes.size());
  if (message.encode(bytes.data(), 0, size) != size) bytes.clear();
  return bytes;
}

/// Decodes bytes that lie alone in memory, so that a sanitizer sees every read outside them.
template <class Message>
bool decodes(Message& message, const std::vector<std::uint8_t>& bytes) {
  const auto size = static_cast<int>(bytes.size());
  return message.decode(bytes.data(), 0, size) == size;
}

/// One of MessageTypes behind a common face. It holds a message and decodes into it again and again, as a
/// subscriber does.
class AnyMessage {
 public:
  virtual ~AnyMessage() = default;
  [[nodiscard]] virtual std::string name() const = 0;
  /// sample_message(seed), encoded.
  [[nodiscard]] virtual std::vector<std::uint8_t> sample(std::uint32_t seed) const = 0;
  /// What the generated decode returns.
  virtual int decode(const std::vector<std::uint8_t>& bytes) = 0;
  /// The held message, encoded.
  [[nodiscard]] virtual std::vector<std::uint8_t> encode() const = 0;
};

/// In the order of MessageTypes.
std::vector<std::unique_ptr<AnyMessage>> every_message_type();

}  // namespace floornav
