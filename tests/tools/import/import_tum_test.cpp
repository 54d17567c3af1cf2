#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "tests/real_data.hpp"
#include "tests/tools/import/recorded.hpp"
#include "tests/tools/temporary_folder.hpp"
#include "tools/import/import.hpp"

namespace floornav {
namespace {

const Pinhole kSmallCamera{8.0F, 8.0F, 3.5F, 2.5F, 8, 6};

ImportTarget target(const std::filesystem::path& log) {
  return {log, imported_sensor("kinect"), [](auto, auto) {}};
}

/// A TUM folder with images at 10 Hz from 1.0 s, all 8 x 6 px, and a camera that moves along x at 1 m/s, 20
/// degrees down.
class TumFolder : public testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directory(folder_ / "tum");
    std::ofstream list(folder_ / "tum/depth.txt");
    list << "# depth maps\n# file\n# timestamp filename\n";
    for (int i = 0; i < 5; ++i) {
      const std::string name = std::to_string(i) + ".png";
      list << "1." << i << "00003 " << name << "\n";
      write_image(name, 8, 6);
    }
    write_trajectory(0.5, 2.0);
  }
  void write_image(const std::string& name, int width, int height) {
    cv::imwrite((folder_ / ("tum/" + name)).string(), cv::Mat(height, width, CV_16UC1, cv::Scalar(5000)));
  }
  void write_trajectory(double from_s, double to_s) {
    // ahead along x, 20 degrees down: columns of R are right, down, ahead
    Eigen::Matrix3d R;
    const double p = 20 * 3.14159265358979 / 180;
    R << 0, -std::sin(p), std::cos(p), -1, 0, 0, 0, -std::cos(p), -std::sin(p);
    const Eigen::Quaterniond q(R);
    std::ofstream file(folder_ / "tum/groundtruth.txt");
    file << "# timestamp tx ty tz qx qy qz qw\n";
    for (double t = from_s; t < to_s; t += 0.01)
      file << std::to_string(t) << " " << t << " 0 1.2 " << q.x() << " " << q.y() << " " << q.z() << " "
           << q.w() << "\n";
  }
  [[nodiscard]] TumImport import() const { return {folder_ / "tum", kSmallCamera, 5000, 0.0}; }
  [[nodiscard]] std::filesystem::path log() const { return folder_ / "out.lcm"; }
  [[nodiscard]] bool nothing_left() const {
    return !std::filesystem::exists(log()) && !std::filesystem::exists(log().string() + ".part");
  }
  TemporaryFolder folder_;
};

TEST_F(TumFolder, PutsTheBodyUnderTheCameraAtEveryCloud) {
  const ImportReport report = import_tum(import(), target(log()));
  EXPECT_EQ(report.clouds, 5);
  const auto clouds = recorded_clouds(log());
  ASSERT_EQ(clouds.size(), 5U);
  for (std::size_t i = 0; i < clouds.size(); ++i) {
    const double t_s = 1.000003 + 0.1 * static_cast<double>(i);
    EXPECT_EQ(clouds[i].message.utime, 1'000'003 + 100'000 * static_cast<std::int64_t>(i));
    EXPECT_NEAR(clouds[i].T_world_body.translation().x(), t_s, 1e-6);
    EXPECT_EQ(clouds[i].T_world_body.translation().z(), 0);
    EXPECT_NEAR(heading_of(clouds[i].T_world_body), 0, 1e-6);
    EXPECT_NEAR(clouds[i].T_body_sensor.translation().z(), 1.2, 1e-9);
    EXPECT_EQ(clouds[i].pixels, std::vector<std::uint16_t>(48, 5000));
  }
}

TEST_F(TumFolder, CountsListedImagesThatAreAbsent) {
  std::filesystem::remove(folder_ / "tum/1.png");
  const ImportReport report = import_tum(import(), target(log()));
  EXPECT_EQ(report.clouds, 4);
  ASSERT_EQ(report.notes.size(), 1U);
  EXPECT_EQ(report.notes.front(), "1 of 5 listed images are absent");
}

TEST_F(TumFolder, LeavesOutImagesWithoutGroundTruth) {
  write_trajectory(0.5, 1.25);
  EXPECT_EQ(import_tum(import(), target(log())).clouds, 3);
}

TEST_F(TumFolder, LeavesNothingBehindWhereItFails) {
  const auto fails = [&] {
    EXPECT_THROW(import_tum(import(), target(log())), std::runtime_error);
    EXPECT_TRUE(nothing_left());
  };
  write_image("3.png", 4, 6);  // another size mid-way
  fails();
  write_file(folder_ / "tum/3.png", "damaged");
  fails();
  write_trajectory(5, 6);
  fails();
  for (int i = 0; i < 5; ++i) std::filesystem::remove(folder_ / ("tum/" + std::to_string(i) + ".png"));
  fails();
  write_file(folder_ / "tum/depth.txt", "1.0\n");
  fails();
  write_file(folder_ / "tum/groundtruth.txt", "1.0 0 0 1 0 0 0 0\n");  // a zero quaternion
  fails();
}

TEST_F(TumFolder, RefusesACameraThatDoesNotGoWithTheImages) {
  for (const Pinhole& camera :
       {Pinhole{-8, 8, 3, 3, 0, 0}, Pinhole{8, NAN, 3, 3, 0, 0}, Pinhole{8, 8, 300, 3, 0, 0},
        Pinhole{8, 8, 3, -50, 0, 0}, Pinhole{5e4F, 8, 3, 3, 0, 0}}) {
    TumImport absurd = import();
    absurd.camera = camera;
    EXPECT_THROW(import_tum(absurd, target(log())), std::runtime_error);
    EXPECT_TRUE(nothing_left());
  }
}

/// The camera's pose in the world at a time, interpolated from the motion capture's text by plain arithmetic.
std::map<double, std::array<double, 7>> motion_capture(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::map<double, std::array<double, 7>> rows;
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    double t = 0;
    std::array<double, 7> row{};
    if (!(words >> t)) continue;
    for (double& value : row) words >> value;
    rows[t] = row;
  }
  return rows;
}

TEST(TumRecording, KeepsEveryPixelAndTheMotionCapturesCamera) {
  const auto folder = real_data("tum_fr1_rpy");
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no recording at " << folder;
  const TemporaryFolder out;
  const Pinhole camera{517.3F, 516.5F, 318.6F, 255.3F, 0, 0};
  const ImportReport report = import_tum({folder, camera, 5000, 0}, target(out / "tum.lcm"));
  EXPECT_EQ(report.notes, std::vector<std::string>{"603 of 722 listed images are absent"});
  const auto clouds = recorded_clouds(out / "tum.lcm");
  ASSERT_EQ(clouds.size(), 119U);
  const auto truth = motion_capture(folder / "groundtruth.txt");
  for (const RecordedCloud& cloud : clouds) {
    const std::string digits = std::to_string(cloud.message.utime);
    const std::string name = digits.substr(0, 10) + "." + digits.substr(10) + ".png";
    const cv::Mat image = cv::imread((folder / "depth" / name).string(), cv::IMREAD_UNCHANGED);
    ASSERT_EQ(cloud.pixels,
              std::vector<std::uint16_t>(image.begin<std::uint16_t>(), image.end<std::uint16_t>()));

    const double t = static_cast<double>(cloud.message.utime) / 1e6;
    const auto after = truth.lower_bound(t);
    const auto before = std::prev(after);
    const double f = (t - before->first) / (after->first - before->first);
    const Pose T_world_camera = cloud.T_world_body * cloud.T_body_sensor;
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      EXPECT_NEAR(T_world_camera.translation()[axis], (1 - f) * before->second[a] + f * after->second[a],
                  1e-5);
    }
    const auto& nearer = (f < 0.5 ? before : after)->second;
    EXPECT_LT(
        Eigen::Quaterniond(T_world_camera.linear())
            .angularDistance(Eigen::Quaterniond(nearer[6], nearer[3], nearer[4], nearer[5]).normalized()),
        0.02);
  }
}

}  // namespace
}  // namespace floornav
