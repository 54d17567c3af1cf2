#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "drivers/bumblebee/calibration/stored_calibration.hpp"
#include "runtime/geometry/pinhole.hpp"
#include "runtime/geometry/pose.hpp"
#include "tools/simulator/shapes.hpp"
#include "tools/simulator/stereo/world_texture.hpp"

namespace floornav {

/// A stereo camera with bent lenses.
struct StereoRigSpec {
  Pinhole ideal;               ///< of each eye once rectified; raw images are as large
  std::vector<double> eyes_m;  ///< how far each eye is to the left of the right one, which comes first
  double distortion = -0.30;   ///< k1 of the lenses
  double noise = 2.0;          ///< 1 sigma of a pixel, grey levels
  std::string bayer;           ///< of a colour camera, "GBRG" say; empty: mono

  [[nodiscard]] double baseline_m() const { return eyes_m.back(); }
};

/// 640 x 480, 0.12 m.
StereoRigSpec bumblebee2_rig();
/// 1280 x 960, 0.12 and 0.24 m.
StereoRigSpec bumblebee_xb3_rig();

/// Renders what such a camera's eyes see.
class StereoRig {
 public:
  StereoRig(const StereoRigSpec& spec, std::uint64_t seed);

  [[nodiscard]] const StereoRigSpec& spec() const { return spec_; }
  /// As the camera stores it.
  [[nodiscard]] StoredCalibration calibration() const;
  /// Raw images, right eye first, as the sensors give them (a colour camera's as a mosaic). `T_world_left`:
  /// of the leftmost eye. Another `frame`, another noise. Valid until the next call.
  const std::vector<cv::Mat>& see(const Shapes& shapes, const Pose& T_world_left, std::int64_t frame);
  /// The exact disparity of the ideal left image of the outer eyes, px; 0 where nothing is.
  [[nodiscard]] cv::Mat1f true_disparity(const Shapes& shapes, const Pose& T_world_left) const;

 private:
  [[nodiscard]] cv::Point2d raw_of(std::size_t eye, cv::Point2d ideal) const;
  void bend_lens(std::size_t eye);
  void render(const Shapes& shapes, const Pose& T_world_eye, cv::Mat1f& grey);
  void expose(std::size_t eye, std::int64_t frame, const cv::Mat1f& seen, cv::Mat& raw) const;

  StereoRigSpec spec_;
  std::uint64_t seed_;
  WorldTexture texture_;
  Pinhole canvas_;                 ///< the ideal eye, with margins
  std::vector<cv::Mat2f> lenses_;  ///< where each raw pixel of an eye looks on the canvas, px
  std::vector<float> depth_;
  cv::Mat1f ideal_, bent_;
  std::vector<cv::Mat> raw_;
};

}  // namespace floornav
