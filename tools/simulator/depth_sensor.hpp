#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tools/simulator/noise_field.hpp"
#include "tools/simulator/sensor_spec.hpp"
#include "tools/simulator/shapes.hpp"

namespace floornav {

/// What a simulated sensor gives. The pixels are counts of `unit`: metres of depth (Kinect, 1 mm as its
/// driver gives) or pixels of disparity (Bumblebee, its quantum). 0: no measurement.
class DepthSensor {
 public:
  /// The same model, seed and frame give the same image on every machine.
  DepthSensor(const SensorSpec& model, std::uint64_t seed);

  [[nodiscard]] const SensorSpec& model() const { return model_; }
  /// m or px of the given image (not of the full resolution) a count.
  [[nodiscard]] double unit() const;

  /// The image of one frame; valid until the next call.
  std::span<const std::uint16_t> measure(const Shapes& shapes, const Pose& T_world_body, std::int64_t frame);
  /// The same out of exact depths as cast_depth() gives them.
  std::span<const std::uint16_t> measure(std::span<const float> depth, std::int64_t frame);

 private:
  void distort();
  void shadow_row(const float* disparity, std::uint8_t* hidden) const;
  void mix_edges(int v, std::uint64_t key, const float* next, float* disparity) const;
  void disturb_row(int v, std::uint64_t key, const float* noise, float* disparity,
                   const std::uint8_t* hidden);
  void count_row(const float* disparity, std::uint16_t* out) const;

  SensorSpec model_;
  std::uint64_t seed_;
  float focal_baseline_;  ///< px m, of the full resolution
  NoiseField noise_;
  std::vector<float> depth_;
  std::vector<float> disparity_;  ///< exact
  std::vector<float> measured_row_;
  std::vector<float> uniform_row_;
  std::vector<std::uint8_t> hidden_row_;
  std::vector<float> distortion_;  ///< px, empty without
  std::vector<std::uint16_t> counts_;
};

}  // namespace floornav
