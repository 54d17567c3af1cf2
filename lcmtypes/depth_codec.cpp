#include "lcmtypes/depth_codec.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

namespace floornav {
namespace {

// Both directions handle a chain as a whole, held with its first nibble lowest: bits 0..2 the number's
// lowest, bit 3 set where the chain goes on. A chain has at most 8 nibbles, so a number at most 24 bits.
constexpr std::uint64_t kChainBits = 0x8888'8888'8888'8888;
constexpr std::uint32_t kLongestChain = 32;  // bits

constexpr std::size_t kMostBytesPerPixel = 3;  // a difference has 17 bits: 6 nibbles

/// A word of the stream, first nibble in the top bits, to and from first nibble in the lowest.
std::uint32_t reverse_nibbles(std::uint32_t word) {
  word = ((word >> 4) & 0x0F0F'0F0F) | ((word & 0x0F0F'0F0F) << 4);
  word = ((word >> 8) & 0x00FF'00FF) | ((word & 0x00FF'00FF) << 8);
  return (word >> 16) | (word << 16);
}

/// Puts the number's groups of 3 bits into nibbles.
std::uint32_t spread(std::uint32_t number) {
  std::uint32_t x = (number & 0xFFF) | ((number & 0xFF'F000) << 4);
  x = (x & 0x003F'003F) | ((x & 0x0FC0'0FC0) << 2);
  return (x & 0x0707'0707) | ((x & 0x3838'3838) << 1);
}

/// The inverse of spread; chain bits are dropped.
std::uint32_t gather(std::uint32_t chain) {
  std::uint32_t x = (chain & 0x0707'0707) | ((chain & 0x7070'7070) >> 1);
  x = (x & 0x003F'003F) | ((x & 0x3F00'3F00) >> 2);
  return (x & 0xFFF) | ((x & 0x0FFF'0000) >> 4);
}

std::uint32_t fold(std::int32_t difference) {
  return (static_cast<std::uint32_t>(difference) << 1) ^ static_cast<std::uint32_t>(difference >> 31);
}

std::int32_t unfold(std::uint32_t number) {
  return static_cast<std::int32_t>(number >> 1) ^ -static_cast<std::int32_t>(number & 1);
}

/// The nibbles of a number as the stream has them, first nibble highest.
struct Chain {
  std::uint32_t nibbles = 0;
  std::uint32_t bits = 0;
};

Chain chain_of(std::uint32_t number) {
  const auto count = std::max(1U, (static_cast<std::uint32_t>(std::bit_width(number)) + 2) / 3);
  const std::uint64_t followed = (std::uint64_t{1} << (4 * (count - 1))) - 1;
  const auto chain = static_cast<std::uint32_t>(spread(number) | (kChainBits & followed));
  return {reverse_nibbles(chain) >> (32 - 4 * count), 4 * count};
}

/// Chains of the numbers that nearly all differences are.
const std::array<Chain, 1024>& short_chains() {
  static const std::array<Chain, 1024> kChains = [] {
    std::array<Chain, 1024> chains;
    for (std::uint32_t number = 0; number < chains.size(); ++number) chains[number] = chain_of(number);
    return chains;
  }();
  return kChains;
}

class NibbleWriter {
 public:
  explicit NibbleWriter(std::uint8_t* out) : out_(out) {}

  void write(std::uint32_t number) {
    const Chain chain = number < short_chains_.size() ? short_chains_[number] : chain_of(number);
    pending_ = pending_ << chain.bits | chain.nibbles;
    bits_ += chain.bits;
    put_word();  // a whole one or not: whether one is ready is hard to predict
    out_ += std::size_t{4} * (bits_ / 32);
    bits_ %= 32;
  }

  /// Fills the last word with zeros; returns the end of what was written.
  std::uint8_t* finish() {
    if (bits_ == 0) return out_;
    pending_ <<= 32 - bits_;
    bits_ = 32;
    put_word();
    return out_ + 4;
  }

 private:
  /// The 32 bits above those that remain.
  void put_word() {
    const auto word = static_cast<std::uint32_t>(pending_ >> (bits_ % 32));
    for (int byte = 0; byte < 4; ++byte) out_[byte] = static_cast<std::uint8_t>(word >> (8 * byte));
  }

  const std::array<Chain, 1024>& short_chains_ = short_chains();
  std::uint8_t* out_;
  std::uint64_t pending_ = 0;  // the lowest bits_ bits, last nibble lowest; what is above was written
  std::uint32_t bits_ = 0;     // below 32 between calls
};

/// Pixels that a look at the next nibbles of the stream settles at once.
constexpr std::size_t kMostAtOnce = 3;

/// The differences that lie whole in the next three nibbles: nearly always one or more.
struct ShortDifferences {
  std::array<std::int16_t, kMostAtOnce> sum{};  ///< of the first, of two, of three; then the last again
  std::uint8_t count = 0;
  std::uint8_t bits = 0;  ///< of the stream, for all of them
};

ShortDifferences short_differences(std::uint32_t nibbles) {
  ShortDifferences found;
  std::int32_t sum = 0;
  for (std::uint32_t length = 4; found.bits + length <= 12;) {
    const std::uint32_t chain = nibbles >> found.bits & ((1U << length) - 1);
    const std::uint32_t last = chain >> (length - 4);
    if ((last & 8) != 0) {
      length += 4;
      continue;
    }
    if (length > 4 && last == 0) break;  // padded
    sum += unfold(gather(chain));
    std::fill(found.sum.begin() + found.count, found.sum.end(), static_cast<std::int16_t>(sum));
    ++found.count;
    found.bits = static_cast<std::uint8_t>(found.bits + length);
    length = 4;
  }
  return found;
}

const std::array<ShortDifferences, 4096>& all_short_differences() {
  static const std::array<ShortDifferences, 4096> kAll = [] {
    std::array<ShortDifferences, 4096> all;
    for (std::uint32_t nibbles = 0; nibbles < all.size(); ++nibbles)
      all[nibbles] = short_differences(nibbles);
    return all;
  }();
  return kAll;
}

bool is_pixel(std::int32_t value) {
  return value >= 1 && value <= 0xFFFF;
}

class NibbleReader {
 public:
  explicit NibbleReader(std::span<const std::uint8_t> code) : next_(code.data()), end_(next_ + code.size()) {}

  std::uint32_t read() {
    if (bits_ < kLongestChain) refill();
    const auto length = static_cast<std::uint32_t>(std::countr_zero(~pending_ & kChainBits)) + 1;
    if (length > kLongestChain) throw CorruptDepth("depth code has a number that is too long");
    if (length > bits_) throw CorruptDepth("depth code ends in the middle");
    const std::uint64_t chain = pending_ & ((std::uint64_t{1} << length) - 1);
    // One comparison for "of several nibbles, the last is 0": how long chains are is hard to predict.
    if ((chain << 4 >> length) < static_cast<std::uint64_t>(length > 4))
      throw CorruptDepth("depth code has a padded number");
    pending_ >>= length;
    bits_ -= length;
    return gather(static_cast<std::uint32_t>(chain));
  }

  /// Reads the differences that the next three nibbles hold, each to be added to the pixel before. Returns
  /// how many pixels that makes: none where the first difference is longer, or corrupt, or the code ends, or
  /// a pixel would be out of range. `previous` becomes the last pixel; kMostAtOnce are written in any case.
  std::size_t read_short(std::int32_t& previous, std::uint16_t* pixels) {
    if (bits_ < kLongestChain) refill();
    const ShortDifferences& next = short_differences_[pending_ & 0xFFF];
    bool is_fine = next.bits <= bits_;
    for (std::size_t i = 0; i < kMostAtOnce; ++i) {
      const std::int32_t value = previous + next.sum[i];
      is_fine = static_cast<bool>(static_cast<int>(is_fine) & static_cast<int>(is_pixel(value)));
      pixels[i] = static_cast<std::uint16_t>(value);
    }
    if (!is_fine) return 0;
    pending_ >>= next.bits;
    bits_ -= next.bits;
    previous += next.sum.back();
    return next.count;
  }

  /// Throws unless all that is left is the zeros that fill the last word.
  void finish() const {
    if (next_ != end_ || bits_ >= 32 || pending_ != 0)
      throw CorruptDepth("depth code goes on after its last pixel");
  }

 private:
  void refill() {
    if (next_ == end_) return;
    std::uint32_t word = 0;
    for (int byte = 0; byte < 4; ++byte) word |= static_cast<std::uint32_t>(*next_++) << (8 * byte);
    pending_ |= static_cast<std::uint64_t>(reverse_nibbles(word)) << bits_;
    bits_ += 32;
  }

  const std::array<ShortDifferences, 4096>& short_differences_ = all_short_differences();
  const std::uint8_t* next_;
  const std::uint8_t* end_;
  std::uint64_t pending_ = 0;  // first nibble lowest; zeros above bits_
  std::uint32_t bits_ = 0;     // of pending_
};

}  // namespace

void encode_rvl(std::span<const std::uint16_t> pixels, std::vector<std::uint8_t>& code) {
  if (pixels.size() > kMostDepthPixels) throw std::length_error("depth image of more than 2^24 - 1 pixels");
  code.resize(kMostBytesPerPixel * pixels.size() + 8);
  NibbleWriter writer(code.data());
  const auto is_zero = [](std::uint16_t pixel) { return pixel == 0; };
  std::int32_t previous = 0;
  for (auto next = pixels.begin(); next != pixels.end();) {
    const auto run = std::find_if_not(next, pixels.end(), is_zero);
    const auto run_end = std::find_if(run, pixels.end(), is_zero);
    writer.write(static_cast<std::uint32_t>(run - next));
    writer.write(static_cast<std::uint32_t>(run_end - run));
    for (next = run; next != run_end; ++next) {
      writer.write(fold(*next - previous));
      previous = *next;
    }
  }
  code.resize(static_cast<std::size_t>(writer.finish() - code.data()));
}

namespace {

/// Pixels that are not 0; `previous` is the last one before them, then the last one of them.
void decode_run(NibbleReader& reader, std::span<std::uint16_t> run, std::int32_t& previous) {
  for (std::size_t i = 0; i < run.size();) {
    const std::size_t count = i + kMostAtOnce <= run.size() ? reader.read_short(previous, run.data() + i) : 0;
    i += count;
    if (count > 0) continue;
    previous += unfold(reader.read());
    if (!is_pixel(previous)) throw CorruptDepth("depth code leaves the range of a pixel");
    run[i++] = static_cast<std::uint16_t>(previous);
  }
}

}  // namespace

void decode_rvl(std::span<const std::uint8_t> code, std::span<std::uint16_t> pixels) {
  if (code.size() % 4 != 0) throw CorruptDepth("depth code is not made of 32-bit words");
  NibbleReader reader(code);
  std::int32_t previous = 0;
  for (auto left = pixels; !left.empty();) {
    const std::size_t zeros = reader.read();
    if (zeros > left.size()) throw CorruptDepth("depth code has more pixels than the image");
    if (zeros == 0 && left.size() < pixels.size()) throw CorruptDepth("depth code has an empty run");
    std::fill_n(left.begin(), zeros, std::uint16_t{0});
    left = left.subspan(zeros);
    const std::size_t others = reader.read();
    if (others > left.size()) throw CorruptDepth("depth code has more pixels than the image");
    if (others == 0 && !left.empty()) throw CorruptDepth("depth code has an empty run");
    decode_run(reader, left.first(others), previous);
    left = left.subspan(others);
  }
  reader.finish();
}

void encode_raw16(std::span<const std::uint16_t> pixels, std::vector<std::uint8_t>& code) {
  code.resize(2 * pixels.size());
  std::uint8_t* out = code.data();
  for (const std::uint16_t pixel : pixels) {
    *out++ = static_cast<std::uint8_t>(pixel);
    *out++ = static_cast<std::uint8_t>(pixel >> 8);
  }
}

void decode_raw16(std::span<const std::uint8_t> code, std::span<std::uint16_t> pixels) {
  if (code.size() != 2 * pixels.size()) throw CorruptDepth("raw depth is not two bytes a pixel");
  const std::uint8_t* in = code.data();
  for (std::uint16_t& pixel : pixels) {
    pixel = static_cast<std::uint16_t>(in[0] | in[1] << 8);
    in += 2;
  }
}

}  // namespace floornav
