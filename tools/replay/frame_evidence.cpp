#include "tools/replay/frame_evidence.hpp"

#include <algorithm>
#include <utility>

#include "perception/node/surfels_message.hpp"

namespace floornav {

namespace {

bool is_same(const Surfel& a, const Surfel& b) {
  return a.section == b.section && a.points == b.points && a.centroid_m == b.centroid_m &&
         a.normal == b.normal;
}

}  // namespace

std::optional<FrameEvidence> FrameCollector::add(const surfels_t& message) {
  EvidencePart part = to_evidence(message);
  for (CellEvidence& cell : part.evidence.cells) cell.surfel = -1;
  if (part.part == 0) {
    collected_ = {part.source.frame, part.source.sensor, std::move(part.evidence)};
  } else {
    FloorEvidence& whole = collected_.evidence;
    whole.sections = std::move(part.evidence.sections);
    for (const Surfel& surfel : part.evidence.surfels)
      if (std::none_of(whole.surfels.begin(), whole.surfels.end(),
                       [&](const Surfel& told) { return is_same(surfel, told); }))
        whole.surfels.push_back(surfel);
    whole.cells.insert(whole.cells.end(), part.evidence.cells.begin(), part.evidence.cells.end());
  }
  if (!part.is_last()) return std::nullopt;
  return std::exchange(collected_, {});
}

}  // namespace floornav
