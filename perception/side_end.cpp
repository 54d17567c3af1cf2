#include "perception/side_end.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "perception/uprightness.hpp"

namespace floornav {

namespace {

constexpr double kLeastBelowSensor_m = 0.03;
constexpr float kRowsAbove = 4.0F;
constexpr float kRowsBelow = 2.0F;      ///< beyond where the end is sought
constexpr float kMostRowsDown = 40.0F;  ///< of where it is sought
constexpr std::size_t kLeastPixels = 6;
constexpr int kSteps = 40;   ///< of the search
constexpr int kStepsUp = 5;  ///< above the highest point
constexpr float kMost =
    9.0F;  ///< that a pixel costs, in its variance: what is not of this thing tells nothing
constexpr float kAlike = 1e-3F;

/// The pixels around the end.
struct Window {
  int first_column = 0, last_column = -1;
  int first_row = 0, last_row = -1;
  float row_m = 0;  ///< height on the side a row

  /// Empty where the side does not pass the cell.
  Window(const Surfel& side, const SideEnd& end, const SensorView& view) {
    const Eigen::Vector3d normal = side.normal.cast<double>();
    const Eigen::Vector2d across = normal.head<2>();
    const auto top_m = static_cast<double>(end.top_z_m);
    const double off_m = normal.dot(Eigen::Vector3d(end.middle.x(), end.middle.y(), top_m) - side.centroid_m);
    const Eigen::Vector2d way = -off_m / across.squaredNorm() * across;
    if (way.norm() > end.pitch_m) return;
    const Pose T_sensor_world = view.T_world_sensor.inverse();
    const auto pixel = [&](double along_m, double below_m) {
      const Eigen::Vector2d at =
          end.middle + way + along_m * Eigen::Vector2d(-across.y(), across.x()).normalized();
      return view.camera.project(
          (T_sensor_world * Eigen::Vector3d(at.x(), at.y(), top_m - below_m)).cast<float>());
    };
    const Eigen::Vector2f left = pixel(-0.5 * end.pitch_m, 0.0), right = pixel(0.5 * end.pitch_m, 0.0);
    const Eigen::Vector2f highest = pixel(0.0, 0.0), lowest = pixel(0.0, static_cast<double>(end.below_m));
    if (!(lowest.y() > highest.y())) return;
    row_m = end.below_m / (lowest.y() - highest.y());
    first_column = static_cast<int>(std::ceil(std::min(left.x(), right.x())));
    last_column = static_cast<int>(std::floor(std::max(left.x(), right.x())));
    first_row = static_cast<int>(std::floor(highest.y() - kRowsAbove));
    last_row = static_cast<int>(std::ceil(std::min(lowest.y(), highest.y() + kMostRowsDown) + kRowsBelow));
  }
};

void find_pixels(const Surfel& side, const Window& window, const MeasuredImage& image, const SensorView& view,
                 std::vector<EndPixel>& pixels) {
  pixels.clear();
  const Eigen::Matrix3d R = view.T_world_sensor.linear();
  const Eigen::Vector3d normal = side.normal.cast<double>();
  const double distance_m = normal.dot(side.centroid_m - view.T_world_sensor.translation());
  const Eigen::Vector3f on_side = (R.transpose() * normal / distance_m).cast<float>();
  const Eigen::Vector3f down = -R.row(2).transpose().cast<float>();
  for (int row = std::max(0, window.first_row); row <= std::min(image.height - 1, window.last_row); ++row) {
    for (int column = std::max(0, window.first_column);
         column <= std::min(image.width - 1, window.last_column); ++column) {
      const std::size_t i = image.row_begin(row) + static_cast<std::size_t>(column);
      if (!(image.inverse_depth[i] > 0.0F)) continue;
      const Eigen::Vector3f ray = view.camera.ray(static_cast<float>(column), static_cast<float>(row));
      pixels.push_back({image.inverse_depth[i], image.certainty[i], on_side.dot(ray), down.dot(ray)});
    }
  }
}

/// How badly a top explains the pixels that lies so far below the sensor.
float cost_of(const std::vector<EndPixel>& pixels, float below_sensor_m) {
  float sum = 0.0F;
  for (const EndPixel& p : pixels) {
    const float expected = std::min(p.on_side, p.down / below_sensor_m);
    const float off = (p.inverse_depth - expected) * p.certainty;
    sum += std::min(off * off, kMost);
  }
  return sum;
}

/// How far below the highest point the side ends. Where there is no top behind it, all heights from its last
/// row up explain the pixels alike: half a row more than the last one.
float find_end(const std::vector<EndPixel>& pixels, const SideEnd& end, float sensor_above_m, float row_m) {
  float least = std::numeric_limits<float>::infinity();
  float highest_m = 0.0F, lowest_m = 0.0F;
  for (int step = -kStepsUp; step <= kSteps; ++step) {
    const float below_m = end.below_m * static_cast<float>(step) / static_cast<float>(kSteps);
    const float cost = cost_of(pixels, sensor_above_m + below_m);
    if (cost >= least + kAlike) continue;
    if (cost < least - kAlike) highest_m = below_m;
    lowest_m = below_m;
    least = std::min(least, cost);
  }
  return 0.5F * (lowest_m + std::max(highest_m, lowest_m - row_m));
}

}  // namespace

std::optional<float> side_end_z_m(const Surfel& side, const SideEnd& end, const MeasuredImage& image,
                                  const SensorView& view, std::vector<EndPixel>& pixels) {
  const double sensor_above_m = view.T_world_sensor.translation().z() - static_cast<double>(end.top_z_m);
  const double search_up_m = static_cast<double>(end.below_m) * kStepsUp / kSteps;
  if (std::abs(side.normal.z()) > kSideUpright || sensor_above_m - search_up_m < kLeastBelowSensor_m)
    return std::nullopt;
  const Window window(side, end, view);
  find_pixels(side, window, image, view, pixels);
  if (pixels.size() < kLeastPixels) return std::nullopt;
  return end.top_z_m - find_end(pixels, end, static_cast<float>(sensor_above_m), window.row_m);
}

}  // namespace floornav
