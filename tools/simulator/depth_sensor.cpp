#include "tools/simulator/depth_sensor.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "tools/simulator/random.hpp"
#include "tools/simulator/raycaster.hpp"

namespace floornav {
namespace {

enum Stream : std::uint64_t { kNoise = 1, kMissing = 2, kEdges = 3, kDistortion = 4 };

constexpr float kEdge_px = 1.5F;  ///< neighbours whose disparities differ by more lie on two surfaces
constexpr double kDepthUnit_m = 0.001;
constexpr double kContinuousUnit_px = 1.0 / 256.0;
constexpr float kMostCounts = 65535.0F;

std::size_t pixels_of(const Pinhole& camera) {
  return static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height);
}

/// The random part of a noise whose total includes a quantisation error, uniform over one quantum.
float random_part(const DisparityNoise& noise) {
  const double square = noise.sigma_px * noise.sigma_px - noise.quantum_px * noise.quantum_px / 12.0;
  return static_cast<float>(std::sqrt(std::max(0.0, square)));
}

/// Step of the disparity in which a Bumblebee's pixels count.
double disparity_unit(const DisparityNoise& noise) {
  return noise.quantum_px > 0 ? noise.quantum_px : kContinuousUnit_px;
}

}  // namespace

DepthSensor::DepthSensor(const SensorSpec& model, std::uint64_t seed)
    : model_(model),
      seed_(seed),
      focal_baseline_(
          static_cast<float>(static_cast<double>(model.camera.fx) * model.decimation * model.baseline_m)),
      noise_(model.camera.width, model.camera.height, model.noise.correlation_px / model.decimation),
      depth_(pixels_of(model.camera)),
      disparity_(pixels_of(model.camera)),
      measured_row_(static_cast<std::size_t>(model.camera.width)),
      uniform_row_(static_cast<std::size_t>(model.camera.width)),
      hidden_row_(static_cast<std::size_t>(model.camera.width)),
      counts_(pixels_of(model.camera)) {
  if (model.noise.distortion_px > 0) distort();
}

double DepthSensor::unit() const {
  return model_.kind == SensorKind::kKinect ? kDepthUnit_m : disparity_unit(model_.noise) / model_.decimation;
}

/// A fixed parabola over the image, as badly calibrated lenses leave it.
void DepthSensor::distort() {
  RandomStream random(random_key({seed_, kDistortion}));
  const double radial = random.uniform(0.4, 0.6) * (random.uniform() < 0.5 ? -1 : 1);
  const double tilt_x = random.uniform(-0.2, 0.2);
  const double tilt_y = random.uniform(-0.2, 0.2);
  distortion_.reserve(depth_.size());
  for (int v = 0; v < model_.camera.height; ++v) {
    for (int u = 0; u < model_.camera.width; ++u) {
      const double x = 2.0 * u / model_.camera.width - 1.0;
      const double y = 2.0 * v / model_.camera.height - 1.0;
      const double shape = radial * (x * x + y * y - 0.5) + tilt_x * x + tilt_y * y;
      distortion_.push_back(static_cast<float>(model_.noise.distortion_px * shape));
    }
  }
}

/// A pixel is hidden from the other eye where a nearer surface on that eye's side projects over it: in
/// rectified views pixel u is seen at u - e d there (e = +1: other eye to the right), and the order of what
/// is seen does not change.
void DepthSensor::shadow_row(const float* disparity, std::uint8_t* hidden) const {
  const int width = model_.camera.width;
  const auto own_pixels = static_cast<float>(model_.decimation);
  if (model_.other_eye > 0) {
    float least = kNoHit;
    for (int u = width - 1; u >= 0; --u) {
      const float there = own_pixels * static_cast<float>(u) - disparity[u];
      hidden[u] = there >= least ? 1 : 0;
      least = std::min(least, there);
    }
  } else {
    float most = -kNoHit;
    for (int u = 0; u < width; ++u) {
      const float there = own_pixels * static_cast<float>(u) + disparity[u];
      hidden[u] = there <= most ? 1 : 0;
      most = std::max(most, there);
    }
  }
}

/// Some pixels on an edge report something between its two sides ("flying pixels").
void DepthSensor::mix_edges(int v, std::uint64_t key, const float* next, float* disparity) const {
  const int width = model_.camera.width;
  const bool last = v + 1 == model_.camera.height;
  const auto share = static_cast<float>(model_.noise.flying);
  for (int u = 0; u < width; ++u) {
    const float right = u + 1 < width ? disparity[u + 1] : disparity[u];
    const float below = last ? disparity[u] : next[u];
    const float other = std::fabs(right - disparity[u]) > std::fabs(below - disparity[u]) ? right : below;
    if (std::fabs(other - disparity[u]) <= kEdge_px) continue;
    const std::uint64_t bits = random_bits(key, static_cast<std::uint64_t>(u));
    if (static_cast<float>(static_cast<std::int32_t>(bits & 0xFFFFFF)) * 0x1p-24F >= share) continue;
    const float weight = static_cast<float>(static_cast<std::int32_t>(bits >> 40)) * 0x1p-24F;
    disparity[u] += weight * (other - disparity[u]);
  }
}

void DepthSensor::disturb_row(int v, std::uint64_t key, const float* noise, float* disparity,
                              const std::uint8_t* hidden) {
  const auto width = static_cast<std::size_t>(model_.camera.width);
  const float sigma = random_part(model_.noise);
  for (std::size_t u = 0; u < width; ++u) disparity[u] += sigma * noise[u];
  if (!distortion_.empty()) {
    const float* offset = distortion_.data() + static_cast<std::size_t>(v) * width;
    for (std::size_t u = 0; u < width; ++u) disparity[u] += offset[u];
  }
  fill_uniforms(key, uniform_row_);
  const auto missing = static_cast<float>(model_.noise.missing);
  for (std::size_t u = 0; u < width; ++u)
    disparity[u] = (uniform_row_[u] < missing) | (hidden[u] != 0) ? 0.0F : disparity[u];
}

/// Quantises disparities and writes counts; 0 where out of range.
void DepthSensor::count_row(const float* disparity, std::uint16_t* out) const {
  const int width = model_.camera.width;
  const auto quantum = static_cast<float>(disparity_unit(model_.noise));
  const bool quantised = model_.noise.quantum_px > 0 || model_.kind == SensorKind::kBumblebee;
  const bool depth = model_.kind == SensorKind::kKinect;
  const auto least_px = static_cast<float>(static_cast<double>(focal_baseline_) / model_.max_range_m);
  const auto most_px = static_cast<float>(static_cast<double>(focal_baseline_) / model_.min_range_m);
  const float counts_per_inverse_px = focal_baseline_ / static_cast<float>(kDepthUnit_m);
  const float per_quantum = 1.0F / quantum;
  for (int u = 0; u < width; ++u) {
    const bool valid = (disparity[u] >= least_px) & (disparity[u] <= most_px);
    const float d = valid ? disparity[u] : most_px;
    const auto steps = static_cast<float>(static_cast<std::int32_t>(d * per_quantum + 0.5F));
    const float kept = quantised ? steps * quantum : d;
    const float count = depth ? counts_per_inverse_px / kept + 0.5F : steps;
    out[u] = valid & (count < kMostCounts) ? static_cast<std::uint16_t>(static_cast<std::int32_t>(count)) : 0;
  }
}

std::span<const std::uint16_t> DepthSensor::measure(const Shapes& shapes, const Pose& T_world_body,
                                                    std::int64_t frame) {
  cast_depth(shapes, model_.camera, T_world_body * model_.T_body_sensor, depth_);
  return measure(depth_, frame);
}

std::span<const std::uint16_t> DepthSensor::measure(std::span<const float> depth, std::int64_t frame) {
  const auto width = static_cast<std::size_t>(model_.camera.width);
  const auto number = static_cast<std::uint64_t>(frame);
  for (std::size_t i = 0; i < disparity_.size(); ++i) disparity_[i] = focal_baseline_ / depth[i];
  const std::vector<float>& noise = noise_.draw(random_key({seed_, number, kNoise}));
  for (int v = 0; v < model_.camera.height; ++v) {
    const std::size_t start = static_cast<std::size_t>(v) * width;
    const auto row = static_cast<std::uint64_t>(v);
    const float* exact = disparity_.data() + start;
    if (model_.noise.shadow) shadow_row(exact, hidden_row_.data());
    std::copy(exact, exact + width, measured_row_.begin());
    mix_edges(v, random_key({seed_, number, kEdges, row}), exact + width, measured_row_.data());
    disturb_row(v, random_key({seed_, number, kMissing, row}), noise.data() + start, measured_row_.data(),
                hidden_row_.data());
    count_row(measured_row_.data(), counts_.data() + start);
  }
  return counts_;
}

}  // namespace floornav
