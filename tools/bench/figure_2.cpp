#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "tools/bench/figures.hpp"
#include "tools/pictures/canvas.hpp"
#include "tools/simulator/depth_sensor.hpp"

namespace floornav {
namespace {

constexpr Color kInk = color(0x26292E);
constexpr Color kFaint = color(0xC9CDD3);
constexpr double kFarthest_m = 6.0;
constexpr double kMost_cm = 7.0;
constexpr double kWidth_px = 760;
constexpr double kHeight_px = 460;
const Eigen::Vector2d kCorner(70, 70);

struct Curve {
  std::string name;
  SensorSpec sensor;
  Color tint;
};

/// sigma_z = Z^2 sigma_d / (f b): eq. (3) and (4) alike, with sigma_d in pixels.
double sigma_m(const SensorSpec& sensor, double distance_m) {
  const double focal_px = static_cast<double>(sensor.camera.fx) * sensor.decimation;
  return distance_m * distance_m * sensor.noise.sigma_px / (focal_px * sensor.baseline_m);
}

/// RMS error of the depths that a sensor gives of a plane across its axis, m, over a range of distances as
/// wide as its quantum is coarse.
double measured_sigma_m(const SensorSpec& spec, double distance_m) {
  constexpr int kDistances = 16;
  DepthSensor sensor(spec, 1);
  const double focal_px = static_cast<double>(spec.camera.fx) * spec.decimation;
  const double quantum_m = distance_m * distance_m * spec.noise.quantum_px / (focal_px * spec.baseline_m);
  double sum = 0;
  double count = 0;
  std::vector<float> depth(static_cast<std::size_t>(spec.camera.width) *
                           static_cast<std::size_t>(spec.camera.height));
  for (int i = 0; i < kDistances; ++i) {
    const double exact_m = distance_m + ((i + 0.5) / kDistances - 0.5) * quantum_m;
    std::fill(depth.begin(), depth.end(), static_cast<float>(exact_m));
    for (const std::uint16_t pixel : sensor.measure(depth, i)) {
      if (pixel == 0) continue;
      const double units = pixel * sensor.unit();
      const double found_m =
          spec.kind == SensorKind::kKinect ? units : focal_px * spec.baseline_m / (units * spec.decimation);
      sum += (found_m - exact_m) * (found_m - exact_m);
      ++count;
    }
  }
  return count > 0 ? std::sqrt(sum / count) : 0.0;
}

Eigen::Vector2d at(double distance_m, double error_cm) {
  return kCorner +
         Eigen::Vector2d(distance_m / kFarthest_m * kWidth_px, (1.0 - error_cm / kMost_cm) * kHeight_px);
}

void draw_frame(Canvas& canvas) {
  canvas.text({kCorner.x(), 28}, "Figure 2: error of depth against distance", 17, kInk, Align::kLeft, true);
  canvas.text({kCorner.x(), 49}, "lines: eq. (3) and (4); discs: RMS of what the simulated sensors give", 13,
              kInk);
  for (int m = 0; m <= static_cast<int>(kFarthest_m); ++m) {
    canvas.line(std::array{at(m, 0), at(m, kMost_cm)}, {kFaint, 1});
    canvas.text(at(m, 0) + Eigen::Vector2d(0, 20), fmt::format("{}", m), 13, kInk, Align::kCenter);
  }
  for (int cm = 0; cm <= static_cast<int>(kMost_cm); ++cm) {
    canvas.line(std::array{at(0, cm), at(kFarthest_m, cm)}, {kFaint, 1});
    canvas.text(at(0, cm) + Eigen::Vector2d(-10, 5), fmt::format("{}", cm), 13, kInk, Align::kRight);
  }
  canvas.text(at(kFarthest_m / 2, 0) + Eigen::Vector2d(0, 42), "distance, m", 13, kInk, Align::kCenter);
  canvas.text({kCorner.x() - 50, kCorner.y() - 8}, "cm", 13, kInk);
}

void draw(Canvas& canvas, const Curve& curve, int place) {
  std::vector<Eigen::Vector2d> line;
  for (double z = 0.5; z <= kFarthest_m && 100 * sigma_m(curve.sensor, z) <= kMost_cm; z += 0.05)
    line.push_back(at(z, 100 * sigma_m(curve.sensor, z)));
  canvas.line(line, {curve.tint, 2});
  for (double z = 1.0; z <= kFarthest_m; z += 0.5) {
    const double error_cm = 100 * measured_sigma_m(curve.sensor, z);
    if (error_cm <= kMost_cm) canvas.disc(at(z, error_cm), 4, curve.tint);
  }
  const Eigen::Vector2d key = kCorner + Eigen::Vector2d(24, 30 + 24.0 * place);
  canvas.line(std::array{key, Eigen::Vector2d(key + Eigen::Vector2d(32, 0))}, {curve.tint, 2});
  canvas.text(key + Eigen::Vector2d(42, 5), curve.name, 13, kInk);
}

}  // namespace

std::vector<std::filesystem::path> draw_figure_2(const std::filesystem::path& folder) {
  Canvas canvas(static_cast<int>(kCorner.x() + kWidth_px) + 40,
                static_cast<int>(kCorner.y() + kHeight_px) + 60, color(0xFFFFFF));
  draw_frame(canvas);
  const std::array<Curve, 3> curves{
      {{"Kinect, eq. (3)", kinect(160), color(0xD81E5B)},
       {"Bumblebee 640 x 480, eq. (4)", bumblebee(640, 160), color(0xC77700)},
       {"Bumblebee 1280 x 960, eq. (4)", bumblebee(1280, 160), color(0x1668D8)}}};
  for (std::size_t i = 0; i < curves.size(); ++i) draw(canvas, curves[i], static_cast<int>(i));
  const std::filesystem::path file = folder / "figure2.png";
  canvas.write_png(file);
  return {file};
}

}  // namespace floornav
