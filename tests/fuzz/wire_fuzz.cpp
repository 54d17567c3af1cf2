// libFuzzer over everything that reads bytes from the wire. The first byte of an input says which reader: one
// of the message types, the depth codec, or a cloud's way to its pixels. What decode accepts must encode to
// the same bytes.

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "lcmtypes/depth_cloud.hpp"
#include "sample_messages.hpp"

using namespace floornav;
using Bytes = std::vector<std::uint8_t>;

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace {

void require(bool holds) {
  if (!holds) std::abort();
}

std::vector<std::unique_ptr<AnyMessage>>& types() {
  static auto all = every_message_type();
  return all;
}

void read_message(AnyMessage& type, const Bytes& bytes) {
  const int result = type.decode(bytes);
  if (result < 0) return;
  require(result == static_cast<int>(bytes.size()));
  require(type.encode() == bytes);
}

/// The first two bytes are the number of pixels.
void read_rvl(const Bytes& bytes) {
  if (bytes.size() < 2) return;
  std::vector<std::uint16_t> pixels(static_cast<std::size_t>(bytes[0]) << 8 | bytes[1]);
  const Bytes code(bytes.begin() + 2, bytes.end());
  try {
    decode_rvl(code, pixels);
  } catch (const CorruptDepth&) {
    return;
  }
  Bytes again;
  encode_rvl(pixels, again);
  require(again == code);
}

void read_cloud(const Bytes& bytes) {
  static depth_cloud_t cloud;
  static std::vector<std::uint16_t> pixels;
  if (!decodes(cloud, bytes)) return;
  try {
    unpack_pixels(cloud, pixels);
  } catch (const CorruptDepth&) {
    return;
  }
  require(pixels.size() == static_cast<std::size_t>(cloud.width * cloud.rows));
}

/// An input that its reader accepts.
Bytes whole_input(std::uint32_t seed) {
  const std::size_t reader = seed % (types().size() + 2);
  Bytes input{static_cast<std::uint8_t>(reader)};
  if (reader == types().size()) {
    const auto cloud = sample_message<depth_cloud_t>(seed);
    input.push_back(static_cast<std::uint8_t>((cloud.width * cloud.rows) >> 8));
    input.push_back(static_cast<std::uint8_t>(cloud.width * cloud.rows));
    input.insert(input.end(), cloud.data.begin(), cloud.data.end());
  } else {
    const bool is_cloud = reader > types().size();  // depth_cloud_t is the first type
    const Bytes bytes = types()[is_cloud ? 0 : reader]->sample(seed);
    input.insert(input.end(), bytes.begin(), bytes.end());
  }
  return input;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::size_t reader = *data % (types().size() + 2);
  const Bytes bytes(data + 1, data + size);
  if (reader < types().size())
    read_message(*types()[reader], bytes);
  else if (reader == types().size())
    read_rvl(bytes);
  else
    read_cloud(bytes);
  return 0;
}

/// Now and then starts again from a whole message, so that no corpus need be stored.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned int seed) {
  if (size < 2 || seed % 64 == 0) {
    const Bytes whole = whole_input(seed / 64);
    if (whole.size() <= max_size) {
      std::copy(whole.begin(), whole.end(), data);
      return whole.size();
    }
  }
  return LLVMFuzzerMutate(data, size, max_size);
}
