#include "tools/bench/steps.hpp"

#include <array>
#include <mutex>
#include <stdexcept>

#include "tools/bench/slow_drive.hpp"
#include "tools/bench/step_check.hpp"
#include "tools/simulator/random.hpp"

namespace floornav {
namespace {

constexpr std::array<double, 4> kHeights_m{0.01, 0.02, 0.03, 0.05};
constexpr std::uint64_t kPlainAtOnce = 4;  ///< whatever the number of threads

/// One of the noises, and how many frames the map has seen.
struct View {
  bool correlated = false;
  bool single_frame = true;
};
constexpr std::array<View, 4> kViews{{{false, true}, {false, false}, {true, true}, {true, false}}};

std::size_t number_of(const View& view) {
  return (view.correlated ? 2U : 0U) + (view.single_frame ? 0U : 1U);
}

template <class Result>
using OfViews = std::array<Result, kViews.size()>;

/// Drives slowly up to where the course has the robot; calls judge(map) for each view and returns the
/// answers.
template <class Judge>
auto drive_up(const StepCourse& course, SensorKind kind, std::uint64_t key, const Judge& judge) {
  const auto observers = drive_up_to(course.shapes, course.T_world_body, kind, key, MappingSettings{});
  OfViews<decltype(judge(observers[0].map(true)))> answers;
  for (const View& view : kViews)
    answers[number_of(view)] = judge(observers[view.correlated ? 1 : 0].map(view.single_frame));
  return answers;
}

/// Which of a course's edges a map shows.
using Found = std::array<bool, kStepDistances_m.size()>;

OfViews<Found> edges_found(SensorKind kind, double height_m, std::uint64_t key) {
  const StepCourse course = step_course(height_m, key);
  return drive_up(course, kind, key, [&](const GridMap& map) {
    Found found{};
    for (std::size_t i = 0; i < found.size(); ++i) found[i] = shows_step(map, course.edges[i]);
    return found;
  });
}

OfViews<PlainCheck> alarms_raised(SensorKind kind, std::uint64_t key) {
  const StepCourse course = plain_course(key);
  const auto checks =
      drive_up(course, kind, key, [&](const GridMap& map) { return check_plain(map, course.shapes.ground); });
  for (const PlainCheck& check : checks)
    if (check.places == 0) throw std::runtime_error("nothing was seen of a plain floor");
  return checks;
}

/// Drives of one sensor.
class StepTrials {
 public:
  StepTrials(SensorKind kind, const StepOptions& options, Parallel& parallel)
      : kind_(kind), options_(options), parallel_(parallel) {}

  [[nodiscard]] int step_drives() const { return static_cast<int>(kHeights_m.size()) * options_.poses; }

  /// Calls tell_done() after each drive.
  void run(const std::function<void()>& tell_done) {
    found_.resize(static_cast<std::size_t>(step_drives()));
    parallel_.run(step_drives(), [&](int number, int) {
      const auto n = static_cast<std::size_t>(number);
      const std::size_t pose = n / kHeights_m.size();
      found_[n] =
          edges_found(kind_, kHeights_m[n % kHeights_m.size()], random_key({options_.seed, pose, 0x57E9}));
      tell_done();
    });
    while (plain_[number_of({})].seen_m2() < options_.plain_m2) see_more_plain();
  }

  void add_rows(const View& view, std::vector<StepRow>& rows) const {
    const std::size_t v = number_of(view);
    const double alarms = plain_[v].alarms / plain_[v].seen_m2();
    for (std::size_t h = 0; h < kHeights_m.size(); ++h) {
      for (std::size_t d = 0; d < kStepDistances_m.size(); ++d) {
        int found = 0;
        for (std::size_t n = h; n < found_.size(); n += kHeights_m.size()) found += found_[n][v][d] ? 1 : 0;
        rows.push_back({kind_, view.correlated, kHeights_m[h], kStepDistances_m[d],
                        view.single_frame ? 1 : DriveObserver::kFrames, options_.poses, found, alarms});
      }
    }
  }

 private:
  void see_more_plain() {
    std::array<OfViews<PlainCheck>, kPlainAtOnce> some;
    parallel_.run(static_cast<int>(kPlainAtOnce), [&](int index, int) {
      const auto i = static_cast<std::size_t>(index);
      some[i] = alarms_raised(kind_, random_key({options_.seed, plain_drives_ + i}));
    });
    plain_drives_ += kPlainAtOnce;
    for (const auto& checks : some) {
      for (std::size_t v = 0; v < checks.size(); ++v) {
        plain_[v].places += checks[v].places;
        plain_[v].alarms += checks[v].alarms;
      }
    }
  }

  SensorKind kind_;
  const StepOptions& options_;
  Parallel& parallel_;
  std::vector<OfViews<Found>> found_;  ///< a drive; the heights of a pose follow each other
  OfViews<PlainCheck> plain_{};
  std::uint64_t plain_drives_ = 0;
};

}  // namespace

std::vector<StepRow> measure_steps(const StepOptions& options, Parallel& parallel,
                                   const std::function<void(int, int)>& tell_done) {
  std::vector<StepRow> rows;
  std::mutex mutex;
  int done = 0;
  for (const SensorKind kind : options.sensors) {
    StepTrials trials(kind, options, parallel);
    const int all = static_cast<int>(options.sensors.size()) * trials.step_drives();
    trials.run([&] {
      const std::scoped_lock lock(mutex);
      tell_done(++done, all);
    });
    for (const View& view : kViews) trials.add_rows(view, rows);
  }
  return rows;
}

}  // namespace floornav
