#include "tools/pictures/map_picture.hpp"

#include <array>
#include <cmath>
#include <limits>

#include "tools/pictures/cell_color.hpp"
#include "tools/pictures/top_view.hpp"

namespace floornav {

namespace {

constexpr Color kInk = color(0x26292E);
constexpr Color kPath = color(0x1668D8);
constexpr Color kTrajectory = kRobotColor;
constexpr Color kGoal = color(0xD81E5B);
constexpr Color kTruth = color(0x0A9396);
constexpr Color kWhite = color(0xFFFFFF);
constexpr double kTrajectoryGap_m = 2.0;  // frames of their own maps lie farther apart

Eigen::AlignedBox2d shown_part(const MapPicture& picture) {
  const CellRectangle& cells = picture.map.cells;
  Eigen::AlignedBox2d box(Eigen::Vector2d(cells.x_min_m(), cells.y_min_m()),
                          Eigen::Vector2d(cells.x_max_m(), cells.y_max_m()));
  for (const auto& place : picture.trajectory) box.extend(place);
  for (const auto& place : picture.path) box.extend(place);
  if (picture.goal) box.extend(*picture.goal);
  for (const auto& outline : picture.true_outlines)
    for (const auto& place : outline) box.extend(place);
  if (picture.assumed_floor) {
    const Eigen::Vector2d reach = Eigen::Vector2d::Constant(picture.assumed_floor->radius_m);
    box.extend(Eigen::Vector2d(picture.assumed_floor->center_m - reach));
    box.extend(Eigen::Vector2d(picture.assumed_floor->center_m + reach));
  }
  const double margin_m = 0.3 + 0.02 * box.sizes().maxCoeff();
  return {box.min().array() - margin_m, box.max().array() + margin_m};
}

void draw_path(TopView& view, const std::vector<Eigen::Vector2d>& path) {
  if (path.size() < 2) return;
  const double no_gap = std::numeric_limits<double>::infinity();
  view.line(path, {kWhite, 7, 0.9}, no_gap);
  view.line(path, {kPath, 3.5}, no_gap);
}

void draw_goal(Canvas& canvas, const Eigen::Vector2d& at) {
  canvas.disc(at, 9, kWhite);
  canvas.circle(at, 7, {kGoal, 2.5});
  canvas.disc(at, 3, kGoal);
}

/// The key at the right: a mark and its words, one below the other.
class Key {
 public:
  explicit Key(TopView& view) : canvas_(view.canvas()), at_(view.key_corner()) {}

  void swatch(Color left, Color right, const std::string& words) {
    constexpr int kSteps = 17;
    for (int i = 0; i < kSteps; ++i)
      canvas_.rectangle(at_ + Eigen::Vector2d(2.0 * i, 0), {2, 16}, mix(left, right, i / (kSteps - 1.0)));
    canvas_.outline(at_ + Eigen::Vector2d(0.5, 0.5), {33, 15}, {kInk, 1, 0.5});
    words_beside(words);
  }
  void line(const Stroke& stroke, const std::string& words) {
    canvas_.line(std::array<Eigen::Vector2d, 2>{at_ + Eigen::Vector2d(1, 8), at_ + Eigen::Vector2d(33, 8)},
                 stroke);
    words_beside(words);
  }
  void goal(const std::string& words) {
    draw_goal(canvas_, at_ + Eigen::Vector2d(17, 8));
    words_beside(words);
  }

 private:
  void words_beside(const std::string& words) {
    canvas_.text(at_ + Eigen::Vector2d(44, 13), words, 12.5, kInk);
    at_.y() += 27;
  }
  Canvas& canvas_;
  Eigen::Vector2d at_;
};

constexpr Stroke kTrajectoryStroke{kTrajectory, 1.8, 0.9};
constexpr Stroke kRoadStroke{kPath, 1.6, 0.9};
constexpr Stroke kAssumedStroke{kInk, 1.5, 0.8, 5};
constexpr Stroke kTruthStroke{kTruth, 1.3, 0.9};

void draw_key(TopView& view, const MapPicture& picture) {
  Key key(view);
  key.swatch(cell_color(VertexState::kFree, 0), cell_color(VertexState::kFree, 1), "free, belief 0 to 1");
  key.swatch(cell_color(VertexState::kBlocked, 0), cell_color(VertexState::kBlocked, 0), "blocked, obstacle");
  key.swatch(cell_color(VertexState::kBlocked, 0.5), cell_color(VertexState::kBlocked, 1),
             "blocked, out of reach");
  key.swatch(cell_color(VertexState::kUnknown, 0), cell_color(VertexState::kUnknown, 0), "unknown");
  if (!picture.roads.empty()) key.line(kRoadStroke, "roadmap");
  if (!picture.trajectory.empty()) key.line(kTrajectoryStroke, "robot's way");
  if (picture.path.size() > 1) key.line({kPath, 3.5}, "path");
  if (picture.goal) key.goal("goal");
  if (picture.assumed_floor) key.line(kAssumedStroke, "assumed floor at start");
  if (!picture.true_outlines.empty()) key.line(kTruthStroke, "what truly stands there");
}

}  // namespace

void write_map_png(const MapPicture& picture, const std::filesystem::path& file) {
  TopView view({.shown_m = shown_part(picture),
                .resolution_m = picture.map.cells.resolution_m,
                .longest_px = picture.longest_px,
                .title = picture.title,
                .subtitle = picture.subtitle});
  paint_cells(view, picture.map);
  view.frame();
  for (const auto& road : picture.roads) view.line(road, kRoadStroke, kTrajectoryGap_m);
  view.line(picture.trajectory, kTrajectoryStroke, kTrajectoryGap_m);
  for (const auto& outline : picture.true_outlines)
    view.line(outline, kTruthStroke, std::numeric_limits<double>::infinity());
  if (picture.assumed_floor)
    view.canvas().circle(view.at(picture.assumed_floor->center_m),
                         picture.assumed_floor->radius_m * view.pixels_per_m(), kAssumedStroke);
  draw_path(view, picture.path);
  if (picture.robot) draw_robot(view, *picture.robot);
  if (picture.goal) draw_goal(view.canvas(), view.at(*picture.goal));
  draw_key(view, picture);
  view.canvas().write_png(file);
}

}  // namespace floornav
