#include "perception/side_end.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "perception/uprightness.hpp"

namespace floornav {

namespace {

constexpr double kLeastBelowSensor_m = 0.03;
constexpr float kRowsAbove = 4.0F;
constexpr float kRowsBelow = 2.0F;      ///< beyond where the end is sought
constexpr float kMostRowsDown = 40.0F;  ///< of where it is sought
constexpr std::size_t kLeastPixels = 6;
constexpr std::size_t kSteps = 30;  ///< of the search
constexpr float kMost =
    9.0F;  ///< that a pixel costs, in its variance: what is not of this thing tells nothing
constexpr float kMostBehind = 4.0F;

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

/// How badly a top explains the pixels that lies so far below the sensor. A ray that passes over the edge may
/// go on behind a top that falls away or soon ends: farther off is no surprise there.
float cost_of(const std::vector<EndPixel>& pixels, float below_sensor_m) {
  const float per_below = 1.0F / below_sensor_m;
  float sum = 0.0F;
  for (const EndPixel& p : pixels) {
    const float on_top = p.down * per_below;
    const float off = (p.inverse_depth - std::min(p.on_side, on_top)) * p.certainty;
    sum += std::min(off * off, on_top < p.on_side && off < 0.0F ? kMostBehind : kMost);
  }
  return sum;
}

/// How far below the highest point the side ends: the mean of all ends that may be, each as likely as its
/// cost says.
float find_end(const std::vector<EndPixel>& pixels, const SideEnd& end, float sensor_above_m, float up_m) {
  std::array<float, kSteps + 1> costs;
  const float step_m = (end.below_m + up_m) / kSteps;
  for (std::size_t i = 0; i < costs.size(); ++i)
    costs[i] = cost_of(pixels, sensor_above_m - up_m + static_cast<float>(i) * step_m);
  const float least = *std::min_element(costs.begin(), costs.end());
  float weights = 0.0F, sum = 0.0F;
  for (std::size_t i = 0; i < costs.size(); ++i) {
    const float weight = std::exp(-0.5F * (costs[i] - least));
    weights += weight;
    sum += weight * static_cast<float>(i);
  }
  return sum / weights * step_m - up_m;
}

}  // namespace

std::optional<float> side_end_z_m(const Surfel& side, const SideEnd& end, const MeasuredImage& image,
                                  const SensorView& view, std::vector<EndPixel>& pixels) {
  const double sensor_above_m = view.T_world_sensor.translation().z() - static_cast<double>(end.top_z_m);
  if (std::abs(side.normal.z()) > kSideUpright) return std::nullopt;
  const Window window(side, end, view);
  const float up_m = std::max(window.row_m, end.below_m / 8.0F);
  if (sensor_above_m - static_cast<double>(up_m) < kLeastBelowSensor_m) return std::nullopt;
  find_pixels(side, window, image, view, pixels);
  if (pixels.size() < kLeastPixels) return std::nullopt;
  return end.top_z_m - find_end(pixels, end, static_cast<float>(sensor_above_m), up_m);
}

}  // namespace floornav
