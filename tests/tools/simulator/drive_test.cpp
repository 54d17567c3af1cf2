#include "tools/simulator/drive.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

#include "floornav/depth_cloud_t.hpp"
#include "floornav/pose_t.hpp"
#include "lcmtypes/depth_cloud.hpp"
#include "runtime/process/log_reader.hpp"
#include "tools/simulator/random.hpp"
#include "tools/simulator/scene_file.hpp"
#include "tools/simulator/truth_file.hpp"

namespace floornav {
namespace {

namespace fs = std::filesystem;

std::string bytes_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  EXPECT_TRUE(in) << path;
  return {std::istreambuf_iterator<char>(in), {}};
}

class Drive : public ::testing::Test {
 protected:
  Drive() : folder_(fs::temp_directory_path() / ("floornav_drive_" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
  }
  ~Drive() override { fs::remove_all(folder_); }

  fs::path record(const std::string& name, const DriveSettings& settings) {
    const Scene scene = load_scene(FLOORNAV_SOURCE_DIR "/tools/simulator/scenes/furnished_room.yaml");
    const RobotSettings robot;
    LogWriter log(folder_ / name);
    const DriveSummary drive = record_drive(scene, robot, settings, log);
    log.close();
    write_truth(folder_ / name, scene, robot, settings, drive,
                truth_of(scene, robot, 0.1, drive.start.position_m));
    return folder_ / name;
  }

  static DriveSettings small_drive() {
    DriveSettings settings;
    settings.sensor = kinect(160);
    settings.sensor.rate_hz = 2.0;
    settings.pose_rate_hz = 20.0;
    return settings;
  }

  fs::path folder_;
};

TEST_F(Drive, TheLogOfTheProjectIsMadeAgainByteForByte) {
  const fs::path log = record("furnished_room_160x120.lcm", small_drive());
  const std::string kept = FLOORNAV_SOURCE_DIR "/logs/furnished_room_160x120.lcm";
  for (const char* suffix : {"", ".truth.yaml", ".truth.csv"})
    EXPECT_TRUE(bytes_of(log.string() + suffix) == bytes_of(kept + suffix)) << suffix;
  EXPECT_LT(fs::file_size(kept), 1'000'000U);
}

TEST_F(Drive, MessagesDecodeInOrderAndEveryCloudLiesBetweenTwoPoses) {
  DriveSettings settings = small_drive();
  settings.seconds = 4;
  LogReader log(record("a.lcm", settings));
  LogEvent event;
  std::int64_t last_event = 0;
  std::int64_t last_pose = 0;
  std::int64_t first_pose = -1;
  std::int64_t last_cloud = 0;
  int clouds = 0;
  std::vector<std::uint16_t> pixels;
  while (log.next(event)) {
    EXPECT_GE(event.timestamp_us, last_event);
    last_event = event.timestamp_us;
    const int size = static_cast<int>(event.bytes.size());
    if (event.channel == "POSE") {
      pose_t pose{};
      ASSERT_EQ(pose.decode(event.bytes.data(), 0, size), size);
      EXPECT_GT(pose.utime, last_pose);
      last_pose = pose.utime;
      if (first_pose < 0) first_pose = pose.utime;
    } else {
      ASSERT_EQ(event.channel, "KINECT_CLOUD");
      depth_cloud_t cloud{};
      ASSERT_EQ(cloud.decode(event.bytes.data(), 0, size), size);
      EXPECT_NO_THROW(unpack_pixels(cloud, pixels));
      EXPECT_EQ(cloud.frame, clouds);
      EXPECT_EQ(cloud.seq, ++clouds);
      EXPECT_GE(cloud.utime, first_pose);
      last_cloud = cloud.utime;
    }
  }
  EXPECT_EQ(clouds, 9);
  EXPECT_GT(last_pose, last_cloud);
  EXPECT_EQ(log.skipped_bytes(), 0);
}

TEST_F(Drive, ASeedMakesItsOwnBytesAndAlwaysTheSame) {
  DriveSettings settings = small_drive();
  settings.seconds = 1;
  settings.pose_noise = {0.01, 0.3, 0.01, 0.5};
  const std::string first = bytes_of(record("a.lcm", settings));
  EXPECT_TRUE(first == bytes_of(record("b.lcm", settings)));
  settings.seed = 2;
  EXPECT_FALSE(first == bytes_of(record("c.lcm", settings)));
}

TEST_F(Drive, LatencyShiftsArrivalAndLeavesTimesOfExposure) {
  DriveSettings settings = small_drive();
  settings.seconds = 2;
  settings.cloud_latency_s = 0.05;
  LogReader log(record("a.lcm", settings));
  LogEvent event;
  while (log.next(event)) {
    if (event.channel != "KINECT_CLOUD") continue;
    depth_cloud_t cloud{};
    cloud.decode(event.bytes.data(), 0, static_cast<int>(event.bytes.size()));
    EXPECT_EQ(event.timestamp_us, cloud.utime + 50'000);
  }
}

TEST(Drives, ASceneWithoutADriveIsRefused) {
  const Scene scene = parse_scene("name: bare\narea_m: [0, 0, 1, 1]\nobjects: []\n", "bare.yaml");
  LogWriter log("/dev/null");
  EXPECT_THROW(record_drive(scene, {}, {}, log), std::invalid_argument);
}

TEST(OdometryNoise, HasItsSigmas) {
  Odometry odometry({.position_m = 0.01, .angle_deg = 0.3}, random_key({1}));
  double square_m = 0;
  double square_rad = 0;
  constexpr int kPoses = 20'000;
  for (int i = 0; i < kPoses; ++i) {
    const Pose measured = odometry.measure(Pose::Identity());
    square_m += measured.translation().squaredNorm();
    square_rad += std::pow(Eigen::AngleAxisd(measured.linear()).angle(), 2);
  }
  EXPECT_NEAR(std::sqrt(square_m / (3 * kPoses)), 0.01, 0.0002);
  EXPECT_NEAR(std::sqrt(square_rad / (3 * kPoses)) * 180 / 3.14159265358979, 0.3, 0.006);
}

TEST(OdometryNoise, DriftGrowsWithTheWay) {
  double square_deg = 0;
  constexpr int kRuns = 200;
  double distance_m = 0;
  for (std::uint64_t seed = 1; seed <= kRuns; ++seed) {
    Odometry odometry({.drift_per_m = 0.02, .drift_deg_per_m = 1.0}, random_key({seed}));
    Pose measured = Pose::Identity();
    for (int i = 0; i <= 900; ++i) {
      Pose truth = Pose::Identity();
      truth.translation().x() = 0.01 * i;
      measured = odometry.measure(truth);
    }
    square_deg += std::pow(heading_of(measured) * 180 / 3.14159265358979, 2);
    distance_m += measured.translation().norm() / kRuns;
  }
  EXPECT_NEAR(std::sqrt(square_deg / kRuns), 3.0, 0.5);  // 1 degree per sqrt(m) over 9 m
  EXPECT_NEAR(distance_m, 9.0 * 1.02, 0.1);
}

}  // namespace
}  // namespace floornav
