#include "tools/import/depth_image.hpp"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "tests/tools/temporary_folder.hpp"

namespace floornav {
namespace {

/// An image of 8 x 5 px with counts from 0 to 65559 mod 2^16.
std::filesystem::path write_image(const std::filesystem::path& file) {
  cv::Mat image(5, 8, CV_16UC1);
  for (int i = 0; i < 40; ++i) image.at<std::uint16_t>(i / 8, i % 8) = static_cast<std::uint16_t>(i * 1681);
  cv::imwrite(file.string(), image);
  return file;
}

class DepthImageFile : public testing::TestWithParam<const char*> {};

TEST_P(DepthImageFile, IsReadBitForBit) {
  const TemporaryFolder folder;
  const DepthImage image = read_depth_image(write_image(folder / (std::string("image") + GetParam())));
  ASSERT_EQ(image.width, 8);
  ASSERT_EQ(image.height, 5);
  for (int i = 0; i < 40; ++i)
    EXPECT_EQ(image.pixels[static_cast<std::size_t>(i)], static_cast<std::uint16_t>(i * 1681));
}

INSTANTIATE_TEST_SUITE_P(Formats, DepthImageFile, testing::Values(".png", ".tiff", ".pgm"));

TEST(DamagedPng, IsRefusedWhereverABitIsWrongOrItEnds) {
  const TemporaryFolder folder;
  const auto file = write_image(folder / "image.png");
  const std::string whole = file_content(file);
  const std::size_t end = whole.find("IEND") + 8;
  for (std::size_t i = 0; i < end; ++i) {
    std::string flipped = whole;
    flipped[i] = static_cast<char>(flipped[i] ^ 0x10);
    write_file(file, flipped);
    EXPECT_THROW(read_depth_image(file), std::runtime_error) << "bit at byte " << i;
    write_file(file, whole.substr(0, i));
    EXPECT_THROW(read_depth_image(file), std::runtime_error) << "cut at byte " << i;
  }
}

TEST(DepthImages, OtherThanOneChannelOfSixteenBitsAreRefused) {
  const TemporaryFolder folder;
  const auto file = folder / "image.png";
  for (const int type : {CV_8UC1, CV_8UC3, CV_16UC3}) {
    cv::imwrite(file.string(), cv::Mat::zeros(4, 4, type));
    EXPECT_THROW(read_depth_image(file), std::runtime_error);
  }
}

TEST(DepthImages, OfAFolderComeByName) {
  const TemporaryFolder folder;
  for (const char* name : {"b.png", "a.tiff", "c.pgm", "note.txt"}) write_file(folder / name, "");
  const auto files = depth_images_in(folder.path());
  ASSERT_EQ(files.size(), 3U);
  EXPECT_EQ(files[0].filename(), "a.tiff");
  EXPECT_EQ(files[2].filename(), "c.pgm");
}

TEST(DepthImages, OfAFolderWithoutAnyAreAnError) {
  const TemporaryFolder folder;
  EXPECT_THROW(depth_images_in(folder.path()), std::runtime_error);
  EXPECT_THROW(depth_images_in(folder / "absent"), std::runtime_error);
}

}  // namespace
}  // namespace floornav
