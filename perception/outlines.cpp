#include "perception/outlines.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

#include "perception/row_bands.hpp"
#include "perception/step_kernel.hpp"

namespace floornav {

namespace {

/// What is rough is not hidden by itself.
constexpr LeastStep kNearer{.sigmas = 3.3F, .depth_m = 0.04F};
constexpr std::int32_t kMostBetween = 40;  // pixels without a measurement
constexpr std::int32_t kGoesOn_px = 2;     // from one row or column to the next; noise does not go on
constexpr std::int32_t kNowhere = -1000;
constexpr float kNoLedge = std::numeric_limits<float>::infinity();

/// By how much the second of two pixels is nearer (below 0: farther) than both the first and a floor through
/// it would be; 0 where it lies between the two, as a side does.
float nearer_by(float first, float second, float floor_growth) {
  const float difference = second - first;
  const float nearer = difference - std::max(floor_growth, 0.0F);
  const float farther = difference - std::min(floor_growth, 0.0F);
  return nearer > 0.0F ? nearer : std::min(farther, 0.0F);
}

/// Whether an outline that was met in the row before goes on in this one.
bool goes_on_above(const std::vector<std::int32_t>& outline_row, std::int32_t column, std::int32_t row) {
  const auto last = std::min(column + kGoesOn_px, static_cast<std::int32_t>(outline_row.size()) - 1);
  for (std::int32_t c = std::max(0, column - kGoesOn_px); c <= last; ++c)
    if (outline_row[static_cast<std::size_t>(c)] == row - 1) return true;
  return false;
}

struct Pixel {
  std::int32_t column, row;
  float inverse_depth;  ///< 1/m
};

/// How far before `place` the last pixel lies that measured something, 0: too far for an outline. `stride`:
/// between neighbours in memory.
std::int32_t way_back(const float* depths, std::int32_t place, std::size_t stride) {
  for (std::int32_t back = 1; back <= std::min(place, kMostBetween); ++back)
    if (depths[static_cast<std::size_t>(place - back) * stride] > 0.0F) return back;
  return 0;
}

/// Two pixels between which an outline goes.
struct OutlinePixels {
  Pixel near, far;
};

inline std::optional<OutlinePixels> outline_between(const Pixel& first, const Pixel& second,
                                                    float floor_growth, float clearly) {
  const float nearer = nearer_by(first.inverse_depth, second.inverse_depth, floor_growth);
  if (nearer > clearly) return OutlinePixels{second, first};
  if (-nearer > clearly) return OutlinePixels{first, second};
  return std::nullopt;
}

}  // namespace

/// A frame: where its rays end, and how a level floor's inverse depth grows from pixel to pixel.
struct OutlineFinder::Sight {
  const MeasuredImage& image;
  const SensorView& view;
  const CellWindow& window;
  float least_drop_m;
  Eigen::Matrix3f R_world_sensor;
  Eigen::Vector3d sensor_m;
  float per_column, per_row;  ///< 1/m

  Sight(const MeasuredImage& of_image, const SensorView& from, const CellWindow& of_cells, float drop_m)
      : image(of_image),
        view(from),
        window(of_cells),
        least_drop_m(drop_m),
        R_world_sensor(from.T_world_sensor.linear().cast<float>()),
        sensor_m(from.T_world_sensor.translation()) {
    const Pose T_sensor_body = view.T_body_sensor.inverse();
    const Eigen::Vector3f up = T_sensor_body.linear().col(2).cast<float>();
    const float height_m = -up.dot(T_sensor_body.translation().cast<float>());
    const float per_ray = height_m > 0.1F ? -1.0F / height_m : 0.0F;
    per_column = per_ray * up.x() / view.camera.fx;
    per_row = per_ray * up.y() / view.camera.fy;
  }

  /// An outline between a pixel and the last one before it in its row, or above it in its column.
  [[nodiscard]] std::optional<OutlinePixels> before(const Pixel& here, float clearly) const {
    const float* const depths = image.inverse_depth.data() + image.row_begin(here.row);
    const std::int32_t back = way_back(depths, here.column, 1);
    if (back == 0) return std::nullopt;
    return outline_between({here.column - back, here.row, depths[here.column - back]}, here,
                           per_column * static_cast<float>(back), clearly);
  }
  [[nodiscard]] std::optional<OutlinePixels> above(const Pixel& here, float clearly) const {
    const float* const depths = image.inverse_depth.data() + here.column;
    const std::int32_t back = way_back(depths, here.row, image.stride);
    if (back == 0) return std::nullopt;
    const float inverse_depth = depths[image.row_begin(here.row - back)];
    return outline_between({here.column, here.row - back, inverse_depth}, here,
                           per_row * static_cast<float>(back), clearly);
  }

  /// Takes down the cells on both sides of an outline.
  void mark(const OutlinePixels& outline, float certainty, Outlines& found) const {
    const Eigen::Vector3f far = way_to(outline.far);
    if (const std::int32_t cell = cell_at(far); cell >= 0) found.hidden[static_cast<std::size_t>(cell)] = 1;
    const Eigen::Vector3f near = way_to(outline.near);
    const float noise_m = kNearer.sigmas / (certainty * outline.far.inverse_depth) * std::abs(far.z());
    if (near.z() - far.z() < least_drop_m + noise_m) return;
    if (const std::int32_t cell = cell_at(near); cell >= 0) {
      float& ledge_z_m = found.ledge_z_m[static_cast<std::size_t>(cell)];
      ledge_z_m = std::min(ledge_z_m, static_cast<float>(sensor_m.z()) + near.z());
    }
  }

 private:
  [[nodiscard]] Eigen::Vector3f way_to(const Pixel& pixel) const {
    const Eigen::Vector3f ray =
        view.camera.ray(static_cast<float>(pixel.column), static_cast<float>(pixel.row));
    return R_world_sensor * ray / pixel.inverse_depth;
  }
  [[nodiscard]] std::int32_t cell_at(const Eigen::Vector3f& way) const {
    return window.at(sensor_m.x() + static_cast<double>(way.x()),
                     sensor_m.y() + static_cast<double>(way.y()));
  }
};

void OutlineFinder::find(const MeasuredImage& image, const SensorView& view, const CellWindow& window,
                         Parallel& parallel, Outlines& outlines) {
  const Sight sight(image, view, window, least_drop_m_);
  const auto cells = static_cast<std::size_t>(window.count());
  const auto clear = [cells](Outlines& all) {
    all.hidden.assign(cells, 0);
    all.ledge_z_m.assign(cells, kNoLedge);
  };
  workers_.resize(static_cast<std::size_t>(parallel.workers()));
  for (Worker& worker : workers_) clear(worker.found);
  const RowBands rows{image.height};
  const auto look = [&](int band, int worker) {
    look_at_rows(sight, rows.first(band), rows.end(band), workers_[static_cast<std::size_t>(worker)]);
  };
  parallel.run(rows.count(), std::ref(look));
  clear(outlines);
  for (const Worker& worker : workers_) {
    for (std::size_t cell = 0; cell < cells; ++cell) outlines.hidden[cell] |= worker.found.hidden[cell];
    for (std::size_t cell = 0; cell < cells; ++cell)
      outlines.ledge_z_m[cell] = std::min(outlines.ledge_z_m[cell], worker.found.ledge_z_m[cell]);
  }
}

void OutlineFinder::look_at_rows(const Sight& sight, int first_row, int end_row, Worker& worker) {
  worker.outline_row.assign(static_cast<std::size_t>(sight.image.width), kNowhere);
  worker.steps.resize(sight.image.stride);
  for (int row = first_row; row < end_row; ++row) look_at_row(sight, row, worker);
}

/// Outlines go only where a pixel differs from its neighbours, and those are few.
void OutlineFinder::look_at_row(const Sight& sight, int row, Worker& worker) {
  const MeasuredImage& image = sight.image;
  const float* const depths = image.inverse_depth.data() + image.row_begin(row);
  const float* const certainties = image.certainty.data() + image.row_begin(row);
  const auto steps = static_cast<std::size_t>(find_steps(image, row, kNearer, worker.steps.data()));
  std::int32_t outline_column = kNowhere;
  for (std::size_t k = 0; k < steps; ++k) {
    const std::int32_t column = worker.steps[k];
    const Pixel here{column, row, depths[column]};
    const float certainty = certainties[column];
    const float clearly =
        std::max(kNearer.sigmas / certainty, kNearer.depth_m * here.inverse_depth * here.inverse_depth);
    if (const auto outline = sight.before(here, clearly)) {
      if (goes_on_above(worker.outline_row, outline->far.column, row))
        sight.mark(*outline, certainty, worker.found);
      worker.outline_row[static_cast<std::size_t>(outline->far.column)] = row;
    }
    if (const auto outline = sight.above(here, clearly)) {
      if (column - outline_column <= kGoesOn_px) sight.mark(*outline, certainty, worker.found);
      outline_column = column;
    }
  }
}

}  // namespace floornav
