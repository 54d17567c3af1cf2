#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mapping/edges.hpp"

namespace floornav {

/// What is joined to the robot's floor, and what is not because eq. (2) says so. All by side neighbours: a
/// diagonal is never open where the ways around it are closed.
class FloorReach {
 public:
  /// `max_rise`: per metre, of the steepest floor that the robot drives.
  FloorReach(const StepRule& rule, float max_rise);

  /// Grows the robot's floor (Vertex::kFloor) anew over open steps through the tiles of `work`, from the
  /// seeds and from the floor of the tiles around, which stays as it was. Tiles that the floor grew into
  /// beyond them are appended to `work`. MapTile::judged of the tiles in work must be `version`, of no other
  /// tile. All of them must have, and then have, their MapTile::steps_open.
  void grow(std::vector<MapTile*>& work, std::span<const VertexRef> seeds, std::int64_t version);

  /// Sets Vertex::kCutOff on the drivable parts of `work` that lie beside the robot's floor with only steps
  /// of more than T towards it: box tops, kerbs, the ground below an edge. A part that only unknown ground
  /// separates from the floor is not cut off, unless no ramp that the robot drives could join the two across
  /// it.
  void find_cut_off(std::span<MapTile* const> work, std::int64_t version);

  /// Whether the robot's floor comes within two vertices of a place.
  [[nodiscard]] static bool beside_floor(const VertexRef& place);

 private:
  enum class Contact { kNone, kLevel, kStep };

  void enter(const VertexRef& place, std::vector<MapTile*>& work, std::int64_t version);
  void spread(std::vector<MapTile*>& work, std::int64_t version);
  void mark_part(const VertexRef& start,
                 std::int64_t version);  ///< a part: all that open steps join to `start`
  [[nodiscard]] Contact contact_of(const VertexRef& from) const;
  [[nodiscard]] float unexplained_step(const VertexRef& from, std::int32_t dx, std::int32_t dy) const;

  StepRule rule_;
  float rise_per_vertex_m_;  ///< of the steepest ramp that the robot drives
  std::int32_t contact_range_;
  std::vector<VertexRef> queue_;
};

}  // namespace floornav
