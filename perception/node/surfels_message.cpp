#include "perception/node/surfels_message.hpp"

#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>

#include "runtime/geometry/pose.hpp"

namespace floornav {

namespace {

/// Left free in each message for the sender's name.
constexpr int kRoomForSource_bytes = 256;
constexpr float kMaxOffset_m = 1e4F;
constexpr float kUnitTolerance = 1e-3F;

template <class Message>
int encoded_bytes() {
  return Message()._getEncodedSizeNoHash();
}

// ------------------------------------------------------------------------------------------------ evidence
// to messages

/// Fills one message after the other.
class PartWriter {
 public:
  explicit PartWriter(const surfels_t& empty)
      : empty_(empty), empty_bytes_(empty.getEncodedSize() + kRoomForSource_bytes), parts_{empty} {
    bytes_ = empty_bytes_;
  }

  [[nodiscard]] bool fits(std::size_t surfels, std::size_t cells) const {
    const auto more =
        surfels * static_cast<std::size_t>(surfel_bytes_) + cells * static_cast<std::size_t>(cell_bytes_);
    return static_cast<std::size_t>(bytes_) + more <= static_cast<std::size_t>(kMaxSurfelsMessage_bytes);
  }
  void begin_part() {
    parts_.push_back(empty_);
    bytes_ = empty_bytes_;
  }
  void add(const surfel_t& surfel) {
    parts_.back().surfels.push_back(surfel);
    bytes_ += surfel_bytes_;
  }
  /// `with_surfel`: on the surfel added last.
  void add(surfel_cell_t cell, bool with_surfel) {
    cell.surfel =
        with_surfel ? static_cast<std::int16_t>(parts_.back().surfels.size() - 1) : std::int16_t{-1};
    parts_.back().cells.push_back(cell);
    bytes_ += cell_bytes_;
  }
  /// `first`: parts of the frame that were taken before.
  std::vector<surfels_t> take(std::size_t first, bool is_last) {
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      parts_[i].part = static_cast<std::int16_t>(first + i);
      parts_[i].parts = is_last ? static_cast<std::int16_t>(first + parts_.size()) : std::int16_t{0};
      parts_[i].n_surfels = static_cast<std::int32_t>(parts_[i].surfels.size());
      parts_[i].n_cells = static_cast<std::int32_t>(parts_[i].cells.size());
    }
    return std::move(parts_);
  }

 private:
  const int surfel_bytes_ = encoded_bytes<surfel_t>();
  const int cell_bytes_ = encoded_bytes<surfel_cell_t>();
  surfels_t empty_;
  int empty_bytes_;
  int bytes_ = 0;
  std::vector<surfels_t> parts_;
};

section_t to_message(const SectionReport& section) {
  section_t m;
  m.ix = section.ix;
  m.iy = section.iy;
  m.state = section.done ? section_t::DONE : section.later ? section_t::LATER : section_t::SKIPPED;
  m.age = section.age;
  m.points = section.points;
  return m;
}

surfel_t to_message(const Surfel& surfel, const Eigen::Vector3d& origin) {
  surfel_t m;
  Eigen::Map<Eigen::Vector3f>{m.centroid} = (surfel.centroid_m - origin).cast<float>();
  Eigen::Map<Eigen::Vector3f>{m.normal} = surfel.normal;
  m.radius = surfel.radius_m;
  m.rms = surfel.rms_m;
  m.points = surfel.points;
  m.section = surfel.section;
  m.flags = static_cast<std::int8_t>((surfel.dominant ? surfel_t::DOMINANT : 0) |
                                     (surfel.traversable ? surfel_t::TRAVERSABLE : 0));
  return m;
}

surfel_cell_t to_message(const CellEvidence& cell, CellIndex origin, double origin_z) {
  const auto z = static_cast<float>(origin_z);
  surfel_cell_t m;
  m.ix = static_cast<std::int16_t>(cell.cell.ix - origin.ix);
  m.iy = static_cast<std::int16_t>(cell.cell.iy - origin.iy);
  m.surfel = cell.surfel;
  m.points = cell.points;
  m.mean_z = cell.mean_z_m - z;
  m.var_z = cell.var_z_m2;
  m.top_z = cell.top_z_m - z;
  m.ray_z = cell.ray_z_m - z;
  m.flags = static_cast<std::int8_t>((cell.no_return ? surfel_cell_t::NO_RETURN : 0) |
                                     (cell.partly_hidden ? surfel_cell_t::PARTLY_HIDDEN : 0) |
                                     (cell.on_edge ? surfel_cell_t::ON_EDGE : 0));
  return m;
}

surfels_t frame_message(const FloorEvidence& evidence, const EvidenceSource& source) {
  surfels_t m;
  m.utime = evidence.utime_us;
  m.cloud_source = source.cloud_source;
  m.cloud_session = source.cloud_session;
  m.frame = source.frame;
  m.sensor = source.sensor;
  pose_to_arrays(evidence.T_body_sensor, m.sensor_pos, m.sensor_orientation);
  pose_to_arrays(evidence.T_world_body, m.body_pos, m.body_orientation);
  const Eigen::Vector3d origin = evidence.T_world_body.translation();
  Eigen::Map<Eigen::Vector3d>{m.origin} = origin;
  const CellIndex cell = evidence.lattice.cell_of(origin.x(), origin.y());
  m.pitch = evidence.lattice.pitch_m;
  m.origin_ix = cell.ix;
  m.origin_iy = cell.iy;
  for (const SectionReport& section : evidence.sections) m.sections.push_back(to_message(section));
  m.n_sections = static_cast<std::int32_t>(m.sections.size());
  m.n_surfels = 0;
  m.n_cells = 0;
  m.part = 0;
  m.parts = 1;
  m.session = 0;
  m.seq = 0;
  return m;
}

/// The cells from number `first` on, of each surfel; the last list is of those without one.
std::vector<std::vector<const CellEvidence*>> cells_by_surfel(const FloorEvidence& evidence,
                                                              std::size_t first) {
  std::vector<std::vector<const CellEvidence*>> cells(evidence.surfels.size() + 1);
  for (const CellEvidence& cell : std::span(evidence.cells).subspan(first))
    (cell.surfel < 0 ? cells.back() : cells.at(static_cast<std::size_t>(cell.surfel))).push_back(&cell);
  return cells;
}

// ------------------------------------------------------------------------------------------------ message to
// evidence

void require(bool holds, const char* what) {
  if (!holds) throw std::invalid_argument(std::string("surfels: ") + what);
}

bool is_offset(float value) {
  return std::abs(value) <= kMaxOffset_m;
}  // false for NaN

void check_frame(const surfels_t& m) {
  require(m.parts >= 0 && m.part >= 0 && (m.parts == 0 || m.part < m.parts), "part is not one of parts");
  require(m.pitch >= 1e-3 && m.pitch <= 10.0, "absurd pitch");
  for (const double p : m.origin) require(std::abs(p) <= kMaxPosition_m, "absurd origin");
  for (const double p : m.body_pos) require(std::abs(p) <= kMaxPosition_m, "absurd body position");
  for (const double p : m.sensor_pos) require(std::abs(p) <= kMaxPosition_m, "absurd sensor position");
  constexpr std::int32_t kMaxIndex = std::numeric_limits<std::int32_t>::max() - 40'000;
  require(std::abs(static_cast<std::int64_t>(m.origin_ix)) <= kMaxIndex &&
              std::abs(static_cast<std::int64_t>(m.origin_iy)) <= kMaxIndex,
          "absurd origin of the lattice");
}

SectionReport section_of(const section_t& m) {
  require(m.ix >= 0 && m.iy >= 0 && m.age >= 0 && m.points >= 0, "a section has a negative value");
  require(m.state == section_t::DONE || m.state == section_t::SKIPPED || m.state == section_t::LATER,
          "unknown state of a section");
  return {m.ix, m.iy, m.state == section_t::DONE, m.age, m.points, m.state == section_t::LATER};
}

Surfel surfel_of(const surfel_t& m, const FloorEvidence& evidence, const Eigen::Vector3d& origin) {
  require(m.section >= 0 && static_cast<std::size_t>(m.section) < evidence.sections.size(),
          "a surfel's section is out of range");
  require(evidence.sections[static_cast<std::size_t>(m.section)].done, "a surfel of a skipped section");
  for (const float c : m.centroid) require(is_offset(c), "absurd centroid");
  const Eigen::Vector3f normal(m.normal[0], m.normal[1], m.normal[2]);
  require(std::abs(normal.norm() - 1.0F) <= kUnitTolerance, "a normal is no unit vector");
  require(m.radius >= 0.0F && is_offset(m.radius) && m.rms >= 0.0F && is_offset(m.rms),
          "absurd radius or rms");
  require(m.points > 0, "a surfel without points");
  require((m.flags & ~(surfel_t::DOMINANT | surfel_t::TRAVERSABLE)) == 0, "unknown flag of a surfel");
  Surfel surfel;
  surfel.centroid_m = origin + Eigen::Vector3d(m.centroid[0], m.centroid[1], m.centroid[2]);
  surfel.normal = normal;
  surfel.radius_m = m.radius;
  surfel.rms_m = m.rms;
  surfel.points = m.points;
  surfel.section = m.section;
  surfel.dominant = (m.flags & surfel_t::DOMINANT) != 0;
  surfel.traversable = (m.flags & surfel_t::TRAVERSABLE) != 0;
  return surfel;
}

CellEvidence cell_of(const surfel_cell_t& m, const surfels_t& frame) {
  require(m.surfel >= -1 && m.surfel < frame.n_surfels, "a cell's surfel is out of range");
  require(m.points >= 0, "a cell has a negative number of points");
  constexpr int kFlags = surfel_cell_t::NO_RETURN | surfel_cell_t::PARTLY_HIDDEN | surfel_cell_t::ON_EDGE;
  require((m.flags & ~kFlags) == 0, "unknown flag of a cell");
  require(std::isnan(m.ray_z) || is_offset(m.ray_z), "absurd sight line");
  const auto z = static_cast<float>(frame.origin[2]);
  CellEvidence cell;
  cell.cell = {frame.origin_ix + m.ix, frame.origin_iy + m.iy};
  cell.points = m.points;
  cell.ray_z_m = m.ray_z + z;
  cell.no_return = (m.flags & surfel_cell_t::NO_RETURN) != 0;
  cell.partly_hidden = (m.flags & surfel_cell_t::PARTLY_HIDDEN) != 0;
  cell.on_edge = (m.flags & surfel_cell_t::ON_EDGE) != 0;
  if (m.points == 0) {
    require(m.surfel == -1, "a cell without points has a surfel");
    return cell;
  }
  require(is_offset(m.mean_z) && is_offset(m.top_z), "absurd height of a cell");
  require(m.var_z >= 0.0F && is_offset(m.var_z), "absurd variance of a cell");
  cell.surfel = m.surfel;
  cell.mean_z_m = m.mean_z + z;
  cell.var_z_m2 = m.var_z;
  cell.top_z_m = m.top_z + z;
  return cell;
}

}  // namespace

std::vector<surfels_t> FrameMessages::next(const FloorEvidence& evidence, bool is_last) {
  const surfels_t empty = frame_message(evidence, source_);
  const Eigen::Vector3d origin = evidence.T_world_body.translation();
  const CellIndex origin_cell{empty.origin_ix, empty.origin_iy};
  const auto cells = cells_by_surfel(evidence, cells_);
  PartWriter writer(empty);
  for (std::size_t s = 0; s < evidence.surfels.size(); ++s) {
    if (s < surfels_ && cells[s].empty()) continue;
    const surfel_t surfel = to_message(evidence.surfels[s], origin);
    if (!writer.fits(1, cells[s].size())) writer.begin_part();
    writer.add(surfel);
    for (const CellEvidence* cell : cells[s]) {
      if (!writer.fits(0, 1)) {
        writer.begin_part();
        writer.add(surfel);
      }
      writer.add(to_message(*cell, origin_cell, origin.z()), true);
    }
  }
  for (const CellEvidence* cell : cells.back()) {
    if (!writer.fits(0, 1)) writer.begin_part();
    writer.add(to_message(*cell, origin_cell, origin.z()), false);
  }
  std::vector<surfels_t> messages = writer.take(parts_, is_last);
  surfels_ = evidence.surfels.size();
  cells_ = evidence.cells.size();
  parts_ += messages.size();
  return messages;
}

std::vector<surfels_t> to_messages(const FloorEvidence& evidence, const EvidenceSource& source) {
  return FrameMessages(source).next(evidence, true);
}

EvidencePart to_evidence(const surfels_t& message) {
  check_frame(message);
  EvidencePart part;
  part.source = {message.cloud_source, message.cloud_session, message.frame, message.sensor};
  part.part = message.part;
  part.parts = message.parts;
  FloorEvidence& evidence = part.evidence;
  evidence.utime_us = message.utime;
  evidence.T_body_sensor = pose_from_arrays(message.sensor_pos, message.sensor_orientation);
  evidence.T_world_body = pose_from_arrays(message.body_pos, message.body_orientation);
  evidence.lattice.pitch_m = message.pitch;
  const Eigen::Vector3d origin(message.origin[0], message.origin[1], message.origin[2]);
  for (const section_t& section : message.sections) evidence.sections.push_back(section_of(section));
  for (const surfel_t& surfel : message.surfels)
    evidence.surfels.push_back(surfel_of(surfel, evidence, origin));
  for (const surfel_cell_t& cell : message.cells) evidence.cells.push_back(cell_of(cell, message));
  return part;
}

}  // namespace floornav
