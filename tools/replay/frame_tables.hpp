#pragma once

#include <filesystem>

#include "tools/replay/frame_evidence.hpp"
#include "tools/replay/frame_floor.hpp"
#include "tools/replay/text_file.hpp"

namespace floornav {

/// surfels.csv: a line for every surfel of every frame, with its place in the local frame.
class SurfelTable {
 public:
  explicit SurfelTable(const std::filesystem::path& file);
  void add(const FrameEvidence& frame);
  void close() { file_.close(); }

 private:
  TextFile file_;
};

/// frames.csv: a line for every frame, with the floor that it found; empty columns where it found none.
class FrameTable {
 public:
  explicit FrameTable(const std::filesystem::path& file);
  void add(const FrameEvidence& frame, const FrameFloor& floor);
  void close() { file_.close(); }

 private:
  TextFile file_;
};

}  // namespace floornav
