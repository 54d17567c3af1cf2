#include "tools/replay/map_files.hpp"

#include <cmath>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "tests/tools/temporary_folder.hpp"

namespace floornav {
namespace {

/// 3 x 2 cells with their lower left corner at (-0.2, 0.4): free, blocked, unknown below; unknown, free,
/// blocked above.
MapRaster small_map() {
  using enum VertexState;
  const float none = std::nanf("");
  return {{0.1, {-2, 4}, 3, 2},
          {kFree, kBlocked, kUnknown, kUnknown, kFree, kBlocked},
          {255, 51, 0, 0, 204, 0},
          {0.01F, 0.5F, none, none, -0.02F, 0.7F}};
}

TEST(MapFiles, AreWhatMapServerReads) {
  const TemporaryFolder folder;
  write_map_files(small_map(), folder.path());
  const std::string yaml = file_content(folder / "map.yaml");
  for (const char* line :
       {"image: map.pgm\n", "resolution: 0.1\n", "origin: [-0.2000, 0.4000, 0.0]\n", "negate: 0\n",
        "occupied_thresh: 0.65\n", "free_thresh: 0.196\n", "mode: trinary\n"})
    EXPECT_NE(yaml.find(line), std::string::npos) << yaml;
  const cv::Mat pgm = cv::imread((folder / "map.pgm").string(), cv::IMREAD_UNCHANGED);
  ASSERT_EQ(pgm.type(), CV_8UC1);
  ASSERT_EQ(pgm.size(), cv::Size(3, 2));
  const auto state = [&](int column, int row_from_below) {  // map_server's trinary rule
    const double occupied = (255 - pgm.at<std::uint8_t>(1 - row_from_below, column)) / 255.0;
    return occupied > 0.65 ? 'B' : occupied < 0.196 ? 'F' : '?';
  };
  EXPECT_EQ(std::string({state(0, 0), state(1, 0), state(2, 0)}), "FB?");
  EXPECT_EQ(std::string({state(0, 1), state(1, 1), state(2, 1)}), "?FB");
}

TEST(MapFiles, KeepBeliefAndHeightAsFloatsWithNanForUnknown) {
  const TemporaryFolder folder;
  write_map_files(small_map(), folder.path());
  const cv::Mat belief = cv::imread((folder / "belief.tiff").string(), cv::IMREAD_UNCHANGED);
  const cv::Mat height = cv::imread((folder / "height.tiff").string(), cv::IMREAD_UNCHANGED);
  ASSERT_EQ(belief.type(), CV_32FC1);
  ASSERT_EQ(height.type(), CV_32FC1);
  EXPECT_FLOAT_EQ(belief.at<float>(1, 0), 1.0F);
  EXPECT_FLOAT_EQ(belief.at<float>(1, 1), 0.2F);
  EXPECT_TRUE(std::isnan(belief.at<float>(1, 2)));
  EXPECT_FLOAT_EQ(height.at<float>(0, 1), -0.02F);
  EXPECT_FLOAT_EQ(height.at<float>(0, 2), 0.7F);
  EXPECT_TRUE(std::isnan(height.at<float>(0, 0)));
}

TEST(MapFiles, ThatCannotBeWrittenAreAnError) {
  const TemporaryFolder folder;
  EXPECT_THROW(write_map_files(small_map(), folder / "absent"), std::runtime_error);
}

}  // namespace
}  // namespace floornav
