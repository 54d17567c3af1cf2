#include "tools/pictures/top_view.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace floornav {

namespace {

constexpr double kLeft_px = 66;
constexpr double kTitleLeft_px = 20;
constexpr double kTop_px = 64;
constexpr double kBottom_px = 58;
constexpr double kMost_px_per_m = 160;
constexpr double kLeastHeight_px = 300;  // room for the key
constexpr Color kInk = color(0x26292E);
constexpr Color kFaint = color(0x70757D);

double pixels_per_m(const TopViewLayout& layout) {
  const double longest_m = layout.shown_m.sizes().maxCoeff();
  const double wanted = std::min(layout.longest_px / longest_m, kMost_px_per_m);
  const double cell_px = std::floor(wanted * layout.resolution_m);
  return cell_px >= 1 ? cell_px / layout.resolution_m : wanted;
}

Eigen::Vector2d whole(const Eigen::Vector2d& v) {
  return v.array().ceil();
}

}  // namespace

double round_step(double least) {
  const double decade = std::pow(10, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * decade >= least * (1 - 1e-9)) return factor * decade;
  return 10 * decade;
}

std::string label(double value, double step) {
  const int decimals = std::max(0, static_cast<int>(-std::floor(std::log10(step) + 1e-9)));
  return fmt::format("{:.{}f}", std::abs(value) < step / 2 ? 0.0 : value, decimals);
}

TopView::TopView(const TopViewLayout& layout)
    : shown_m_(layout.shown_m),
      pixels_per_m_(floornav::pixels_per_m(layout)),
      corner_(layout.left_room_px + kLeft_px, kTop_px),
      size_(whole(pixels_per_m_ * layout.shown_m.sizes())),
      canvas_(static_cast<int>(corner_.x() + size_.x() + layout.key_width_px),
              static_cast<int>(kTop_px + std::max(size_.y(), kLeastHeight_px) + kBottom_px),
              color(0xFFFFFF)) {
  const double left = layout.left_room_px > 0 ? kTitleLeft_px : kLeft_px;
  canvas_.text({left, 28}, layout.title, 17, kInk, Align::kLeft, true);
  canvas_.text({left, 49}, layout.subtitle, 13, kFaint);
}

Eigen::Vector2d TopView::at(double x_m, double y_m) const {
  return {corner_.x() + (x_m - shown_m_.min().x()) * pixels_per_m_,
          corner_.y() + size_.y() - (y_m - shown_m_.min().y()) * pixels_per_m_};
}

void TopView::paint(const CellRectangle& cells, std::span<const std::uint32_t> colors) {
  std::vector<std::uint32_t> top_first(colors.size());
  const auto width = static_cast<std::size_t>(cells.width);
  for (std::size_t row = 0; row < static_cast<std::size_t>(cells.height); ++row)
    std::ranges::copy(colors.subspan(row * width, width),
                      top_first.end() - static_cast<std::ptrdiff_t>((row + 1) * width));
  canvas_.clip(corner_, size_);
  canvas_.image(std::move(top_first), cells.width, cells.height, at(cells.x_min_m(), cells.y_max_m()),
                pixels_per_m_ * cells.resolution_m * Eigen::Vector2d(cells.width, cells.height));
  canvas_.unclip();
}

void TopView::line(std::span<const Eigen::Vector2d> places_m, const Stroke& stroke, double gap_m) {
  canvas_.clip(corner_, size_);
  std::vector<Eigen::Vector2d> piece;
  for (std::size_t i = 0; i < places_m.size(); ++i) {
    if (i > 0 && (places_m[i] - places_m[i - 1]).norm() > gap_m) {
      canvas_.line(piece, stroke);
      piece.clear();
    }
    piece.push_back(at(places_m[i]));
  }
  canvas_.line(piece, stroke);
  canvas_.unclip();
}

void TopView::ticks_along_x(double step_m) {
  const double bottom = corner_.y() + size_.y();
  for (double x = std::ceil(shown_m_.min().x() / step_m) * step_m; x <= shown_m_.max().x(); x += step_m) {
    const double px = std::round(at(x, 0).x()) + 0.5;
    canvas_.line(std::array{Eigen::Vector2d(px, corner_.y()), Eigen::Vector2d(px, bottom)}, {kInk, 1, 0.10});
    canvas_.line(std::array{Eigen::Vector2d(px, bottom), Eigen::Vector2d(px, bottom + 5)}, {kInk, 1});
    canvas_.text({px, bottom + 20}, label(x, step_m), 12, kInk, Align::kCenter);
  }
  canvas_.text({corner_.x() + size_.x() / 2, bottom + 42}, "x, m", 12, kFaint, Align::kCenter);
}

void TopView::ticks_along_y(double step_m) {
  for (double y = std::ceil(shown_m_.min().y() / step_m) * step_m; y <= shown_m_.max().y(); y += step_m) {
    const double py = std::round(at(0, y).y()) + 0.5;
    canvas_.line(std::array{Eigen::Vector2d(corner_.x(), py), Eigen::Vector2d(corner_.x() + size_.x(), py)},
                 {kInk, 1, 0.10});
    canvas_.line(std::array{Eigen::Vector2d(corner_.x() - 5, py), Eigen::Vector2d(corner_.x(), py)},
                 {kInk, 1});
    canvas_.text({corner_.x() - 9, py + 4}, label(y, step_m), 12, kInk, Align::kRight);
  }
  canvas_.text({corner_.x() - 9, corner_.y() - 8}, "y, m", 12, kFaint, Align::kRight);
}

void TopView::scale_bar() {
  const double length_m = round_step(0.09 * shown_m_.sizes().x());
  const double length_px = length_m * pixels_per_m_;
  const Eigen::Vector2d left(corner_.x() + 16, corner_.y() + size_.y() - 14);
  canvas_.rectangle(left - Eigen::Vector2d(8, 24), {length_px + 16, 32}, color(0xFFFFFF));
  canvas_.rectangle(left - Eigen::Vector2d(0, 4), {length_px, 4}, kInk);
  canvas_.rectangle(left - Eigen::Vector2d(-1, 3), {length_px / 2 - 1, 2}, color(0xFFFFFF));
  canvas_.text(left + Eigen::Vector2d(length_px / 2, -9), label(length_m, length_m) + " m", 12, kInk,
               Align::kCenter);
}

void TopView::frame() {
  constexpr double kLeastTick_px = 56;
  const double step_m = round_step(kLeastTick_px / pixels_per_m_);
  ticks_along_x(step_m);
  ticks_along_y(step_m);
  canvas_.outline(corner_ + Eigen::Vector2d(0.5, 0.5), size_ - Eigen::Vector2d(1, 1), {kInk, 1});
  scale_bar();
}

}  // namespace floornav
