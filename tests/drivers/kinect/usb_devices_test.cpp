#include "drivers/kinect/node/usb_devices.hpp"

#include <fstream>

#include <gtest/gtest.h>
#include <unistd.h>

#include "tests/tools/temporary_folder.hpp"

namespace floornav {
namespace {

class UsbDevices : public testing::Test {
 protected:
  void plug(const char* place, const char* vendor, const char* product) {
    std::filesystem::create_directories(folder / place);
    write_file(folder / place / "idVendor", std::string(vendor) + "\n");
    write_file(folder / place / "idProduct", std::string(product) + "\n");
  }
  const TemporaryFolder folder;
};

TEST_F(UsbDevices, AKinectWithoutDriverIsNamedWithWhatItNeeds) {
  plug("1-1", "1d6b", "0002");
  plug("1-1.4", "045e", "02ae");
  const std::string hint = usb_camera_hint(folder.path());
  EXPECT_NE(hint.find("Kinect for Xbox 360"), std::string::npos) << hint;
  EXPECT_NE(hint.find("libFreenectDriver.so.0"), std::string::npos) << hint;
}

TEST_F(UsbDevices, AKinectOnUsbPowerAloneIsTold) {
  plug("1-1.4", "045e", "02b0");
  EXPECT_NE(usb_camera_hint(folder.path()).find("power supply"), std::string::npos);
}

TEST_F(UsbDevices, OthersAreNoCameras) {
  plug("1-1", "1d6b", "0002");
  std::filesystem::create_directories(folder / "1-1:1.0");  // an interface has no idVendor
  EXPECT_EQ(usb_camera_hint(folder.path()), "");
}

TEST_F(UsbDevices, AMachineWithoutUsbHasNone) {
  EXPECT_EQ(usb_camera_hint(folder / "nowhere"), "");
}

}  // namespace
}  // namespace floornav
