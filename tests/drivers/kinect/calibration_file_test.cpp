#include "drivers/kinect/node/calibration_file.hpp"

#include <fstream>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

#include "runtime/process/settings_reader.hpp"
#include "tests/tools/temporary_folder.hpp"

namespace floornav {
namespace {

constexpr const char* kRos = R"(image_width: 640
image_height: 480
camera_name: depth_B00367707227042B
camera_matrix:
  rows: 3
  cols: 3
  data: [580.1, 0, 314.6, 0, 581.2, 251.4, 0, 0, 1]
distortion_model: plumb_bob
distortion_coefficients:
  rows: 1
  cols: 5
  data: [-0.08, 0.19, -0.001, 0.002, 0]
)";

class CalibrationFile : public testing::Test {
 protected:
  Calibration read(const std::string& text, int width = 640, int height = 480) {
    write_file(file, text);
    return read_calibration(file, width, height);
  }
  static std::string with(const std::string& from, const std::string& to) {
    std::string text = kRos;
    return text.replace(text.find(from), from.size(), to);
  }
  std::filesystem::path file = std::filesystem::temp_directory_path() /
                               ("floornav-calibration-" + std::to_string(::getpid()) + ".yaml");
};

TEST_F(CalibrationFile, IsReadAsRosWritesIt) {
  const Calibration c = read(kRos);
  EXPECT_FLOAT_EQ(c.camera.fx, 580.1F);
  EXPECT_FLOAT_EQ(c.camera.fy, 581.2F);
  EXPECT_FLOAT_EQ(c.camera.cx, 314.6F);
  EXPECT_FLOAT_EQ(c.camera.cy, 251.4F);
  EXPECT_DOUBLE_EQ(c.distortion[0], -0.08);
  EXPECT_DOUBLE_EQ(c.distortion[3], 0.002);
}

TEST_F(CalibrationFile, IsScaledToTheImage) {
  const Calibration c = read(kRos, 320, 240);
  EXPECT_FLOAT_EQ(c.camera.fx, 290.05F);
  EXPECT_FLOAT_EQ(c.camera.cx, (314.6F + 0.5F) / 2 - 0.5F);
}

TEST_F(CalibrationFile, WrongOnesAreRefusedWithTheFilesName) {
  for (const std::string& text :
       {std::string("hello"), std::string(), with("580.1", "wide"), with("580.1", ".nan"),
        with("580.1", "-580"), with("314.6", "3146"), with("640", "600"), with("640", "0"),
        with(", 0, 0, 1]", "]"), with("-0.08", "1e9"), with("image_width", "breadth")}) {
    try {
      read(text);
      ADD_FAILURE() << "taken: " << text;
    } catch (const SettingsError& e) {
      EXPECT_NE(std::string(e.what()).find(file.string()), std::string::npos) << e.what();
    }
  }
  EXPECT_THROW(read_calibration("/nowhere.yaml", 640, 480), SettingsError);
}

}  // namespace
}  // namespace floornav
