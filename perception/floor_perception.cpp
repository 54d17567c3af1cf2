#include "perception/floor_perception.hpp"

#include <algorithm>
#include <atomic>
#include <limits>
#include <mutex>
#include <stdexcept>

namespace floornav {

namespace {

PerceptionSettings checked(const PerceptionSettings& settings) {
  const RoiSettings& roi = settings.roi;
  if (!(roi.x_min_m < roi.x_max_m && roi.y_min_m < roi.y_max_m && roi.z_min_m < roi.z_max_m))
    throw std::invalid_argument("roi: each minimum must be less than its maximum");
  const int planes = settings.sections.x_res * settings.sections.y_res * (settings.planes.max_planes + 1);
  if (planes > std::numeric_limits<std::int16_t>::max())
    throw std::invalid_argument("sections and planes.max_planes allow more than 32767 planes a frame");
  return settings;
}

}  // namespace

struct FloorPerception::Passage {
  const DepthFrame& frame;
  const SensorView& view;
  Parallel& parallel;
  const Admission& admit;
  const StageEnd& end_stage;
  const NearRowEnd& end_near_row;
};

FloorPerception::FloorPerception(const PerceptionSettings& settings, const RobotSettings& robot)
    : settings_(checked(settings)),
      grid_(settings.roi, settings.sections),
      order_(grid_),
      clipper_(settings.roi, grid_),
      search_(settings, robot, grid_.count()),
      cells_(settings, robot, grid_),
      ages_(static_cast<std::size_t>(grid_.count()), 0) {}

void FloorPerception::set_compromise(const Compromise& compromise) {
  compromise_ = compromise;
  search_.set_planes(compromise.applied_to(settings_.planes));
}

const FloorEvidence& FloorPerception::process(const DepthFrame& whole_frame, const Pose& T_world_body,
                                              Parallel& parallel, const Admission& admit,
                                              const StageEnd& end_stage, const NearRowEnd& end_near_row) {
  const DepthFrame frame = thinned_.thin(whole_frame, compromise_.point_stride);
  const SensorView view(frame, T_world_body);
  const Passage passage{frame, view, parallel, admit, end_stage, end_near_row};
  begin(passage);
  search(passage);
  collect(grid_.y_res(), grid_.count(), passage);
  for (const SectionResult& result : search_.results()) evidence_.pixels.outliers += result.outliers;
  search_.remember(view);
  count_ages();
  report_sections(false);
  return evidence_;
}

/// Makes the nearest row's points; empties what the frame before has left.
void FloorPerception::begin(const Passage& passage) {
  const auto& [frame, view, parallel, admit, end_stage, end_near_row] = passage;
  evidence_.utime_us = frame.utime_us;
  evidence_.T_world_body = view.T_world_body;
  evidence_.T_body_sensor = frame.T_body_sensor;
  evidence_.lattice.pitch_m = settings_.cells.pitch_m;
  evidence_.compromise = compromise_;
  evidence_.surfels.clear();
  evidence_.cells.clear();
  evidence_.pixels = clipper_.clip(frame, view, parallel, cloud_);
  clipper_.fill(0, grid_.y_res(), parallel, cloud_);
  search_.begin(cloud_, frame.utime_us, parallel.workers());
  end_stage(PerceptionStage::kRoi);
  cells_.begin(clipper_.image(), cloud_, view, parallel);
  end_stage(PerceptionStage::kCells);
}

/// From the points to the cells.
std::int64_t FloorPerception::work_of(int section) const {
  const int density = compromise_.point_stride * compromise_.point_stride;
  return static_cast<std::int64_t>(compromise_.work_per_point_ns() * density) * cloud_.section_size(section);
}

std::int64_t FloorPerception::work_of_near_row(const DepthFrame& frame) const {
  auto work_ns = static_cast<std::int64_t>(kWorkPerPixel_ns * static_cast<double>(frame.pixels.size()));
  for (int section = 0; section < grid_.y_res(); ++section) work_ns += work_of(section);
  return work_ns;
}

/// The nearest row first, in it the largest section first, so that the workers end together.
void FloorPerception::order_sections(const SensorView& view) {
  turns_.clear();
  for (int section = 0; section < grid_.y_res(); ++section) turns_.push_back(section);
  std::sort(turns_.begin(), turns_.end(), [this](int a, int b) {
    const std::int32_t size_a = cloud_.section_size(a), size_b = cloud_.section_size(b);
    return size_a != size_b ? size_a > size_b : a < b;
  });
  const auto others = order_.order(ages_, view.T_world_body);
  turns_.insert(turns_.end(), others.begin(), others.end());
}

/// Outliers and planes of one section after the other, by all workers; whoever ends the last one of the
/// nearest row makes its evidence.
void FloorPerception::search(const Passage& passage) {
  order_sections(passage.view);
  passage.admit(work_of_near_row(passage.frame));
  std::mutex mutex;
  auto turn = turns_.begin();
  const auto next_section = [&]() -> int {
    const std::lock_guard lock(mutex);
    if (turn - turns_.begin() == grid_.y_res()) fill_others(passage);
    while (turn != turns_.end()) {
      const int section = *turn++;
      if (section < grid_.y_res() || passage.admit(work_of(section))) return section;
    }
    return -1;
  };
  std::atomic<int> near_left = grid_.y_res();
  const auto search_one = [&](int, int worker) {
    const int section = next_section();
    if (section < 0) return;
    search_.search(section, cloud_, passage.view, worker, passage.parallel, passage.end_stage);
    if (section < grid_.y_res() && --near_left == 0) finish_near_row(passage);
  };
  passage.parallel.run(grid_.count(), std::ref(search_one));
}

/// Makes the points beyond the nearest row.
void FloorPerception::fill_others(const Passage& passage) {
  clipper_.fill(grid_.y_res(), grid_.count(), passage.parallel, cloud_);
  if (passage.parallel.workers() == 1) passage.end_stage(PerceptionStage::kRoi);
}

void FloorPerception::finish_near_row(const Passage& passage) {
  collect(0, grid_.y_res(), passage);
  report_sections(true);
  passage.end_near_row(evidence_);
}

/// Makes evidence of the sections [first, end), which were searched.
void FloorPerception::collect(int first_section, int end_section, const Passage& passage) {
  search_.settle(first_section, end_section, cloud_, passage.view, passage.parallel, evidence_.surfels);
  cells_.add(first_section, end_section, clipper_.image(), cloud_, passage.view, search_.results(),
             search_.label(), passage.parallel, evidence_);
  if (passage.parallel.workers() == 1 || end_section == grid_.count())
    passage.end_stage(PerceptionStage::kCells);
}

void FloorPerception::count_ages() {
  for (std::size_t s = 0; s < ages_.size(); ++s)
    ages_[s] = search_.results()[s].done ? std::int16_t{0}
                                         : static_cast<std::int16_t>(std::min<int>(ages_[s] + 1, INT16_MAX));
}

void FloorPerception::report_sections(bool near_row_only) {
  evidence_.sections.clear();
  for (int section = 0; section < grid_.count(); ++section) {
    const auto s = static_cast<std::size_t>(section);
    const bool is_later = near_row_only && section >= grid_.y_res();
    const bool is_done = !is_later && search_.results()[s].done;
    const std::int16_t age = near_row_only && !is_later ? std::int16_t{0} : ages_[s];
    evidence_.sections.push_back({static_cast<std::int16_t>(grid_.row_of(section)),
                                  static_cast<std::int16_t>(section % grid_.y_res()), is_done, age,
                                  cloud_.section_size(section), is_later});
  }
}

}  // namespace floornav
