#include "tools/import/pcd_file.hpp"

#include <array>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <optional>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <lzf.h>

namespace floornav {

namespace {

using Bytes = std::vector<char>;

/// A coordinate's place among a point's fields.
struct Coordinate {
  std::size_t offset = 0;  ///< bytes before it in a point
  std::size_t word = 0;    ///< words before it in a line of an ascii file
  std::size_t size = 0;    ///< bytes: 4 or 8
};

struct Header {
  std::array<Coordinate, 3> xyz;
  std::size_t point_bytes = 0;
  std::size_t point_words = 0;
  std::size_t width = 0;
  std::size_t height = 0;
  std::string data;       ///< ascii, binary or binary_compressed
  std::size_t bytes = 0;  ///< of the header itself
  [[nodiscard]] std::size_t points() const { return width * height; }
};

struct Bad : std::runtime_error {
  using std::runtime_error::runtime_error;
};

std::vector<std::string> words_of(std::istringstream& line) {
  return {std::istream_iterator<std::string>(line), std::istream_iterator<std::string>()};
}

std::size_t number_in(const std::string& word, std::size_t most) {
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size() || value > most)
    throw Bad(fmt::format("\"{}\" in the header is no number up to {}", word, most));
  return value;
}

/// The lists FIELDS, SIZE, TYPE and COUNT, one entry a field.
struct FieldLists {
  std::vector<std::string> names;
  std::vector<std::string> sizes;
  std::vector<std::string> types;
  std::vector<std::string> counts;
};

void place_coordinates(const FieldLists& fields, Header& header) {
  constexpr std::size_t kMostBytes = 8;
  constexpr std::size_t kMostCount = 4096;
  const std::size_t n = fields.names.size();
  if (n == 0 || fields.sizes.size() != n || fields.types.size() != n ||
      (!fields.counts.empty() && fields.counts.size() != n))
    throw Bad("FIELDS, SIZE, TYPE and COUNT of the header differ in length");
  std::array<bool, 3> found{};
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t size = number_in(fields.sizes[i], kMostBytes);
    const std::size_t count = fields.counts.empty() ? 1 : number_in(fields.counts[i], kMostCount);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (fields.names[i] != std::string(1, "xyz"[axis])) continue;
      if (fields.types[i] != "F" || (size != 4 && size != 8) || count != 1)
        throw Bad("x, y and z must be floats of 4 or 8 bytes");
      header.xyz[axis] = {header.point_bytes, header.point_words, size};
      found[axis] = true;
    }
    header.point_bytes += size * count;
    header.point_words += count;
  }
  if (!found[0] || !found[1] || !found[2]) throw Bad("has no fields x, y and z");
}

Header read_header(std::string_view file) {
  constexpr std::size_t kMostSide = std::numeric_limits<std::int16_t>::max();
  Header header;
  FieldLists fields;
  std::optional<std::size_t> points;
  while (header.data.empty()) {
    const std::size_t end = file.find('\n', header.bytes);
    if (end == std::string_view::npos) throw Bad("has no PCD header");
    std::istringstream line{std::string(file.substr(header.bytes, end - header.bytes))};
    header.bytes = end + 1;
    std::string key;
    line >> key;
    const auto words = words_of(line);
    const std::string& first = words.empty() ? key : words.front();
    if (key == "FIELDS") fields.names = words;
    if (key == "SIZE") fields.sizes = words;
    if (key == "TYPE") fields.types = words;
    if (key == "COUNT") fields.counts = words;
    if (key == "WIDTH") header.width = number_in(first, kMostSide);
    if (key == "HEIGHT") header.height = number_in(first, kMostSide);
    if (key == "POINTS") points = number_in(first, kMostSide * kMostSide);
    if (key == "DATA") header.data = first;
  }
  place_coordinates(fields, header);
  if (header.height < 2 || header.width < 2)
    throw Bad(fmt::format("is not organised as an image (WIDTH {} HEIGHT {})", header.width, header.height));
  if (points && *points != header.points()) throw Bad("POINTS is not WIDTH x HEIGHT");
  return header;
}

float coordinate_at(const char* at, std::size_t size) {
  if (size == sizeof(float)) {
    float value = 0;
    std::memcpy(&value, at, sizeof value);
    return value;
  }
  double value = 0;
  std::memcpy(&value, at, sizeof value);
  return static_cast<float>(value);
}

void read_binary(const Header& header, std::span<const char> data, std::vector<Eigen::Vector3f>& points) {
  if (data.size() / header.point_bytes < header.points()) throw Bad("is cut short");
  for (std::size_t i = 0; i < header.points(); ++i)
    for (std::size_t axis = 0; axis < 3; ++axis)
      points[i][static_cast<Eigen::Index>(axis)] = coordinate_at(
          data.data() + i * header.point_bytes + header.xyz[axis].offset, header.xyz[axis].size);
}

/// Field after field, each for all points, behind two 32-bit lengths.
void read_compressed(const Header& header, std::span<const char> data, std::vector<Eigen::Vector3f>& points) {
  std::array<std::uint32_t, 2> lengths{};  // packed, unpacked
  if (data.size() < sizeof lengths) throw Bad("is cut short");
  std::memcpy(lengths.data(), data.data(), sizeof lengths);
  if (lengths[0] > data.size() - sizeof lengths) throw Bad("is cut short");
  if (lengths[1] != header.points() * header.point_bytes)
    throw Bad("unpacks to another size than its header says");
  Bytes unpacked(lengths[1]);
  if (lzf_decompress(data.data() + sizeof lengths, lengths[0], unpacked.data(), lengths[1]) != lengths[1])
    throw Bad("its compressed data are damaged");
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const char* column = unpacked.data() + header.points() * header.xyz[axis].offset;
    for (std::size_t i = 0; i < header.points(); ++i)
      points[i][static_cast<Eigen::Index>(axis)] =
          coordinate_at(column + i * header.xyz[axis].size, header.xyz[axis].size);
  }
}

void read_ascii(const Header& header, std::span<const char> data, std::vector<Eigen::Vector3f>& points) {
  const char* at = data.data();
  const char* const end = at + data.size();
  const auto is_space = [](char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; };
  for (auto& point : points)
    for (std::size_t word = 0; word < header.point_words; ++word) {
      while (at < end && is_space(*at)) ++at;
      const char* word_end = at;
      while (word_end < end && !is_space(*word_end)) ++word_end;
      if (at == word_end) throw Bad("is cut short");
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (header.xyz[axis].word != word) continue;
        const auto [stop, error] = std::from_chars(at, word_end, point[static_cast<Eigen::Index>(axis)]);
        if (error != std::errc{} || stop != word_end)
          throw Bad(fmt::format("\"{}\" is no coordinate", std::string(at, word_end)));
      }
      at = word_end;
    }
}

OrganisedCloud parse(const Bytes& file) {
  const Header header = read_header({file.data(), file.size()});
  const auto data = std::span(file).subspan(header.bytes);
  constexpr std::size_t kLeastPacking = 256;  // LZF packs at most 264 bytes into 3
  if (header.points() / kLeastPacking > data.size()) throw Bad("is cut short");
  OrganisedCloud cloud{static_cast<int>(header.width), static_cast<int>(header.height),
                       std::vector<Eigen::Vector3f>(header.points())};
  if (header.data == "ascii") {
    read_ascii(header, data, cloud.points);
  } else if (header.data == "binary") {
    read_binary(header, data, cloud.points);
  } else if (header.data == "binary_compressed") {
    read_compressed(header, data, cloud.points);
  } else {
    throw Bad(fmt::format("DATA {} is none of ascii, binary, binary_compressed", header.data));
  }
  return cloud;
}

}  // namespace

OrganisedCloud read_pcd(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in || std::filesystem::is_directory(file))
    throw std::runtime_error(fmt::format("{}: cannot be opened", file.string()));
  const Bytes bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  try {
    return parse(bytes);
  } catch (const Bad& bad) {
    throw std::runtime_error(fmt::format("{}: {}", file.string(), bad.what()));
  }
}

}  // namespace floornav
