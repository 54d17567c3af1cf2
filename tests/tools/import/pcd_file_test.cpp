#include "tools/import/pcd_file.hpp"

#include <cmath>
#include <cstring>
#include <limits>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <lzf.h>

#include "tests/tools/temporary_folder.hpp"

namespace floornav {
namespace {

constexpr int kWidth = 16;
constexpr int kHeight = 6;

Eigen::Vector3f point(int i) {
  if (i % 7 == 3) return Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN());
  return {0.1F * static_cast<float>(i), -1.5F, 0.001F * static_cast<float>(i * i)};
}

std::string header(const std::string& data) {
  return "# .PCD v0.7\nVERSION 0.7\nFIELDS rgb x y z\nSIZE 4 4 4 8\nTYPE U F F F\nCOUNT 1 1 1 1\nWIDTH "
         "16\nHEIGHT 6\n"
         "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 96\nDATA " +
         data + "\n";
}

template <class Value>
std::string raw(Value value) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  return bytes;
}

std::string ascii_cloud() {
  std::string text = header("ascii");
  for (int i = 0; i < kWidth * kHeight; ++i) {
    const auto p = point(i);
    text += std::to_string(i);
    for (const float c : {p.x(), p.y(), p.z()}) text += std::isnan(c) ? " nan" : fmt::format(" {}", c);
    text += "\n";
  }
  return text;
}

std::string binary_cloud() {
  std::string bytes = header("binary");
  for (int i = 0; i < kWidth * kHeight; ++i)
    bytes += raw(std::uint32_t{7}) + raw(point(i).x()) + raw(point(i).y()) + raw(double{point(i).z()});
  return bytes;
}

std::string compressed_cloud() {
  std::string columns;
  for (int i = 0; i < kWidth * kHeight; ++i) columns += raw(std::uint32_t{7});
  for (int i = 0; i < kWidth * kHeight; ++i) columns += raw(point(i).x());
  for (int i = 0; i < kWidth * kHeight; ++i) columns += raw(point(i).y());
  for (int i = 0; i < kWidth * kHeight; ++i) columns += raw(double{point(i).z()});
  const auto size = static_cast<std::uint32_t>(columns.size());
  std::string packed(columns.size(), '\0');
  const unsigned packed_size = lzf_compress(columns.data(), size, packed.data(), size);
  packed.resize(packed_size);
  return header("binary_compressed") + raw(std::uint32_t{packed_size}) + raw(size) + packed;
}

class PcdForm : public testing::TestWithParam<std::string (*)()> {
 protected:
  TemporaryFolder folder_;
};

TEST_P(PcdForm, GivesThePointsBack) {
  write_file(folder_ / "cloud.pcd", GetParam()());
  const OrganisedCloud cloud = read_pcd(folder_ / "cloud.pcd");
  ASSERT_EQ(cloud.width, kWidth);
  ASSERT_EQ(cloud.height, kHeight);
  for (int i = 0; i < kWidth * kHeight; ++i) {
    const auto& p = cloud.points[static_cast<std::size_t>(i)];
    if (i % 7 == 3) {
      EXPECT_TRUE(p.array().isNaN().all());
    } else {
      EXPECT_TRUE(p.isApprox(point(i), 1e-5F)) << i;
    }
  }
}

TEST_P(PcdForm, IsRefusedWhereverItIsCut) {
  const std::string whole = GetParam()();
  for (std::size_t length = 0; length + 16 < whole.size(); length += 5) {
    write_file(folder_ / "cloud.pcd", whole.substr(0, length));
    EXPECT_THROW(read_pcd(folder_ / "cloud.pcd"), std::runtime_error) << length;
  }
}

INSTANTIATE_TEST_SUITE_P(AsciiBinaryCompressed, PcdForm,
                         testing::Values(ascii_cloud, binary_cloud, compressed_cloud));

TEST(PcdFile, DamagedHeadersAreRefused) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& from, const std::string& to) {
    std::string cloud = binary_cloud();
    cloud.replace(cloud.find(from), from.size(), to);
    write_file(folder / "cloud.pcd", cloud);
    EXPECT_THROW(read_pcd(folder / "cloud.pcd"), std::runtime_error) << to;
  };
  refused("HEIGHT 6", "HEIGHT 1");
  refused("HEIGHT 6", "HEIGHT -6");
  refused("HEIGHT 6", "HEIGHT 30000");
  refused("WIDTH 16", "WIDTH 99999999999999999999");
  refused("WIDTH 16", "WIDTH x");
  refused("POINTS 96", "POINTS 95");
  refused("FIELDS rgb x y z", "FIELDS rgb x y q");
  refused("FIELDS rgb x y z", "FIELDS rgb x y");
  refused("SIZE 4 4 4 8", "SIZE 4 4 2 8");
  refused("TYPE U F F F", "TYPE U F I F");
  refused("COUNT 1 1 1 1", "COUNT 1 1 2 1");
  refused("DATA binary", "DATA bzip2");
}

TEST(PcdFile, DamagedCompressedBytesAreAnErrorOrReadSafely) {
  const TemporaryFolder folder;
  const std::string whole = compressed_cloud();
  for (std::size_t i = whole.find("compressed") + 11; i < whole.size(); ++i)
    for (const int flip : {0x20, 0xFF}) {
      std::string damaged = whole;
      damaged[i] = static_cast<char>(damaged[i] ^ flip);
      write_file(folder / "cloud.pcd", damaged);
      try {
        EXPECT_EQ(read_pcd(folder / "cloud.pcd").points.size(), 96U);
      } catch (const std::runtime_error&) {
      }
    }
}

}  // namespace
}  // namespace floornav
