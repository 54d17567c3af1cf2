#include "lcmtypes/depth_cloud.hpp"

#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <string>

#include <gtest/gtest.h>

#include "sample_messages.hpp"

namespace floornav {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

TEST(DepthCloud, PixelsComeBackThroughTheWire) {
  std::vector<std::uint16_t> pixels(40 * 20);
  std::iota(pixels.begin(), pixels.end(), std::uint16_t{500});
  depth_cloud_t cloud = sample_message<depth_cloud_t>(1);
  pack_pixels(pixels, cloud);
  EXPECT_EQ(cloud.encoding, depth_cloud_t::RVL);
  depth_cloud_t received;
  ASSERT_TRUE(decodes(received, encoded(cloud)));
  std::vector<std::uint16_t> back;
  unpack_pixels(received, back);
  EXPECT_EQ(back, pixels);
}

TEST(DepthCloud, WhatRvlWouldSwellGoesRaw) {
  std::vector<std::uint16_t> pixels(40 * 20);
  for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] = i % 2 == 0 ? 1 : 60000;
  depth_cloud_t cloud = sample_message<depth_cloud_t>(1);
  pack_pixels(pixels, cloud);
  EXPECT_EQ(cloud.encoding, depth_cloud_t::RAW16);
  EXPECT_EQ(cloud.size, 2 * 40 * 20);
  std::vector<std::uint16_t> back;
  unpack_pixels(cloud, back);
  EXPECT_EQ(back, pixels);
}

struct Damage {
  const char* cause;  // in the error's text
  std::function<void(depth_cloud_t&)> apply;
};

std::vector<Damage> damages() {
  using Cloud = depth_cloud_t;
  return {
      {"width", [](Cloud& c) { c.width = 0; }},
      {"width", [](Cloud& c) { c.width = -40; }},
      {"height", [](Cloud& c) { c.height = 0; }},
      {"strip", [](Cloud& c) { c.first_row = -1; }},
      {"strip", [](Cloud& c) { c.first_row = 11; }},
      {"strip", [](Cloud& c) { c.first_row = 32767; }},
      {"strip", [](Cloud& c) { c.rows = 0; }},
      {"strip", [](Cloud& c) { c.rows = -1; }},
      {"pixels", [](Cloud& c) { c.width = c.height = 32767; }},
      {"sensor", [](Cloud& c) { c.sensor = 0; }},
      {"focal", [](Cloud& c) { c.fx = 0; }},
      {"focal", [](Cloud& c) { c.fx = kNan; }},
      {"focal", [](Cloud& c) { c.fy = -33; }},
      {"focal", [](Cloud& c) { c.fy = kInfinity; }},
      {"principal", [](Cloud& c) { c.cx = kNan; }},
      {"principal", [](Cloud& c) { c.cx = 1e6F; }},
      {"principal", [](Cloud& c) { c.cy = -1e6F; }},
      {"baseline", [](Cloud& c) { c.baseline = 0; }},
      {"baseline", [](Cloud& c) { c.baseline = kNan; }},
      {"noise", [](Cloud& c) { c.disparity_sigma = 0; }},
      {"noise", [](Cloud& c) { c.disparity_sigma = kInfinity; }},
      {"position", [](Cloud& c) { c.sensor_pos[2] = std::nan(""); }},
      {"position", [](Cloud& c) { c.sensor_pos[0] = 1e9; }},
      {"quaternion",
       [](Cloud& c) {
         for (double& q : c.sensor_orientation) q = 0;
       }},
      {"quaternion", [](Cloud& c) { c.sensor_orientation[3] = std::nan(""); }},
      {"quaternion", [](Cloud& c) { c.sensor_orientation[0] = 1e200; }},
      {"meaning", [](Cloud& c) { c.meaning = 3; }},
      {"scale", [](Cloud& c) { c.scale = 0; }},
      {"scale", [](Cloud& c) { c.scale = -0.001F; }},
      {"scale", [](Cloud& c) { c.scale = kNan; }},
      {"encoding", [](Cloud& c) { c.encoding = 0; }},
      {"uncertainty plane",
       [](Cloud& c) {
         c.uncertainty.resize(40);
         c.uncertainty_size = 40;
       }},
      {"uncertainty plane", [](Cloud& c) { c.uncertainty_size = -1; }},
      {"uncertainty scale", [](Cloud& c) { c.uncertainty_scale = 0; }},
      {"size", [](Cloud& c) { c.size -= 1; }},
      {"size", [](Cloud& c) { c.size = -1; }},
      {"depth",
       [](Cloud& c) {
         c.data.resize(c.data.size() - 4);
         c.size -= 4;
       }},
      {"raw", [](Cloud& c) { c.encoding = Cloud::RAW16; }},
      {"depth",
       [](Cloud& c) {
         c.rows = 19;
         c.uncertainty.clear();
         c.uncertainty_size = 0;
       }},
      {"depth",
       [](Cloud& c) {
         c.data.clear();
         c.size = 0;
       }},
  };
}

TEST(DepthCloud, EachImpossibleFieldIsRefusedWithItsCause) {
  std::vector<std::uint16_t> pixels;
  for (const Damage& damage : damages()) {
    depth_cloud_t cloud = sample_message<depth_cloud_t>(1);
    ASSERT_NO_THROW(unpack_pixels(cloud, pixels));
    damage.apply(cloud);
    try {
      unpack_pixels(cloud, pixels);
      ADD_FAILURE() << "accepted: " << damage.cause;
    } catch (const CorruptDepth& error) {
      EXPECT_NE(std::string(error.what()).find(damage.cause), std::string::npos)
          << damage.cause << ": " << error.what();
    }
  }
}

TEST(DepthCloud, NoUncertaintyPlaneNeedsNoScale) {
  depth_cloud_t cloud = sample_message<depth_cloud_t>(1);
  cloud.uncertainty.clear();
  cloud.uncertainty_size = 0;
  cloud.uncertainty_scale = 0;
  std::vector<std::uint16_t> pixels;
  EXPECT_NO_THROW(unpack_pixels(cloud, pixels));
}

}  // namespace
}  // namespace floornav
