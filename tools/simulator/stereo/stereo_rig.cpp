#include "tools/simulator/stereo/stereo_rig.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "tools/simulator/random.hpp"
#include "tools/simulator/raycaster.hpp"

namespace floornav {
namespace {

/// Coefficients whose spline is nearest to the values at evenly spaced places along one axis.
cv::Mat1d fit_matrix(int samples, int count) {
  cv::Mat1d basis(samples, count, 0.0);
  for (int i = 0; i < samples; ++i) {
    const SplinePlace place = spline_place(static_cast<double>(i) / (samples - 1), count);
    for (int k = 0; k < 4; ++k) basis(i, place.first + k) = place.weight[static_cast<std::size_t>(k)];
  }
  cv::Mat1d inverse;
  cv::invert(basis, inverse, cv::DECOMP_SVD);
  return inverse;
}

/// The spline warp nearest to a map of the unit square.
template <class Map>
SplineWarp fit_warp(Map map) {
  constexpr int kColumns = 14;
  constexpr int kRows = 11;
  constexpr int kSamples = 60;
  cv::Mat1d x(kSamples, kSamples);
  cv::Mat1d y(kSamples, kSamples);
  for (int i = 0; i < kSamples; ++i)
    for (int j = 0; j < kSamples; ++j) {
      const cv::Point2d to = map(cv::Point2d(i, j) / (kSamples - 1));
      x(i, j) = to.x;
      y(i, j) = to.y;
    }
  const cv::Mat1d across = fit_matrix(kSamples, kColumns);
  const cv::Mat1d down = fit_matrix(kSamples, kRows);
  const cv::Mat1d to_x(across * x * down.t());
  const cv::Mat1d to_y(across * y * down.t());
  return {kColumns, kRows, {to_x.begin(), to_x.end()}, {to_y.begin(), to_y.end()}};
}

Pinhole with_margins(const Pinhole& camera) {
  constexpr int kMargin_px = 80;
  Pinhole larger = camera;
  larger.cx += kMargin_px;
  larger.cy += kMargin_px;
  larger.width += 2 * kMargin_px;
  larger.height += 2 * kMargin_px;
  return larger;
}

/// How bright a colour camera's pixel of some colour sees the grey scene, which is a little reddish.
float filter_of(const std::string& bayer, int x, int y) {
  if (bayer.empty()) return 1.0F;
  switch (bayer[static_cast<std::size_t>(2 * (y & 1) + (x & 1))]) {
    case 'R':
      return 1.08F;
    case 'B':
      return 0.86F;
    default:
      return 1.0F;
  }
}

/// How a value changes to the next row: of the rows above and below the one on the same surface tells.
float smaller_step(float above, float here, float below) {
  return std::fabs(here - above) < std::fabs(below - here) ? here - above : below - here;
}

/// Mean of the texture along the strip of a surface that a pixel sees, `wide_m` wide: far away a level
/// surface's is many times longer than wide, and a lens blurs it along its length only.
float mean_between(const WorldTexture& texture, const Eigen::Vector3f& begin, const Eigen::Vector3f& end,
                   float wide_m) {
  constexpr float kMostPieces = 12;
  const float length_m = (end - begin).norm();
  const float pieces = std::clamp(std::ceil(length_m / wide_m), 1.0F, kMostPieces);
  const float footprint_m = std::max(wide_m, length_m / pieces);
  float sum = 0;
  for (float piece = 0.5F; piece < pieces; ++piece) {
    const Eigen::Vector3f place = begin + piece / pieces * (end - begin);
    sum += texture.at(place.x(), place.y(), place.z(), footprint_m);
  }
  return sum / pieces;
}

}  // namespace

StereoRigSpec bumblebee2_rig() {
  StereoRigSpec spec;
  spec.ideal = {522.0F, 522.0F, 322.0F, 243.0F, 640, 480};
  spec.eyes_m = {0.0, 0.12};
  return spec;
}

StereoRigSpec bumblebee_xb3_rig() {
  StereoRigSpec spec;
  spec.ideal = {983.0F, 983.0F, 644.0F, 493.0F, 1280, 960};
  spec.eyes_m = {0.0, 0.12, 0.24};
  spec.bayer = "GBRG";
  return spec;
}

StereoRig::StereoRig(const StereoRigSpec& spec, std::uint64_t seed)
    : spec_(spec), seed_(seed), texture_(seed), canvas_(with_margins(spec.ideal)) {
  lenses_.resize(spec.eyes_m.size());
  raw_.resize(spec.eyes_m.size());
  for (std::size_t eye = 0; eye < lenses_.size(); ++eye) bend_lens(eye);
}

/// Radial distortion, and each eye a little turned in its own way.
cv::Point2d StereoRig::raw_of(std::size_t eye, cv::Point2d ideal) const {
  const std::array<cv::Point2d, 3> kCenters = {cv::Point2d(4.3, -6.1), {-5.2, 3.4}, {-2.9, 5.7}};
  const std::array<double, 3> kTurns = {0.004, -0.003, -0.005};
  const double f = static_cast<double>(spec_.ideal.fx);
  const cv::Point2d center(static_cast<double>(spec_.ideal.cx), static_cast<double>(spec_.ideal.cy));
  const cv::Point2d ray = (ideal - center) / f;
  const double r2 = ray.dot(ray);
  const double bend = 1 + r2 * (spec_.distortion + 0.1 * r2);
  const double turn = kTurns[eye % 3];
  const cv::Point2d turned(ray.x - turn * ray.y, ray.y + turn * ray.x);
  return center + kCenters[eye % 3] + f * bend * turned;
}

void StereoRig::bend_lens(std::size_t eye) {
  cv::Mat2f& lens = lenses_[eye];
  lens.create(spec_.ideal.height, spec_.ideal.width);
  const double margin = (canvas_.width - spec_.ideal.width) / 2.0;
  for (int y = 0; y < lens.rows; ++y) {
    cv::Point2d ideal(0, y);  // the last pixel's place is a good first guess
    for (int x = 0; x < lens.cols; ++x) {
      ideal.x += 1;
      for (int step = 0; step < 20; ++step) {
        const cv::Point2d off = cv::Point2d(x, y) - raw_of(eye, ideal);
        ideal += off;
        if (off.dot(off) < 1e-8) break;
      }
      lens(y, x) = {static_cast<float>(ideal.x + margin), static_cast<float>(ideal.y + margin)};
    }
  }
}

StoredCalibration StereoRig::calibration() const {
  const double w = spec_.ideal.width;
  const double h = spec_.ideal.height;
  StoredCalibration stored;
  stored.focal_length = {static_cast<double>(spec_.ideal.fx) / w, static_cast<double>(spec_.ideal.fy) / h};
  stored.image_center = {static_cast<double>(spec_.ideal.cx) / w, static_cast<double>(spec_.ideal.cy) / h};
  stored.baselines_m = {spec_.eyes_m.back()};
  if (spec_.eyes_m.size() == 3) stored.baselines_m.push_back(spec_.eyes_m[1]);
  for (std::size_t eye = 0; eye < spec_.eyes_m.size(); ++eye)
    stored.eyes.push_back(fit_warp([&](cv::Point2d at) {
      const cv::Point2d raw = raw_of(eye, {at.x * w, at.y * h});
      return cv::Point2d(raw.x / w, raw.y / h);
    }));
  return stored;
}

void StereoRig::render(const Shapes& shapes, const Pose& T_world_eye, cv::Mat1f& grey) {
  constexpr float kMiddleGrey = 120.0F;
  constexpr float kNothing = 60.0F;
  depth_.resize(static_cast<std::size_t>(canvas_.width) * static_cast<std::size_t>(canvas_.height));
  cast_depth(shapes, canvas_, T_world_eye, depth_);
  const Eigen::Isometry3f T = T_world_eye.cast<float>();
  grey.create(canvas_.height, canvas_.width);
  for (int y = 0; y < canvas_.height; ++y) {
    const float* const depth = depth_.data() + static_cast<std::ptrdiff_t>(y) * canvas_.width;
    const float* const above = y > 0 ? depth - canvas_.width : depth;
    const float* const below = y + 1 < canvas_.height ? depth + canvas_.width : depth;
    for (int x = 0; x < canvas_.width; ++x) {
      const float z = depth[x];
      if (!(z < 100.0F)) {
        grey(y, x) = kNothing;
        continue;
      }
      const float step = smaller_step(1 / above[x], 1 / z, 1 / below[x]);
      const auto place = [&](float row) {
        const float inverse_depth = std::max(0.5F / z, 1 / z + (row - static_cast<float>(y)) * step);
        return Eigen::Vector3f(T * Eigen::Vector3f(canvas_.ray(static_cast<float>(x), row) / inverse_depth));
      };
      const auto row = static_cast<float>(y);
      grey(y, x) = kMiddleGrey + mean_between(texture_, place(row - 0.5F), place(row + 0.5F), z / canvas_.fx);
    }
  }
}

void StereoRig::expose(std::size_t eye, std::int64_t frame, const cv::Mat1f& seen, cv::Mat& raw) const {
  const float gain = 1.0F + 0.02F * static_cast<float>(eye);
  std::vector<float> noise(static_cast<std::size_t>(seen.cols));
  raw.create(seen.rows, seen.cols, CV_8UC1);
  for (int y = 0; y < seen.rows; ++y) {
    fill_normals(random_key({seed_, static_cast<std::uint64_t>(frame), eye, static_cast<std::uint64_t>(y)}),
                 noise);
    for (int x = 0; x < seen.cols; ++x)
      raw.at<std::uint8_t>(y, x) = cv::saturate_cast<std::uint8_t>(
          gain * filter_of(spec_.bayer, x, y) * seen(y, x) +
          static_cast<float>(spec_.noise) * noise[static_cast<std::size_t>(x)]);
  }
}

const std::vector<cv::Mat>& StereoRig::see(const Shapes& shapes, const Pose& T_world_left,
                                           std::int64_t frame) {
  for (std::size_t eye = 0; eye < spec_.eyes_m.size(); ++eye) {
    const double right_m = spec_.eyes_m.back() - spec_.eyes_m[eye];
    render(shapes, T_world_left * Eigen::Translation3d(right_m, 0, 0), ideal_);
    cv::remap(ideal_, bent_, lenses_[eye], {}, cv::INTER_CUBIC);
    expose(eye, frame, bent_, raw_[eye]);
  }
  return raw_;
}

cv::Mat1f StereoRig::true_disparity(const Shapes& shapes, const Pose& T_world_left) const {
  cv::Mat1f disparity(spec_.ideal.height, spec_.ideal.width);
  cast_depth(shapes, spec_.ideal, T_world_left, {disparity[0], disparity.total()});
  const float focal_baseline = spec_.ideal.fx * static_cast<float>(spec_.baseline_m());
  for (float& d : disparity) d = d < kNoHit ? focal_baseline / d : 0.0F;
  return disparity;
}

}  // namespace floornav
