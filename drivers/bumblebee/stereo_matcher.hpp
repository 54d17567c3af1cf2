#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "drivers/bumblebee/coarse_matcher.hpp"
#include "drivers/bumblebee/disparity_refinement.hpp"
#include "drivers/bumblebee/roi_search.hpp"
#include "runtime/geometry/parallel.hpp"
#include "runtime/geometry/pinhole.hpp"
#include "runtime/geometry/settings.hpp"

namespace floornav {

/// How pairs of images become disparities.
struct StereoSettings {
  std::string matcher = "auto";   ///< half, quarter: SGBM at that resolution, refined at full; auto: quarter
                                  ///< of images from 1024 px on, else half; sgbm: SGBM at full, refined;
                                  ///< block: StereoBM
  double nearest_m = 0.6;         ///< of what is matched; nearer takes more time
  int refinement_window_px = 15;  ///< width of the window in which disparities are refined
  int refinement_rows_px = 5;     ///< its height: the top of a box far away is seen in few rows
  double max_sigma_px = 0.18;     ///< disparities less certain are left out
  int speckle_px = 200;           ///< patches of disparity smaller than this are left out
};

template <class Visitor>
void visit_settings(Visitor& visit, StereoSettings& s) {
  visit("matcher", s.matcher, {"auto", "half", "quarter", "sgbm", "block"});
  visit("nearest_m", s.nearest_m, Allowed{0.1, 10.0});
  visit("refinement_window_px", s.refinement_window_px, Allowed{3, 31});
  visit("refinement_rows_px", s.refinement_rows_px, Allowed{3, 31});
  visit("max_sigma_px", s.max_sigma_px, Allowed{0.01, 4.0});
  visit("speckle_px", s.speckle_px, Allowed{0, 10000});
}

/// Disparities of the left image, row by row.
struct DisparityImage {
  static constexpr float kUnit_px = 1.0F / 128;       ///< of a pixel's count
  static constexpr float kSigmaUnit_px = 1.0F / 128;  ///< of an uncertainty's count

  int width = 0;
  int height = 0;
  std::vector<std::uint16_t> pixels;      ///< kUnit_px; 0: none
  std::vector<std::uint8_t> uncertainty;  ///< kSigmaUnit_px, 1 sigma; 0 only where the pixel is 0
};

/// Matches rectified pairs: coarsely, then refined by the images' gradients.
class StereoMatcher {
 public:
  /// `search`: of each row. Throws std::runtime_error where it asks for more disparities than the image is
  /// wide.
  StereoMatcher(const StereoSettings& settings, const Pinhole& camera, std::vector<RowSearch> search);

  /// Rectified images of the camera's size, 8-bit grey; only seen_rows() are looked at.
  void match(const cv::Mat& left, const cv::Mat& right, Parallel& parallel, DisparityImage& image);

  /// The rows that get disparities.
  [[nodiscard]] cv::Range rows() const { return coarse_.rows(); }
  /// Those and the ones around them that help.
  [[nodiscard]] cv::Range seen_rows() const { return coarse_.seen_rows(); }

 private:
  /// The pair at one of its sizes; each is half of the one before.
  struct Level {
    cv::Range rows;       ///< that get disparities
    cv::Range seen_rows;  ///< with those around
    cv::Mat1b left, right;
    cv::Mat1f disparity;  ///< px of this size; 0: none
    cv::Mat1f sigma;      ///< 1 sigma, px
    cv::Mat1f other;      ///< what a step reads while it writes the disparities
  };

  void shrink(const Level& larger, Parallel& parallel, Level& level);
  void enlarge_from(const Level& smaller, Parallel& parallel, Level& level);
  void smooth(Parallel& parallel, Level& level);
  void refine(Parallel& parallel, Level& level);
  [[nodiscard]] cv::Size window() const;
  /// Leaves out what is not certain, edges, and patches that nothing around confirms.
  void choose_pixels(Parallel& parallel);
  void write(cv::Range rows, DisparityImage& image) const;

  StereoSettings settings_;
  cv::Size size_;
  CoarseMatcher coarse_;
  std::vector<Level> levels_;                     ///< the whole images first, those of the coarse match last
  std::vector<DisparityRefinement> refinements_;  ///< of each worker
  cv::Mat_<short> patches_;                       ///< the final disparities, 1/16 px; 0: left out
};

}  // namespace floornav
