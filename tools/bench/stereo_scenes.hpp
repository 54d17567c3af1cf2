#pragma once

#include <cstdint>
#include <vector>

#include <opencv2/core.hpp>

#include "tools/simulator/stereo/stereo_rig.hpp"

namespace floornav {

/// A rendered pair of raw images, with what is true of the ideal left one.
struct StereoScene {
  cv::Mat raw_left, raw_right;  ///< grey
  cv::Mat1f disparity;          ///< px; 0: nothing there
  cv::Mat1b seen_by_both;       ///< 1: the right eye sees the same place
  cv::Mat1b near_floor;         ///< 1: floor within 3 m of the camera, along the floor
};

/// A robot's views of a textured floor with a wall and random boxes and cylinders on it, from 0.72 m and 20
/// degrees down.
std::vector<StereoScene> stereo_scenes(StereoRig& rig, int count, std::uint64_t seed);

/// How good disparities are.
struct StereoQuality {
  std::int64_t floor = 0;        ///< floor pixels within 3 m that both eyes see
  std::int64_t floor_valid = 0;  ///< of those with a disparity
  std::int64_t valid = 0;        ///< all pixels with a disparity, of those that both eyes see
  std::int64_t bad = 0;          ///< of those wrong by more than 1 px
  double squares_px2 = 0;        ///< of the others' errors

  /// `found`: px, 0 where none; rows outside `rows` do not count.
  void add(const StereoScene& scene, const cv::Mat1f& found, cv::Range rows);
};

/// Largest mean error over disparities of equal fraction of a pixel, px: what a slanted plane makes of pixel
/// locking.
double locking_px(const StereoScene& scene, const cv::Mat1f& found);

}  // namespace floornav
