#include "tools/calibrate/calibrate.hpp"

#include <stdexcept>

#include <fmt/format.h>

#include "drivers/bumblebee/calibration/calibration_files.hpp"
#include "drivers/bumblebee/rectification.hpp"
#include "tools/calibrate/board_picture.hpp"
#include "tools/import/image_file.hpp"

namespace floornav {
namespace {

/// The pairs in which the board was found.
struct FoundBoards {
  std::vector<CornerPair> corners;
  std::vector<std::size_t> pairs;  ///< their places in the task
  cv::Size image;
};

void check_size(const cv::Mat& image, const std::filesystem::path& file, cv::Size& size) {
  if (size.empty()) size = image.size();
  if (image.size() != size)
    throw std::runtime_error(fmt::format("{}: is {} x {} px, the first one was {} x {}", file.string(),
                                         image.cols, image.rows, size.width, size.height));
}

FoundBoards find_boards(const CalibrationTask& task,
                        const std::function<void(std::int64_t, std::int64_t)>& before_each) {
  FoundBoards found;
  for (std::size_t i = 0; i < task.left.size(); ++i) {
    before_each(static_cast<std::int64_t>(i), static_cast<std::int64_t>(task.left.size()));
    const cv::Mat left = read_image(task.left[i], ImageForm::kGrey);
    const cv::Mat right = read_image(task.right[i], ImageForm::kGrey);
    check_size(left, task.left[i], found.image);
    check_size(right, task.right[i], found.image);
    CornerPair corners = find_corners(left, right, task.board);
    if (corners.left.empty()) continue;
    found.corners.push_back(std::move(corners));
    found.pairs.push_back(i);
  }
  return found;
}

void draw_pairs(const CalibrationTask& task, const FoundBoards& found, const StereoCalibration& calibration) {
  std::filesystem::create_directories(task.pictures);
  const Rectification rectification(calibration);
  for (const std::size_t pair : found.pairs)
    draw_rectified_pair(read_image(task.left[pair], ImageForm::kGrey),
                        read_image(task.right[pair], ImageForm::kGrey), rectification,
                        task.pictures / (task.left[pair].stem().string() + "_rectified.png"));
}

std::vector<std::string> report_of(const CalibrationTask& task, const FoundBoards& found,
                                   const CalibrationReport& report) {
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < found.pairs.size(); ++i)
    lines.push_back(fmt::format("{}: rms {:.3f} px, rows off by {:.3f} px",
                                task.left[found.pairs[i]].filename().string(), report.pair_rms_px[i],
                                report.pair_epipolar_px[i]));
  const StereoCalibration& c = report.calibration;
  lines.push_back(
      fmt::format("{} of {} pairs show the board; rms {:.3f} px; fx {:.2f} and {:.2f} px, baseline {:.5f} m",
                  found.pairs.size(), task.left.size(), report.rms_px, c.left.camera(0, 0),
                  c.right.camera(0, 0), cv::norm(c.t_right_left_m)));
  lines.push_back(fmt::format("{} written", task.result.string()));
  return lines;
}

}  // namespace

std::vector<std::string> calibrate_from_files(
    const CalibrationTask& task, const std::function<void(std::int64_t, std::int64_t)>& before_each) {
  if (task.left.size() != task.right.size())
    throw std::runtime_error(
        fmt::format("{} left images and {} right ones", task.left.size(), task.right.size()));
  const FoundBoards found = find_boards(task, before_each);
  const CalibrationReport report = calibrate(found.corners, found.image, task.board);
  write_stereo_calibration(report.calibration, task.result);
  if (!task.pictures.empty()) draw_pairs(task, found, report.calibration);
  return report_of(task, found, report);
}

}  // namespace floornav
