#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <vector>

#include "floornav/depth_cloud_t.hpp"
#include "mapping/grid_map.hpp"
#include "runtime/process/log_event.hpp"
#include "tools/pictures/frame_picture.hpp"
#include "tools/replay/frame_evidence.hpp"
#include "tools/replay/frame_floor.hpp"

namespace floornav {

/// frames/NNNNNN.png: what the sensor saw, coloured by what the map says of it, beside that part of the map.
class FramePictures {
 public:
  /// Makes the folder. `height_m`: points higher than this above the body's floor are left grey.
  FramePictures(std::filesystem::path folder, double height_m, double radius_m);

  /// Keeps the log's clouds until their frame is drawn.
  void see(const LogEvent& event);
  void draw(const FrameEvidence& frame, const FrameFloor& floor, const GridMap& map);

 private:
  /// A frame as its strips fill it.
  struct Image {
    depth_cloud_t cloud;                ///< its first strip
    std::vector<std::uint16_t> pixels;  ///< whole frame; 0 where no strip has come
  };
  Image* image_of(const FrameEvidence& frame);
  [[nodiscard]] std::vector<std::uint32_t> colors_of(const Image& image, const FrameEvidence& frame,
                                                     const GridMap& map) const;

  std::filesystem::path folder_;
  double height_m_;
  double radius_m_;
  std::deque<Image> images_;  ///< the newest ones
  std::vector<std::uint16_t> strip_;
};

}  // namespace floornav
