#include <set>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "tests/tools/temporary_folder.hpp"
#include "tools/pictures/map_picture.hpp"
#include "tools/pictures/terrain_picture.hpp"
#include "tools/pictures/top_view.hpp"

namespace floornav {
namespace {

/// 4 x 2 m: free, with a blocked square of 1 x 1 m in the upper right corner.
MapRaster map_with_box() {
  MapRaster map;
  map.cells = {0.1, {0, 0}, 40, 20};
  map.state.assign(800, VertexState::kFree);
  map.belief.assign(800, 255);
  map.height_m.assign(800, 0.0F);
  for (int row = 10; row < 20; ++row)
    for (int column = 30; column < 40; ++column) {
      map.state[map.cells.index_of({column, row})] = VertexState::kBlocked;
      map.belief[map.cells.index_of({column, row})] = 0;
      map.height_m[map.cells.index_of({column, row})] = 0.5F;
    }
  return map;
}

/// How much of a colour there is in a picture, and the middle of it, in px.
struct Found {
  double pixels = 0;
  cv::Point2d middle;
};
Found find(const cv::Mat& picture, const cv::Vec3b& bgr) {
  Found found;
  for (int y = 0; y < picture.rows; ++y)
    for (int x = 0; x < picture.cols; ++x)
      if (cv::norm(picture.at<cv::Vec3b>(y, x), bgr, cv::NORM_INF) < 3) {
        found.pixels += 1;
        found.middle += cv::Point2d(x, y);
      }
  found.middle /= std::max(found.pixels, 1.0);
  return found;
}

TEST(MapPicture, ShowsBlockedCellsDarkAtTheirPlaceAndSize) {
  const TemporaryFolder folder;
  MapPicture picture;
  picture.map = map_with_box();
  write_map_png(picture, folder / "map.png");
  const cv::Mat png = cv::imread((folder / "map.png").string());
  const Found dark = find(png, {0x2F, 0x26, 0x23});
  const Found light = find(png, {0xEC, 0xF9, 0xF4});
  EXPECT_NEAR(light.pixels / dark.pixels, 7, 0.5);  // 7 m^2 free, 1 m^2 blocked
  EXPECT_GT(dark.middle.x, light.middle.x);
  EXPECT_LT(dark.middle.y, light.middle.y);  // y points up
}

TEST(MapPicture, IsTheSameBytesEveryTime) {
  const TemporaryFolder folder;
  MapPicture picture;
  picture.map = map_with_box();
  picture.path = {{0.5, 0.5}, {2, 1}, {2.5, 1.5}};
  picture.trajectory = {{0.1, 0.1}, {0.5, 0.5}};
  picture.goal = Eigen::Vector2d(2.5, 1.5);
  picture.robot = RobotMark{{0.5, 0.5}, 0.3, 0.45};
  picture.assumed_floor = AssumedDisc{{0.1, 0.1}, 0.7};
  write_map_png(picture, folder / "a.png");
  write_map_png(picture, folder / "b.png");
  EXPECT_EQ(file_content(folder / "a.png"), file_content(folder / "b.png"));
}

TEST(MapPicture, OfAHugeMapStaysAPicture) {
  const TemporaryFolder folder;
  MapPicture picture;
  picture.map.cells = {0.05, {-4000, -100}, 8000, 200};
  picture.map.state.assign(picture.map.cells.size(), VertexState::kFree);
  picture.map.belief.assign(picture.map.cells.size(), 255);
  write_map_png(picture, folder / "map.png");
  EXPECT_LT(cv::imread((folder / "map.png").string()).cols, 1500);
}

TEST(TerrainPicture, ShowsHigherThingsLighter) {
  const TemporaryFolder folder;
  const MapRaster map = map_with_box();
  TerrainPicture picture;
  picture.terrain = {map.cells, map.height_m};
  write_terrain_png(picture, folder / "terrain.png");
  const cv::Mat png = cv::imread((folder / "terrain.png").string());
  const auto floor = packed(perceptual_color(0));
  const auto box = packed(perceptual_color(1));
  const auto bgr = [](std::uint32_t c) {
    return cv::Vec3b(static_cast<uchar>(c), static_cast<uchar>(c >> 8), static_cast<uchar>(c >> 16));
  };
  const Found low = find(png, bgr(floor));
  const Found high = find(png, bgr(box));
  EXPECT_GT(low.pixels, 5 * high.pixels);
  EXPECT_GT(high.pixels, 1000);
}

TEST(RoundStep, IsTheNextOneTwoOrFive) {
  EXPECT_DOUBLE_EQ(round_step(0.03), 0.05);
  EXPECT_DOUBLE_EQ(round_step(0.2), 0.2);
  EXPECT_DOUBLE_EQ(round_step(6), 10);
  EXPECT_EQ(label(1.5, 0.5), "1.5");
  EXPECT_EQ(label(4, 2), "4");
  EXPECT_EQ(label(-1e-17, 0.1), "0.0");
}

}  // namespace
}  // namespace floornav
