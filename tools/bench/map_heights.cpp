#include "tools/bench/map_heights.hpp"

#include <vector>

#include "tools/bench/slow_drive.hpp"
#include "tools/simulator/random.hpp"

namespace floornav {
namespace {

constexpr double kVertex_m = 0.1;  // Table 1's

std::array<HeightGain, 2> see_course(const HeightGainOptions& options, std::uint64_t key) {
  const ObstacleCourse course =
      random_course(bench_sensor(options.sensor, false), covered_area(options.sensor), key);
  MappingSettings mapping;
  mapping.resolution_m = kVertex_m;
  const auto observers = drive_up_to(course.shapes, course.T_world_body, options.sensor, key, mapping);
  std::array<HeightGain, 2> gains;
  for (std::size_t noise = 0; noise < gains.size(); ++noise) {
    judge(course, observers[noise].map(true), gains[noise].one_frame);
    judge(course, observers[noise].map(false), gains[noise].ten_frames);
  }
  return gains;
}

}  // namespace

std::array<HeightGain, 2> measure_height_gain(const HeightGainOptions& options, Parallel& parallel) {
  std::vector<std::array<HeightGain, 2>> courses(static_cast<std::size_t>(options.configurations));
  parallel.run(options.configurations, [&](int number, int) {
    const auto n = static_cast<std::size_t>(number);
    courses[n] = see_course(options, random_key({options.seed, n}));
  });
  std::array<HeightGain, 2> sum;
  for (const auto& gains : courses) {
    for (std::size_t noise = 0; noise < gains.size(); ++noise) {
      sum[noise].one_frame.add(gains[noise].one_frame);
      sum[noise].ten_frames.add(gains[noise].ten_frames);
    }
  }
  return sum;
}

}  // namespace floornav
