#include "drivers/kinect/node/usb_devices.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <string_view>
#include <system_error>
#include <vector>

#include <fmt/format.h>

namespace floornav {
namespace {

struct KnownCamera {
  std::string_view id;  // vendor:product
  const char* name;
  const char* needs;
};

constexpr const char* kFreenect =
    "OpenNI2 needs libfreenect's driver for it, libFreenectDriver.so.0 in OpenNI2/Drivers "
    "(drivers/kinect/README.md says "
    "how, step by step)";
constexpr const char* kPermission =
    "OpenNI2's own driver knows it but has not opened it: is libopenni2-0's udev rule in force (plug it in "
    "again), and "
    "is no other program using it?";

constexpr std::array<KnownCamera, 8> kKnown = {{
    {"045e:02ae", "A Kinect for Xbox 360", kFreenect},
    {"045e:02bf", "A Kinect for Windows", kFreenect},
    {"045e:02b0", "The motor of a Kinect, but not its camera,",
     "the camera needs the Kinect's own power supply"},
    {"045e:02c2", "The motor of a Kinect, but not its camera,",
     "the camera needs the Kinect's own power supply"},
    {"045e:02c4", "A Kinect 2", "OpenNI2 has no driver for it in Debian: libfreenect2 brings one"},
    {"1d27:0600", "An Asus Xtion", kPermission},
    {"1d27:0601", "An Asus Xtion Pro Live", kPermission},
    {"1d27:0609", "A PrimeSense Carmine", kPermission},
}};

std::string first_line(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  return line;
}

}  // namespace

std::string usb_camera_hint(const std::filesystem::path& usb_devices) {
  std::vector<std::string> found;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(usb_devices, error))
    found.push_back(first_line(entry.path() / "idVendor") + ":" + first_line(entry.path() / "idProduct"));
  for (const KnownCamera& camera : kKnown)
    if (std::find(found.begin(), found.end(), camera.id) != found.end())
      return fmt::format("{} is plugged in (USB {}): {}", camera.name, camera.id, camera.needs);
  return "";
}

}  // namespace floornav
