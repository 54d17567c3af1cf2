#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "floornav/surfels_t.hpp"
#include "perception/evidence.hpp"

namespace floornav {

/// Where a batch of evidence comes from.
struct EvidenceSource {
  std::string cloud_source;
  std::int64_t cloud_session = 0;
  std::int64_t frame = 0;
  std::int8_t sensor = 0;  ///< as depth_cloud_t.sensor
};

/// A part of one frame's evidence as it came over the wire.
struct EvidencePart {
  EvidenceSource source;
  int part = 0;
  int parts = 1;
  FloorEvidence evidence;  ///< without pixel counts; surfel and section indices are of this part
};

/// No message is longer.
inline constexpr int kMaxSurfelsMessage_bytes = 60'000;

/// A frame's evidence in parts that each stand alone: all sections in every part; a surfel in the part of its
/// cells, and again in the next one if they do not fit into one. Nearest sections first, then the cells
/// without a surfel. Source, session and seq are left to the sender.
std::vector<surfels_t> to_messages(const FloorEvidence& evidence, const EvidenceSource& source);

/// The inverse. Throws std::invalid_argument, saying what is wrong, for a message that no perception sends:
/// an index out of range, a value that is not finite, evidence of a skipped section.
EvidencePart to_evidence(const surfels_t& message);

}  // namespace floornav
