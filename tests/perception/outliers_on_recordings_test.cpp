#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "perception/outliers.hpp"
#include "tests/real_data.hpp"
#include "tools/import/depth_image.hpp"
#include "tools/import/pcd_file.hpp"

namespace floornav {
namespace {

struct Points {
  Pinhole camera;
  std::vector<float> x, y, z;
  std::vector<std::int32_t> pixel;
  void add(int u, int v, const Eigen::Vector3f& p) {
    x.push_back(p.x());
    y.push_back(p.y());
    z.push_back(p.z());
    pixel.push_back(v * camera.width + u);
  }
};

struct Window {
  int left, top;
};
constexpr int kSide_px = 48;
constexpr Window kWindows[] = {{280, 200}, {100, 380}, {500, 300}};

Points crop(const DepthImage& image, float metres_a_count, float focal_px, Window window) {
  Points points;
  points.camera.fx = points.camera.fy = focal_px;
  for (int v = window.top; v < window.top + kSide_px; ++v)
    for (int u = window.left; u < window.left + kSide_px; ++u) {
      const std::uint16_t count = image.pixels[static_cast<std::size_t>(v * image.width + u)];
      const float z = metres_a_count * static_cast<float>(count);
      if (count == 0 || count == 65535) continue;
      points.add(u, v, z * points.camera.ray(static_cast<float>(u), static_cast<float>(v)));
    }
  return points;
}

Points crop(const OrganisedCloud& cloud, Window window) {
  Points points;
  for (int v = window.top; v < window.top + kSide_px; ++v)
    for (int u = window.left; u < window.left + kSide_px; ++u) {
      const Eigen::Vector3f& p = cloud.points[static_cast<std::size_t>(v * cloud.width + u)];
      if (p.allFinite()) points.add(u, v, p);
    }
  return points;
}

/// Eq. (6), every point against every other.
std::vector<std::uint8_t> brute_force_keep(const Points& c, std::size_t neighbors, double epsilon) {
  std::vector<float> mean;
  std::vector<float> squared(c.x.size());
  for (std::size_t i = 0; i < c.x.size(); ++i) {
    for (std::size_t j = 0; j < c.x.size(); ++j) {
      const float dx = c.x[i] - c.x[j], dy = c.y[i] - c.y[j], dz = c.z[i] - c.z[j];
      squared[j] = (dx * dx + dy * dy) + dz * dz;
    }
    squared[i] = -1.0F;  // the point itself comes first
    std::partial_sort(squared.begin(), squared.begin() + static_cast<std::ptrdiff_t>(neighbors) + 1,
                      squared.end());
    float sum = 0.0F;
    for (std::size_t k = 1; k <= neighbors; ++k) sum += std::sqrt(squared[k]);
    mean.push_back(sum / static_cast<float>(neighbors));
  }
  const auto count = static_cast<double>(mean.size());
  double sum = 0.0, squares = 0.0;
  for (const float m : mean) sum += static_cast<double>(m);
  for (const float m : mean)
    squares += (static_cast<double>(m) - sum / count) * (static_cast<double>(m) - sum / count);
  const double limit = epsilon * std::sqrt(squares / count);
  std::vector<std::uint8_t> keep;
  for (const float m : mean) keep.push_back(std::abs(static_cast<double>(m) - sum / count) > limit ? 0 : 1);
  return keep;
}

/// Returns the number of outliers, so that a test can tell that there was something to decide.
std::int64_t compare_with_oracle(const Points& points) {
  if (points.x.size() < 500) return 0;
  Serial serial;
  std::int64_t outliers = 0;
  for (const int neighbors : {8, 20}) {
    const auto expected = brute_force_keep(points, static_cast<std::size_t>(neighbors), 2.0);
    for (const char* search : {"nanoflann", "window", "auto"}) {
      std::vector<std::uint8_t> keep(points.x.size());
      OutlierRemover remover({neighbors, 2.0, search});
      outliers += remover.remove({{points.x, points.y, points.z}, points.pixel, points.camera}, serial, keep);
      EXPECT_EQ(keep, expected) << search;
    }
  }
  return outliers;
}

struct Recording {
  const char* name;
  const char* folder;
  float metres_a_count;
  float focal_px;
};

class OutliersOfDepthImages : public testing::TestWithParam<Recording> {};

TEST_P(OutliersOfDepthImages, AreThoseOfTheBruteForceOracle) {
  const Recording& recording = GetParam();
  const auto folder = real_data(recording.folder);
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no recording at " << folder;
  const DepthImage image = read_depth_image(depth_images_in(folder).at(20));
  std::int64_t outliers = 0;
  for (const Window window : kWindows)
    outliers += compare_with_oracle(crop(image, recording.metres_a_count, recording.focal_px, window));
  EXPECT_GT(outliers, 0);
}

INSTANTIATE_TEST_SUITE_P(Recordings, OutliersOfDepthImages,
                         testing::Values(Recording{"Tum", "tum_fr1_rpy/depth", 1.0F / 5000.0F, 517.0F},
                                         Recording{"Pepper", "pepper_floor/depth", 0.001F, 381.4F}),
                         [](const auto& info) { return info.param.name; });

TEST(OutliersOfOrganisedClouds, AreThoseOfTheBruteForceOracle) {
  const auto folder = real_data("pcl_clouds");
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no recording at " << folder;
  const OrganisedCloud cloud = read_pcd(folder / "milk_cartoon_all_small_clorox.pcd");
  std::int64_t outliers = 0;
  for (const Window window : kWindows) outliers += compare_with_oracle(crop(cloud, window));
  EXPECT_GT(outliers, 0);
}

}  // namespace
}  // namespace floornav
