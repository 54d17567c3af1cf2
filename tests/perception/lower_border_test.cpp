#include "perception/lower_border.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace floornav {
namespace {

constexpr int kColumns = 20;
constexpr float kCertainty_m = 600.0F;
constexpr float kThreshold = 2.5F;

/// A patch of a plane in the image, its lower border a row lower with every second column.
class BorderOfPatch : public testing::Test {
 protected:
  void make(int rows) {
    for (int row = 0; row <= rows; ++row)
      for (int column = 0; column < kColumns; ++column)
        if (row < rows + column % 2) cloud.pixel.push_back((100 + row) * camera.width + 300 + column);
    pool.resize(cloud.pixel.size());
    for (std::size_t i = 0; i < pool.size(); ++i) {
      pool.point[i] = static_cast<std::int32_t>(i);
      pool.certainty[i] = kCertainty_m;
      pool.inverse_depth[i] = inverse_depth;
    }
    weights.assign(pool.size(), 1.0F);
  }
  /// Of a plane whose inverse depth grows by so many sigmas a row.
  void leave_out(float sigmas_a_row) {
    const InverseDepthPlane plane{0.0F, sigmas_a_row / kCertainty_m * camera.fy, 0.1F};
    LowerBorder().leave_out(pool, cloud, camera, plane, kThreshold, weights);
  }
  [[nodiscard]] int left(int column) const {
    int count = 0;
    for (std::size_t i = 0; i < pool.size(); ++i)
      count += cloud.pixel[i] % camera.width == 300 + column && weights[i] > 0.0F ? 1 : 0;
    return count;
  }

  Pinhole camera{525.0F, 525.0F, 319.5F, 239.5F, 640, 480};
  RoiCloud cloud;
  PlanePool pool;
  std::vector<float> weights;
  float inverse_depth = 0.25F;
};

/// 0.7 of the threshold are 1.75 sigmas: two rows of one sigma each.
TEST_F(BorderOfPatch, IsAsManyRowsAsThePlaneTakesToLeaveASide) {
  make(8);
  leave_out(1.0F);
  EXPECT_EQ(left(0), 6);
  EXPECT_EQ(left(1), 7);
}

TEST_F(BorderOfPatch, OfAPlaneThatLeavesItAtOnceIsOneRow) {
  make(8);
  leave_out(20.0F);
  EXPECT_EQ(left(0), 7);
}

TEST_F(BorderOfPatch, IsKeptWhereLittleElseWouldBeLeft) {
  make(2);
  leave_out(1.0F);
  EXPECT_EQ(left(0), 2);
  EXPECT_EQ(left(1), 3);
}

TEST_F(BorderOfPatch, DoesNotCountWhatIsNotThePlanes) {
  make(8);
  for (std::size_t i = 0; i < pool.size(); ++i)
    if (cloud.pixel[i] / camera.width >= 105) weights[i] = 0.0F;
  leave_out(1.0F);
  EXPECT_EQ(left(0), 3);
}

TEST_F(BorderOfPatch, IsKeptOfWhatRunsAlongTheSide) {
  make(8);
  leave_out(0.0F);
  EXPECT_EQ(left(0), 8);
}

/// 2.5 sigmas are 1.7 cm there.
TEST_F(BorderOfPatch, IsKeptOfWhatIsNear) {
  inverse_depth = 0.5F;
  make(8);
  leave_out(1.0F);
  EXPECT_EQ(left(0), 8);
}

}  // namespace
}  // namespace floornav
