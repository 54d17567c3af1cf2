#include "perception/compromise.hpp"

#include <algorithm>
#include <array>

namespace floornav {

namespace {

/// A level is left for a better one only where that would leave this share of the time free, so that the
/// level does not change with every frame.
constexpr double kRoom = 0.8;
constexpr int kLeastHypotheses = 10;

/// Of one point, level by level, as measured with `floornav-bench perception --level`.
constexpr std::array<double, Compromise::kLevels> kWork_ns{111.0, 106.0, 105.0, 104.0, 27.0, 6.5};

}  // namespace

Compromise Compromise::at(int level) {
  Compromise compromise;
  compromise.level = std::clamp(level, 0, kLevels - 1);
  if (level >= 1) compromise.hypotheses_divisor = 4;
  if (level >= 2) compromise.max_planes = 4;
  if (level >= 3) compromise.patch_factor = 4;
  if (level >= 4) compromise.point_stride = level == 4 ? 2 : 4;
  return compromise;
}

PlaneSettings Compromise::applied_to(const PlaneSettings& settings) const {
  PlaneSettings applied = settings;
  const int fewer = std::max(settings.max_hypotheses / hypotheses_divisor, kLeastHypotheses);
  applied.max_hypotheses = std::min(settings.max_hypotheses, fewer);
  // A patch as large as the one wanted shows fewer points where they are thinned out.
  applied.min_points = std::max(settings.min_points * patch_factor / (point_stride * point_stride), 3);
  if (max_planes > 0) applied.max_planes = std::min(settings.max_planes, max_planes);
  return applied;
}

double Compromise::work_per_point_ns() const {
  return kWork_ns[static_cast<std::size_t>(level)];
}

std::string Compromise::text() const {
  std::string text;
  const auto add = [&text](const std::string& what) { text += (text.empty() ? "" : ", ") + what; };
  if (hypotheses_divisor > 1) add("1/" + std::to_string(hypotheses_divisor) + " of the hypotheses");
  if (max_planes > 0) add("at most " + std::to_string(max_planes) + " planes a section");
  if (patch_factor > 1) add("patches " + std::to_string(patch_factor) + " times as large");
  if (point_stride > 1)
    add("every " + std::to_string(point_stride) + (point_stride == 2 ? "nd" : "th") + " pixel each way");
  return text;
}

Compromise CompromiseControl::choose(std::int64_t budget_ns, std::int64_t points, std::int64_t pixels) {
  const auto fits = [&](int level, double share) {
    const double work = Compromise::at(level).work_per_point_ns() * static_cast<double>(points) +
                        kWorkPerPixel_ns * static_cast<double>(pixels);
    return work <= share * static_cast<double>(budget_ns);
  };
  while (level_ > 0 && fits(level_ - 1, kRoom)) --level_;
  while (level_ + 1 < Compromise::kLevels && !fits(level_, 1.0)) ++level_;
  return Compromise::at(level_);
}

}  // namespace floornav
