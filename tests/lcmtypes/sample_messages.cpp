#include "sample_messages.hpp"

#include <cmath>
#include <random>
#include <string>

#include "lcmtypes/depth_cloud.hpp"

namespace floornav {
namespace {

/// Random values for the fields of messages.
class Values {
 public:
  explicit Values(std::uint32_t seed) : random_(seed) {}

  int whole(int least, int most) { return std::uniform_int_distribution<int>(least, most)(random_); }
  template <class T>
  T number() {
    return static_cast<T>(whole(-100, 100));
  }
  float real() { return std::uniform_real_distribution<float>(-5, 5)(random_); }
  std::string text() { return std::string(static_cast<std::size_t>(whole(0, 9)), 'x'); }

  template <class T, std::size_t N>
  void fill(T (&array)[N]) {
    for (T& value : array) value = static_cast<T>(real());
  }
  template <class T>
  void fill(std::vector<T>& array, std::int32_t count) {
    array.resize(static_cast<std::size_t>(count));
    for (T& value : array) value = number<T>();
  }
  template <class Message>
  void messages(std::int32_t& count, std::vector<Message>& array) {
    count = whole(1, 4);
    for (std::int32_t i = 0; i < count; ++i)
      array.push_back(sample_message<Message>(static_cast<std::uint32_t>(random_())));
  }
  template <class Message>
  void head(Message& m) {
    m.utime = 1305031230335112 + whole(0, 1000000);
    m.source = text();
    m.session = whole(1, 1 << 30);
    m.seq = whole(1, 1000);
  }

 private:
  std::mt19937 random_;
};

/// A floor seen from above, with a hole and a step.
std::vector<std::uint16_t> sample_image(int width, int height) {
  std::vector<std::uint16_t> pixels;
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) {
      const bool hole = u > width / 3 && u < width / 2;
      const int step = v > height / 2 ? 700 : 0;
      pixels.push_back(hole ? std::uint16_t{0} : static_cast<std::uint16_t>(4000 - 30 * v + u % 3 - step));
    }
  return pixels;
}

}  // namespace

template <>
depth_cloud_t sample_message(std::uint32_t seed) {
  Values v(seed);
  depth_cloud_t m;
  v.head(m);
  m.sensor = depth_cloud_t::KINECT;
  m.frame = v.whole(1, 1000);
  m.width = 40;
  m.height = 30;
  m.first_row = 10;
  m.rows = 20;
  m.fx = m.fy = 33.0F;
  m.cx = 19.5F;
  m.cy = 14.5F;
  m.baseline = 0.075F;
  m.disparity_sigma = 0.067F;
  v.fill(m.sensor_pos);
  m.sensor_orientation[0] = m.sensor_orientation[1] = std::sqrt(0.5);
  m.meaning = depth_cloud_t::DEPTH;
  m.scale = 0.001F;
  m.uncertainty_scale = 0.01F;
  m.uncertainty_size = m.width * m.rows;
  v.fill(m.uncertainty, m.uncertainty_size);
  pack_pixels(sample_image(m.width, m.rows), m);
  return m;
}

template <>
drop_t sample_message(std::uint32_t seed) {
  Values v(seed);
  drop_t m;
  m.cause = v.text();
  m.count = v.whole(0, 1000);
  return m;
}

template <>
goal_t sample_message(std::uint32_t seed) {
  Values v(seed);
  goal_t m;
  v.head(m);
  m.id = v.whole(1, 1000);
  m.command = goal_t::GO;
  v.fill(m.pos);
  m.tolerance = 0.3F;
  return m;
}

template <>
grid_tile_t sample_message(std::uint32_t seed) {
  Values v(seed);
  grid_tile_t m;
  m.ix = v.whole(-5, 5);
  m.iy = v.whole(-5, 5);
  m.version = v.whole(0, 1000);
  m.origin_z = v.real();
  m.side = static_cast<std::int16_t>(v.whole(1, 4));
  m.count = m.side * m.side;
  v.fill(m.state, m.count);
  v.fill(m.belief, m.count);
  v.fill(m.height, m.count);
  v.fill(m.sigma, m.count);
  v.fill(m.slope, m.count);
  v.fill(m.clearance, m.count);
  v.fill(m.edges, m.count);
  v.fill(m.age, m.count);
  return m;
}

template <>
grid_map_t sample_message(std::uint32_t seed) {
  Values v(seed);
  grid_map_t m;
  v.head(m);
  m.epoch = v.whole(0, 5);
  m.version = v.whole(0, 1000);
  m.resolution = 0.05F;
  m.step = 0.02F;
  v.fill(m.body_pos);
  v.fill(m.body_orientation);
  v.messages(m.n_tiles, m.tiles);
  return m;
}

template <>
rate_t sample_message(std::uint32_t seed) {
  Values v(seed);
  rate_t m;
  m.channel = v.text();
  m.count = v.whole(0, 1000);
  m.hz = v.real();
  return m;
}

template <>
latency_t sample_message(std::uint32_t seed) {
  Values v(seed);
  latency_t m;
  m.what = v.text();
  m.p50_ms = v.real();
  m.p99_ms = v.real();
  m.max_ms = v.real();
  return m;
}

template <>
health_t sample_message(std::uint32_t seed) {
  Values v(seed);
  health_t m;
  v.head(m);
  m.state = health_t::DEGRADED;
  m.reason = v.text();
  m.config_hash = v.whole(0, 1 << 30);
  v.messages(m.n_rates, m.rates);
  v.messages(m.n_latencies, m.latencies);
  v.messages(m.n_drops, m.drops);
  return m;
}

template <>
map_request_t sample_message(std::uint32_t seed) {
  Values v(seed);
  map_request_t m;
  v.head(m);
  v.fill(m.center);
  m.radius = v.real();
  return m;
}

template <>
path_point_t sample_message(std::uint32_t seed) {
  Values v(seed);
  path_point_t m;
  for (float* field : {&m.x, &m.y, &m.z, &m.heading, &m.speed, &m.clearance}) *field = v.real();
  m.assumed = static_cast<std::int8_t>(v.whole(0, 1));
  return m;
}

template <>
path_t sample_message(std::uint32_t seed) {
  Values v(seed);
  path_t m;
  v.head(m);
  m.goal_id = v.whole(0, 9);
  m.map_epoch = v.whole(0, 9);
  m.map_version = v.whole(0, 1000);
  m.status = path_t::FOLLOWING;
  m.reason = v.text();
  m.valid_for_ms = 250;
  m.length = v.real();
  v.messages(m.n_points, m.points);
  return m;
}

template <>
pose_t sample_message(std::uint32_t seed) {
  Values v(seed);
  pose_t m;
  m.utime = 1305031230335112 + v.whole(0, 1000000);
  v.fill(m.pos);
  v.fill(m.vel);
  v.fill(m.orientation);
  v.fill(m.rotation_rate);
  v.fill(m.accel);
  return m;
}

template <>
rigid_transform_t sample_message(std::uint32_t seed) {
  Values v(seed);
  rigid_transform_t m;
  m.utime = 1305031230335112 + v.whole(0, 1000000);
  v.fill(m.trans);
  v.fill(m.quat);
  return m;
}

template <>
section_t sample_message(std::uint32_t seed) {
  Values v(seed);
  section_t m;
  m.ix = v.number<std::int16_t>();
  m.iy = v.number<std::int16_t>();
  m.state = section_t::DONE;
  m.age = v.number<std::int16_t>();
  m.points = v.whole(0, 10000);
  return m;
}

template <>
surfel_t sample_message(std::uint32_t seed) {
  Values v(seed);
  surfel_t m;
  v.fill(m.centroid);
  v.fill(m.normal);
  m.radius = v.real();
  m.rms = v.real();
  m.points = v.whole(0, 10000);
  m.section = v.number<std::int16_t>();
  m.flags = surfel_t::DOMINANT + surfel_t::TRAVERSABLE;
  return m;
}

template <>
surfel_cell_t sample_message(std::uint32_t seed) {
  Values v(seed);
  surfel_cell_t m;
  m.ix = v.number<std::int16_t>();
  m.iy = v.number<std::int16_t>();
  m.surfel = v.number<std::int16_t>();
  m.points = v.whole(0, 10000);
  m.mean_z = m.var_z = m.top_z = v.real();
  m.ray_z = std::nanf("");
  m.flags = surfel_cell_t::NO_RETURN;
  return m;
}

template <>
surfels_t sample_message(std::uint32_t seed) {
  Values v(seed);
  surfels_t m;
  v.head(m);
  m.cloud_source = v.text();
  m.cloud_session = v.whole(1, 1 << 30);
  m.frame = v.whole(1, 1000);
  m.part = 0;
  m.parts = 1;
  m.sensor = depth_cloud_t::KINECT;
  v.fill(m.sensor_pos);
  v.fill(m.sensor_orientation);
  v.fill(m.body_pos);
  v.fill(m.body_orientation);
  m.pitch = 0.05;
  m.origin_ix = v.whole(-1000, 1000);
  m.origin_iy = v.whole(-1000, 1000);
  v.fill(m.origin);
  v.messages(m.n_sections, m.sections);
  v.messages(m.n_surfels, m.surfels);
  v.messages(m.n_cells, m.cells);
  return m;
}

template <>
terrain_tile_t sample_message(std::uint32_t seed) {
  Values v(seed);
  terrain_tile_t m;
  m.ix = v.whole(-5, 5);
  m.iy = v.whole(-5, 5);
  m.origin_z = v.real();
  m.side = static_cast<std::int16_t>(v.whole(1, 4));
  m.n_bytes = v.whole(1, 16);
  v.fill(m.heights, m.n_bytes);
  return m;
}

template <>
terrain_map_t sample_message(std::uint32_t seed) {
  Values v(seed);
  terrain_map_t m;
  v.head(m);
  m.epoch = v.whole(0, 5);
  m.version = v.whole(0, 1000);
  m.resolution = 0.1F;
  v.messages(m.n_tiles, m.tiles);
  return m;
}

template <>
image_metadata_t sample_message(std::uint32_t seed) {
  Values v(seed);
  image_metadata_t m;
  m.key = v.text();
  m.n = v.whole(1, 8);
  v.fill(m.value, m.n);
  return m;
}

template <>
image_t sample_message(std::uint32_t seed) {
  Values v(seed);
  image_t m;
  m.utime = v.whole(0, 1000);
  m.width = 8;
  m.height = 6;
  m.row_stride = 0;
  m.pixelformat = image_t::PIXEL_FORMAT_MJPEG;
  m.size = v.whole(1, 50);
  v.fill(m.data, m.size);
  v.messages(m.nmetadata, m.metadata);
  return m;
}

namespace {

template <class Message>
class MessageOf final : public AnyMessage {
 public:
  [[nodiscard]] std::string name() const override { return Message::getTypeName(); }
  [[nodiscard]] std::vector<std::uint8_t> sample(std::uint32_t seed) const override {
    return encoded(sample_message<Message>(seed));
  }
  int decode(const std::vector<std::uint8_t>& bytes) override {
    return message_.decode(bytes.data(), 0, static_cast<int>(bytes.size()));
  }
  [[nodiscard]] std::vector<std::uint8_t> encode() const override { return encoded(message_); }

 private:
  Message message_;
};

template <class... Messages>
void append(std::vector<std::unique_ptr<AnyMessage>>& types, std::tuple<Messages...>*) {
  (types.push_back(std::make_unique<MessageOf<Messages>>()), ...);
}

}  // namespace

std::vector<std::unique_ptr<AnyMessage>> every_message_type() {
  std::vector<std::unique_ptr<AnyMessage>> types;
  append(types, static_cast<MessageTypes*>(nullptr));
  return types;
}

}  // namespace floornav
