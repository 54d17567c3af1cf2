#include "tools/replay/frame_tables.hpp"

#include <cstdint>

#include <fmt/format.h>

namespace floornav {

SurfelTable::SurfelTable(const std::filesystem::path& file) : file_(file) {
  file_.write("frame,utime,section_x,section_y,x,y,z,nx,ny,nz,radius,rms,points,dominant,traversable\n");
}

void SurfelTable::add(const FrameEvidence& frame) {
  for (const Surfel& s : frame.evidence.surfels) {
    const SectionReport& section = frame.evidence.sections.at(static_cast<std::size_t>(s.section));
    file_.write(fmt::format(
        "{},{},{},{},{:.4f},{:.4f},{:.4f},{:.5f},{:.5f},{:.5f},{:.4f},{:.4f},{},{:d},{:d}\n", frame.frame,
        frame.evidence.utime_us, section.ix, section.iy, s.centroid_m.x(), s.centroid_m.y(), s.centroid_m.z(),
        s.normal.x(), s.normal.y(), s.normal.z(), s.radius_m, s.rms_m, s.points, s.dominant, s.traversable));
  }
}

FrameTable::FrameTable(const std::filesystem::path& file) : file_(file) {
  file_.write(
      "frame,utime,points,sections_done,sections_skipped,surfels,floor_points,floor_z,floor_tilt_deg,"
      "camera_height,camera_pitch_deg,camera_roll_deg\n");
}

void FrameTable::add(const FrameEvidence& frame, const FrameFloor& floor) {
  const FloorEvidence& evidence = frame.evidence;
  std::int64_t points = 0;
  int done = 0;
  for (const SectionReport& section : evidence.sections) {
    points += section.points;
    done += section.done ? 1 : 0;
  }
  file_.write(fmt::format("{},{},{},{},{},{},{}", frame.frame, evidence.utime_us, points, done,
                          static_cast<int>(evidence.sections.size()) - done, evidence.surfels.size(),
                          floor.points));
  file_.write(floor.points == 0
                  ? ",,,,,\n"
                  : fmt::format(",{:.4f},{:.3f},{:.4f},{:.3f},{:.3f}\n", floor.height_m, floor.tilt_deg,
                                floor.camera_height_m, floor.camera_pitch_deg, floor.camera_roll_deg));
}

}  // namespace floornav
