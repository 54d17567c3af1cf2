#include "tests/devices/firewire/bus/iidc_camera.hpp"

#include <array>
#include <bit>
#include <cstring>
#include <random>

namespace floornav {
namespace {

constexpr std::uint32_t kRom = 0x400;
constexpr std::uint32_t kCommands = 0xF00000;
constexpr std::uint32_t kModes = 0x30000;     // Format_7 registers, 0x400 a mode
constexpr std::uint32_t kAbsolute = 0x40000;  // absolute values of features, 0x10 each
constexpr std::uint32_t kPresent = 0x80000000;

// Registers of a Format_7 mode.
constexpr std::uint32_t kMaxSize = 0x00, kUnitSize = 0x04, kPosition = 0x08, kSize = 0x0C, kCoding = 0x10,
                        kCodings = 0x14, kPixels = 0x34, kBytesHigh = 0x38, kBytesLow = 0x3C,
                        kPacketRange = 0x40, kPacketBytes = 0x44, kPackets = 0x48, kUnitPosition = 0x4C,
                        kValueSetting = 0x7C;
// IIDC's command registers.
constexpr std::uint32_t kMode = 0x604, kIsoChannel = 0x60C, kIsoOn = 0x614, kShutter = 7, kGain = 8,
                        kPan = 0x884;
// Point Grey's.
constexpr std::uint32_t kBayer = 0x1040, kByteOrder = 0x1048, kFrameInfo = 0x12F8, kSensor = 0x1F28,
                        kCalibrationBytes = 0x1FFC, kCalibration = 0x2000;

constexpr std::uint32_t kMono8 = 0, kRgb8 = 4, kMono16 = 5, kRaw8 = 9, kRaw16 = 10;

void add_leaf(std::vector<std::uint32_t>& rom, const char* text) {
  const std::size_t letters = std::strlen(text);
  const std::size_t quadlets = (letters + 3) / 4;
  rom.push_back(static_cast<std::uint32_t>(quadlets + 2) << 16);
  rom.insert(rom.end(), 2, 0);  // minimal ASCII
  for (std::size_t i = 0; i < 4 * quadlets; i += 4) {
    std::uint32_t four = 0;
    for (std::size_t k = i; k < i + 4; ++k)
      four = four << 8 | (k < letters ? static_cast<std::uint8_t>(text[k]) : 0U);
    rom.push_back(four);
  }
}

std::vector<std::uint32_t> config_rom(bool xb3) {
  std::vector<std::uint32_t> rom = {
      0x04040000, 0x31333934, 0x00FF8102, 0x00B09D01, xb3 ? 0x00A1B2C3U : 0x00A1B2C2U,
      0x00020000, 0x0300B09D, 0xD1000001,               // root: vendor, unit
      0x00030000, 0x1200A02D, 0x13000102, 0xD4000001};  // unit: IIDC
  const std::size_t directory = rom.size();
  rom.insert(rom.end(), {0x00040000, 0x40000000 | kCommands / 4, 0x81000000, 0x82000000, 0x38000010});
  const auto point = [&](std::size_t entry) { rom[entry] |= static_cast<std::uint32_t>(rom.size() - entry); };
  point(directory + 2);
  add_leaf(rom, "Point Grey Research");
  point(directory + 3);
  add_leaf(rom, xb3 ? "Bumblebee XB3 BBX3-13S2C" : "Bumblebee2 BB2-03S2M");
  rom.resize(256);
  return rom;
}

}  // namespace

IidcCamera::IidcCamera(const SeenEyes& scene, FirewireControl& control)
    : scene_(scene), control_(control), rom_(config_rom(is_xb3())) {
  add_formats();
  add_features();
  add_own_registers();
}

void IidcCamera::add_formats() {
  auto& r = registers_;
  const auto size = static_cast<std::uint32_t>(scene_.header().width) << 16 |
                    static_cast<std::uint32_t>(scene_.header().height);
  r[0x000] = 0;
  r[0x100] = 0x01000000;  // Format_7 alone
  r[0x19C] = 0x90000000;  // its modes 0 and 3
  r[0x400] = kPresent | (is_xb3() ? 0x00800000U : 0U) | 0x00008000U | 1U;
  r[0x480] = (kCommands + 0x1000) / 4;
  for (const std::uint32_t at : {0x600U, kMode, 0x608U, kIsoChannel, 0x610U, kIsoOn, 0x624U, 0x630U})
    r[at] = 0;
  r[kMode] = 3U << 29;
  r[0x608] = 7U << 29;
  r[kIsoChannel] = 0x02000000;
  r[0x610] = kPresent;
  r[0x630] = 8U << 24;
  for (const std::uint32_t mode : {0U, 3U}) {
    const std::uint32_t base = kModes + 0x400 * mode;
    r[0x2E0 + 4 * mode] = (kCommands + base) / 4;
    r[base + kMaxSize] = r[base + kSize] = size;
    r[base + kUnitSize] = mode == 3 ? size : 8U << 16 | 2U;
    r[base + kPosition] = 0;
    r[base + kCoding] = (mode == 3 ? kMono16 : kMono8) << 24;
    const auto offered = [](std::uint32_t coding) { return kPresent >> coding; };
    r[base + kCodings] = mode == 0 ? offered(kMono8) | offered(kRaw8)
                                   : offered(kMono16) | offered(kRaw16) | (is_xb3() ? offered(kRgb8) : 0U);
    r[base + kPacketRange] = 4U << 16 | (is_xb3() ? 8188U : 4096U);
    r[base + kPacketBytes] = 4096U << 16 | 4096U;
    r[base + kUnitPosition] = 0x00020002;
    r[base + kValueSetting] = kPresent;
    for (const std::uint32_t at : {kPixels, kBytesHigh, kBytesLow, kPackets}) r[base + at] = 0;
    r[base + 0x54] = 8U << 24;
    r[base + 0x58] = 1U << 24;
  }
}

void IidcCamera::add_features() {
  constexpr std::uint32_t kAutomatic = 0x02000000;
  constexpr std::uint32_t kOffered = kPresent | 0x40000000 | 0x0F000000 | 0x3FF;
  auto& r = registers_;
  r[0x404] = 0xD1810000;  // brightness, exposure, white balance, shutter, gain, frame rate
  r[0x408] = 0x40000000;  // pan
  for (const std::uint32_t feature : {0U, 1U, 3U, kShutter, kGain, 15U}) {
    const bool fixed = feature == kGain && control_.without_automatic_gain != 0;
    r[0x500 + 4 * feature] = fixed ? kOffered & ~kAutomatic : kOffered;
    r[0x800 + 4 * feature] = kPresent | 0x02000000 | (fixed ? 0U : 0x01000000U) | 0x100;
    tell_exposure(0x800 + 4 * feature, r[0x800 + 4 * feature]);
    const std::uint32_t absolute = kAbsolute + 0x10 * feature;
    r[0x700 + 4 * feature] = (kCommands + absolute) / 4;
    const std::array<float, 3> range =
        feature == kShutter ? std::array{1e-5F, 0.5F, 0.008F} : std::array{-6.0F, 24.0F, 6.0F};
    for (std::uint32_t i = 0; i < 3; ++i) r[absolute + 4 * i] = std::bit_cast<std::uint32_t>(range[i]);
  }
  r[0x584] = kPresent | 0x01000000 | 2;
  r[kPan] = kPresent | 0x02000000;
}

void IidcCamera::add_own_registers() {
  auto& r = registers_;
  const auto& letters = scene_.header().bayer;
  for (const char letter : letters) r[kBayer] = r[kBayer] << 8 | static_cast<std::uint8_t>(letter);
  const bool mono = letters[0] == 'Y';
  r[kByteOrder] = kPresent | 1;
  r[kFrameInfo] = control_.without_stamps != 0 ? 0 : kPresent;
  r[kSensor] = (scene_.header().width == 1280   ? 0xEU
                : scene_.header().width == 1024 ? 0xCU
                                                : 0xAU) |
               (mono ? 1U : 0U);
  r[kCalibrationBytes] =
      control_.without_calibration != 0 ? 0 : static_cast<std::uint32_t>(scene_.calibration().size());
}

std::uint32_t IidcCamera::value(std::uint32_t at) const {
  const auto found = registers_.find(at);
  return found == registers_.end() ? 0 : found->second;
}

std::uint32_t IidcCamera::mode_base() const {
  return kModes + 0x400 * (value(kMode) >> 29);
}

int IidcCamera::bytes_per_pixel(std::uint32_t base) const {
  switch (value(base + kCoding) >> 24) {
    case kRgb8:
      return 3;
    case kMono16:
    case kRaw16:
      return 2;
    default:
      return 1;
  }
}

std::uint32_t IidcCamera::frame_bytes(std::uint32_t base) const {
  const std::uint32_t size = value(base + kSize);
  return (size >> 16) * (size & 0xFFFFU) * static_cast<std::uint32_t>(bytes_per_pixel(base));
}

std::uint32_t IidcCamera::packets(std::uint32_t base) const {
  const std::uint32_t each = value(base + kPacketBytes) >> 16;
  return each == 0 ? 0 : (frame_bytes(base) + each - 1) / each;
}

std::optional<std::uint32_t> IidcCamera::read(std::uint64_t offset) const {
  const std::scoped_lock lock(mutex_);
  if (control_.random_registers != 0 && offset >= kCommands) {
    static std::mt19937 random(1);
    return random();
  }
  if (offset >= kRom && offset < kRom + 4 * rom_.size()) return rom_[(offset - kRom) / 4];
  if (offset < kCommands || offset - kCommands > 0xFFFFFFF) return std::nullopt;
  const auto at = static_cast<std::uint32_t>(offset - kCommands);
  const std::string_view text = scene_.calibration();
  if (at >= kCalibration && at < kCalibration + text.size()) {
    std::uint32_t four = 0;
    for (std::uint32_t i = at - kCalibration; i < at - kCalibration + 4; ++i)
      four = four << 8 | (i < text.size() ? static_cast<std::uint8_t>(text[i]) : 0U);
    return four;
  }
  const auto found = registers_.find(at);
  if (found == registers_.end()) return std::nullopt;
  if (at < kModes || at >= kModes + 0x1000) return found->second;
  const std::uint32_t base = at & ~0x3FFU;
  switch (at - base) {
    case kPixels:
      return (value(base + kSize) >> 16) * (value(base + kSize) & 0xFFFFU);
    case kBytesLow:
      return frame_bytes(base);
    case kPackets:
      return packets(base);
    default:
      return found->second;
  }
}

bool IidcCamera::write(std::uint64_t offset, std::uint32_t value) {
  const std::scoped_lock lock(mutex_);
  if (offset < kCommands || offset - kCommands > 0xFFFFFFF) return false;
  const auto at = static_cast<std::uint32_t>(offset - kCommands);
  const auto found = registers_.find(at);
  if (found == registers_.end()) return false;
  if (at >= 0x800 && at < 0x900) value |= kPresent;
  if (at == kByteOrder || (at == kFrameInfo && found->second != 0)) value |= kPresent;
  if (at >= kModes && at < kModes + 0x1000) {
    const std::uint32_t of_mode = at & 0x3FFU;
    if (of_mode == kValueSetting) value = kPresent;
    if (of_mode == kPacketBytes) value = (value & 0xFFFF0000U) | (found->second & 0xFFFFU);
  }
  found->second = value;
  tell_exposure(at, value);
  return true;
}

/// What a register of the exposure was set to, for whoever commands the bus.
void IidcCamera::tell_exposure(std::uint32_t at, std::uint32_t value) {
  constexpr std::uint32_t kAutomatic = 0x01000000;
  if (at == kAbsolute + 0x10 * kShutter + 8)
    control_.shutter = static_cast<std::int32_t>(1e6F * std::bit_cast<float>(value));
  if (at == kAbsolute + 0x10 * kGain + 8)
    control_.gain = static_cast<std::int32_t>(1e2F * std::bit_cast<float>(value));
  for (const std::uint32_t feature : {kShutter, kGain})
    if (at == 0x800 + 4 * feature) {
      const auto bit = std::int32_t{1} << feature;
      control_.automatic = (value & kAutomatic) != 0 ? control_.automatic | bit : control_.automatic & ~bit;
    }
}

void IidcCamera::stop() {
  const std::scoped_lock lock(mutex_);
  registers_[kIsoOn] = 0;
}

std::int64_t IidcCamera::shutter_us() const {
  const std::scoped_lock lock(mutex_);
  return static_cast<std::int64_t>(1e6F * std::bit_cast<float>(value(kAbsolute + 0x10 * kShutter + 8)));
}

Transmission IidcCamera::transmission() const {
  const std::scoped_lock lock(mutex_);
  const std::uint32_t base = mode_base();
  Transmission sent;
  sent.on = value(kIsoOn) >> 31 != 0;
  sent.channel = static_cast<int>(value(kIsoChannel) >> 28);
  sent.packet_bytes = static_cast<int>(value(base + kPacketBytes) >> 16);
  sent.packets = static_cast<int>(packets(base));
  sent.frame_bytes = frame_bytes(base);
  sent.stamped = (value(kFrameInfo) & 0x41U) == 0x41U;
  const int eyes = bytes_per_pixel(base);
  const bool narrow = is_xb3() && (value(kPan) & 0xFFFU) == 1;
  const int left = narrow ? 1 : scene_.header().eyes - 1;
  if (eyes == 3) sent.eyes = {0, 1, 2};
  if (eyes == 1) sent.eyes = {0};
  if (eyes == 2) sent.eyes = (value(kByteOrder) & 1U) == 0 ? std::vector{0, left} : std::vector{left, 0};
  return sent;
}

}  // namespace floornav
