#include "tools/bench/strip_cost.hpp"

#include <algorithm>
#include <ctime>
#include <span>

#include "lcmtypes/depth_cloud.hpp"

namespace floornav {
namespace {

double thread_ms() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) * 1e3 + static_cast<double>(t.tv_nsec) * 1e-6;
}

/// Sends rows of an image through the wire's form and back.
class Way {
 public:
  explicit Way(const depth_cloud_t& cloud) : cloud_(cloud) {}

  void send(std::span<const std::uint16_t> image, int first_row, int rows) {
    cloud_.first_row = static_cast<std::int16_t>(first_row);
    cloud_.rows = static_cast<std::int16_t>(rows);
    const auto width = static_cast<std::size_t>(cloud_.width);
    pack_pixels(
        image.subspan(static_cast<std::size_t>(first_row) * width, static_cast<std::size_t>(rows) * width),
        cloud_);
    bytes_.resize(static_cast<std::size_t>(cloud_.getEncodedSize()));
    const int size = static_cast<int>(bytes_.size());
    cloud_.encode(bytes_.data(), 0, size);
    received_.decode(bytes_.data(), 0, size);
    unpack_pixels(received_, pixels_);
  }

 private:
  depth_cloud_t cloud_;
  depth_cloud_t received_;
  std::vector<std::uint8_t> bytes_;
  std::vector<std::uint16_t> pixels_;
};

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

}  // namespace

StripCost measure_strips(const FrameSamples& samples) {
  const int height = samples.cloud.height;
  const int rows = height / kStrips;
  Way way(samples.cloud);
  std::vector<double> whole;
  std::vector<double> near;
  std::vector<double> all;
  for (const std::vector<std::uint16_t>& image : samples.images) {
    way.send(image, 0, height);  // memory is allocated and warm
    const double start = thread_ms();
    way.send(image, 0, height);
    const double sent_whole = thread_ms();
    way.send(image, height - rows, rows);
    const double sent_near = thread_ms();
    for (int strip = kStrips - 2; strip >= 0; --strip) way.send(image, strip * rows, rows);
    whole.push_back(sent_whole - start);
    near.push_back(sent_near - sent_whole);
    all.push_back(thread_ms() - sent_whole);
  }
  return {median(whole), median(near), median(all)};
}

}  // namespace floornav
