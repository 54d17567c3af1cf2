#pragma once

#include <cstdint>
#include <string>
#include <utility>
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
  [[nodiscard]] bool is_last() const { return part + 1 == parts; }

  EvidenceSource source;
  int part = 0;
  int parts = 1;           ///< 0: not known yet, more follow
  FloorEvidence evidence;  ///< without pixel counts; surfel and section indices are of this part
};

/// No message is longer.
inline constexpr int kMaxSurfelsMessage_bytes = 60'000;

/// Makes messages of a frame's evidence as it comes: parts that each stand alone, with all sections in every
/// part; a surfel in the part of its cells, and again in the next one if they do not fit into one. In each
/// call nearest sections first, then the cells without a surfel. Source, session and seq are left to the
/// sender.
class FrameMessages {
 public:
  explicit FrameMessages(EvidenceSource source) : source_(std::move(source)) {}

  /// Of the surfels and cells behind those of the calls before. The last call, even if there is nothing more,
  /// tells how many parts there are.
  std::vector<surfels_t> next(const FloorEvidence& evidence, bool is_last);

 private:
  EvidenceSource source_;
  std::size_t surfels_ = 0, cells_ = 0, parts_ = 0;  ///< told already
};

/// All of a frame's evidence at once.
std::vector<surfels_t> to_messages(const FloorEvidence& evidence, const EvidenceSource& source);

/// The inverse. Throws std::invalid_argument, saying what is wrong, for a message that no perception sends:
/// an index out of range, a value that is not finite, evidence of a skipped section.
EvidencePart to_evidence(const surfels_t& message);

}  // namespace floornav
