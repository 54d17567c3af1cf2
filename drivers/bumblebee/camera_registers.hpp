#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace floornav {

/// Point Grey's own registers, offsets from the camera's command base.
namespace camera_register {
inline constexpr std::uint32_t kPan = 0x884;            ///< which eyes of an XB3
inline constexpr std::uint32_t kBayerPattern = 0x1040;  ///< four letters, "YYYY": mono
inline constexpr std::uint32_t kByteOrder = 0x1048;     ///< of 16-bit formats
inline constexpr std::uint32_t kFrameInfo = 0x12F8;     ///< what the first pixels of a frame tell
inline constexpr std::uint32_t kSensorType = 0x1F28;
inline constexpr std::uint32_t kCalibrationBytes = 0x1FFC;
inline constexpr std::uint32_t kCalibration = 0x2000;  ///< text from here on
}  // namespace camera_register

/// Values for them.
inline constexpr std::uint32_t kRightEyeFirst = 0x80000000;    ///< kByteOrder: even bytes are the right eye's
inline constexpr std::uint32_t kStampAndCounter = 0x80000041;  ///< kFrameInfo
inline constexpr std::uint32_t kWidePair = 0x82000000;         ///< kPan
inline constexpr std::uint32_t kNarrowPair = 0x82000001;       ///< kPan

/// What is behind the lenses.
struct SensorType {
  int width = 0;   ///< px
  int height = 0;  ///< px
  bool color = false;
};

/// Of the register's value; nothing for a sensor that no Bumblebee has.
std::optional<SensorType> sensor_type_of(std::uint32_t value);

/// The four letters of a register's value, "GBRG" say; '?' for what is no capital letter.
std::string bayer_pattern_of(std::uint32_t value);

/// Bytes of each 8 kHz isochronous packet for at least so many frames a second, a multiple of 4. 8192 would
/// overflow a field of 16 bits in libdc1394; the bus allows 4096 at 400 Mbit/s and 8188 at 800. Throws
/// std::runtime_error where the rate asks for more.
int packet_bytes_for(double frames_per_second, std::int64_t frame_bytes, int iso_speed_mbps);

/// How long a frame takes on the bus, us.
std::int64_t transfer_us(std::int64_t frame_bytes, int packet_bytes);

}  // namespace floornav
