#include <fstream>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "tests/tools/run_program.hpp"
#include "tests/tools/temporary_folder.hpp"

namespace floornav {
namespace {

/// Runs floornav-import and expects one line on stderr, a non-zero exit, and no log.
class ImportCommand : public testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directory(folder_ / "depth");
    std::filesystem::create_directory(folder_ / "empty");
    cv::imwrite((folder_ / "depth/0.png").string(), cv::Mat(48, 64, CV_16UC1, cv::Scalar(1000)));
  }
  [[nodiscard]] std::string path(const std::string& name) const { return (folder_ / name).string(); }
  [[nodiscard]] std::vector<std::string> depth_command(const std::string& folder,
                                                       const std::string& intrinsics) const {
    return {"floornav-import",
            "depth",
            path(folder),
            "-o",
            path("out.lcm"),
            "--intrinsics",
            intrinsics,
            "--height",
            "0.5",
            "--pitch",
            "20",
            "--roll",
            "0"};
  }
  void expect_refused(const std::vector<std::string>& words, const std::string& what) const {
    const Outcome outcome = run_program(words);
    EXPECT_GT(outcome.exit_code, 0) << what;
    EXPECT_EQ(outcome.lines_of_err(), 1) << outcome.err;
    EXPECT_NE(outcome.err.find(what), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path()))
      EXPECT_EQ(entry.path().filename().string().find("out.lcm"), std::string::npos) << entry.path();
  }
  TemporaryFolder folder_;
};

TEST_F(ImportCommand, WritesTheLogAndSaysWhatIsInIt) {
  const Outcome outcome = run_program(depth_command("depth", "50,50,32,24"));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, path("out.lcm") + ": 1 clouds and 1 poses of 0.0 s\n");
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out.lcm"));
}

TEST_F(ImportCommand, HasHelpWithAnExampleForEverySubCommand) {
  for (const char* sub : {"tum", "depth", "pcd", "stereo"}) {
    const Outcome outcome = run_program({"floornav-import", sub, "--help"});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_NE(outcome.out.find(std::string("floornav-import ") + sub), std::string::npos);
  }
}

TEST_F(ImportCommand, RefusesWrongInputInOneLine) {
  write_file(folder_ / "random.pcd", std::string(5000, 'x'));
  expect_refused({"floornav-import"}, "subcommand");
  expect_refused(depth_command("absent", "50,50,32,24"), "absent");
  expect_refused(depth_command("empty", "50,50,32,24"), "empty");
  expect_refused(
      {"floornav-import", "tum", path("empty"), "-o", path("out.lcm"), "--intrinsics", "50,50,32,24"},
      "depth.txt");
  expect_refused({"floornav-import", "pcd", path("random.pcd"), "-o", path("out.lcm"), "--height", "1",
                  "--pitch", "0", "--roll", "0"},
                 "random.pcd");
  expect_refused({"floornav-import", "pcd", path("absent.pcd"), "-o", path("out.lcm"), "--height", "1",
                  "--pitch", "0", "--roll", "0"},
                 "absent.pcd");
}

TEST_F(ImportCommand, RefusesAbsurdIntrinsicsInOneLine) {
  for (const char* intrinsics : {"-50,50,32,24", "nan,50,32,24", "50,inf,32,24", "0,50,32,24", "50,50,320,24",
                                 "50,50,32,-240", "50,50,32", "50,50,32,24,1", "a,b,c,d", ""})
    expect_refused(depth_command("depth", intrinsics), "ntrinsics");
}

TEST_F(ImportCommand, RefusesADamagedImageAndAnotherSizeMidWay) {
  cv::imwrite(path("depth/1.png"), cv::Mat(24, 32, CV_16UC1, cv::Scalar(1000)));
  expect_refused(depth_command("depth", "50,50,32,24"), "1.png");
  const std::string whole = file_content(folder_ / "depth/0.png");
  write_file(folder_ / "depth/1.png", whole.substr(0, whole.size() / 2));
  expect_refused(depth_command("depth", "50,50,32,24"), "1.png");
}

TEST_F(ImportCommand, RefusesAPlaceWhereItCannotWrite) {
  auto words = depth_command("depth", "50,50,32,24");
  words[4] = path("no/such/folder/out.lcm");
  expect_refused(words, "no/such/folder");
}

TEST_F(ImportCommand, KeepsAnEarlierLogWhereItFails) {
  ASSERT_EQ(run_program(depth_command("depth", "50,50,32,24")).exit_code, 0);
  const std::string before = file_content(folder_ / "out.lcm");
  EXPECT_NE(run_program(depth_command("empty", "50,50,32,24")).exit_code, 0);
  EXPECT_EQ(file_content(folder_ / "out.lcm"), before);
}

TEST_F(ImportCommand, RefusesStereoPairsThatDoNotGoTogether) {
  const auto command = [&](const std::string& right, const std::string& calibration) {
    return std::vector<std::string>{
        "floornav-import", "stereo",   path("depth"), path(right), "-o", path("out.lcm"), "--calibration",
        path(calibration), "--height", "0.5",         "--pitch",   "20", "--roll",        "0"};
  };
  std::ofstream(path("good.yaml")) << "%YAML:1.0\nimage_size: [640, 480]\n"
                                      "M1: [520, 0, 320, 0, 520, 240, 0, 0, 1]\nD1: [0, 0, 0, 0]\n"
                                      "M2: [520, 0, 320, 0, 520, 240, 0, 0, 1]\nD2: [0, 0, 0, 0]\n"
                                      "R: [1, 0, 0, 0, 1, 0, 0, 0, 1]\nT: [-0.12, 0, 0]\n";
  std::ofstream(path("swapped.yaml")) << "%YAML:1.0\nimage_size: [640, 480]\n"
                                         "M1: [520, 0, 320, 0, 520, 240, 0, 0, 1]\nD1: [0, 0, 0, 0]\n"
                                         "M2: [520, 0, 320, 0, 520, 240, 0, 0, 1]\nD2: [0, 0, 0, 0]\n"
                                         "R: [1, 0, 0, 0, 1, 0, 0, 0, 1]\nT: [0.12, 0, 0]\n";
  expect_refused(command("depth", "none.yaml"), "none.yaml: cannot be opened");
  expect_refused(command("depth", "swapped.yaml"), "swapped");
  expect_refused(command("depth", "good.yaml"),
                 "0.png: image is 64 x 48 px, the calibration is for 640 x 480");
  expect_refused(command("empty", "good.yaml"), "empty: holds no");
}

}  // namespace
}  // namespace floornav
