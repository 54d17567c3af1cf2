#include "tools/replay/frame_pictures.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "lcmtypes/channels.hpp"
#include "lcmtypes/depth_cloud.hpp"
#include "runtime/geometry/pinhole.hpp"

namespace floornav {

namespace {

constexpr std::size_t kMostWaiting = 40;

double depth_of(const depth_cloud_t& cloud, std::uint16_t pixel) {
  if (pixel == 0) return 0;
  const double value = static_cast<double>(pixel) * static_cast<double>(cloud.scale);
  return cloud.meaning == depth_cloud_t::DEPTH ? value
                                               : static_cast<double>(cloud.fx * cloud.baseline) / value;
}

/// The part of the map in which the frame saw something.
CellRectangle seen_part(const FrameEvidence& frame, const GridMap& map) {
  const Lattice& lattice = frame.evidence.lattice;
  CellBounds bounds;
  for (const CellEvidence& cell : frame.evidence.cells)
    bounds.add(map.lattice().cell_of(lattice.center_of(cell.cell.ix), lattice.center_of(cell.cell.iy)));
  return bounds.rectangle(map.lattice().pitch_m);
}

std::string title_of(const FrameEvidence& frame) {
  return fmt::format("frame {}, {:.3f} s", frame.frame, static_cast<double>(frame.evidence.utime_us) * 1e-6);
}

std::string subtitle_of(const FrameFloor& floor) {
  if (floor.points == 0) return "no floor found";
  return fmt::format(
      "floor {:.1f} cm high, {:.1f}° off level; camera {:.3f} m above it, pitch {:.1f}°, roll {:.1f}°",
      100 * floor.height_m, floor.tilt_deg, floor.camera_height_m, floor.camera_pitch_deg,
      floor.camera_roll_deg);
}

}  // namespace

FramePictures::FramePictures(std::filesystem::path folder, double height_m, double radius_m)
    : folder_(std::move(folder)), height_m_(height_m), radius_m_(radius_m) {
  std::filesystem::create_directories(folder_);
}

void FramePictures::see(const LogEvent& event) {
  if (event.channel != channel::kKinectCloud && event.channel != channel::kBumblebeeCloud) return;
  depth_cloud_t cloud{};
  const int size = static_cast<int>(event.bytes.size());
  if (cloud.decode(event.bytes.data(), 0, size) != size) return;  // the perception node counts it
  try {
    unpack_pixels(cloud, strip_);
  } catch (const CorruptDepth&) {
    return;  // likewise
  }
  const auto same = [&](const Image& image) {
    return image.cloud.sensor == cloud.sensor && image.cloud.frame == cloud.frame &&
           image.cloud.width == cloud.width && image.cloud.height == cloud.height;
  };
  auto image = std::ranges::find_if(images_, same);
  if (image == images_.end()) {
    if (images_.size() == kMostWaiting) images_.pop_front();
    images_.push_back({cloud, {}});
    image = std::prev(images_.end());
    image->pixels.resize(static_cast<std::size_t>(cloud.width) * static_cast<std::size_t>(cloud.height));
  }
  std::ranges::copy(strip_, image->pixels.begin() + cloud.first_row * cloud.width);
}

FramePictures::Image* FramePictures::image_of(const FrameEvidence& frame) {
  const auto found = std::ranges::find_if(images_, [&](const Image& image) {
    return image.cloud.sensor == frame.sensor && image.cloud.frame == frame.frame;
  });
  return found == images_.end() ? nullptr : &*found;
}

std::vector<std::uint32_t> FramePictures::colors_of(const Image& image, const FrameEvidence& frame,
                                                    const GridMap& map) const {
  const depth_cloud_t& cloud = image.cloud;
  const Pinhole camera{cloud.fx, cloud.fy, cloud.cx, cloud.cy, cloud.width, cloud.height};
  const Pose& T_world_body = frame.evidence.T_world_body;
  const Pose T_world_sensor = T_world_body * frame.evidence.T_body_sensor;
  std::vector<std::uint32_t> colors(image.pixels.size());
  for (std::size_t i = 0; i < colors.size(); ++i) {
    const double depth_m = depth_of(cloud, image.pixels[i]);
    const auto column = static_cast<float>(i % static_cast<std::size_t>(cloud.width));
    const auto row = static_cast<float>(i / static_cast<std::size_t>(cloud.width));
    const Eigen::Vector3d point = T_world_sensor * (depth_m * camera.ray(column, row).cast<double>());
    const bool judged = depth_m > 0 && point.z() < T_world_body.translation().z() + height_m_;
    colors[i] = pixel_color(
        depth_m, judged ? map.state(map.lattice().cell_of(point.x(), point.y())) : VertexState::kUnknown);
  }
  return colors;
}

void FramePictures::draw(const FrameEvidence& frame, const FrameFloor& floor, const GridMap& map) {
  const Image* image = image_of(frame);
  if (image == nullptr) return;
  const Pose& T_world_body = frame.evidence.T_world_body;
  FramePicture picture;
  picture.image_width = image->cloud.width;
  picture.image_height = image->cloud.height;
  picture.pixels = colors_of(*image, frame, map);
  picture.map = rasterize(map, seen_part(frame, map));
  picture.robot = {T_world_body.translation().head<2>(), heading_of(T_world_body), radius_m_};
  picture.title = title_of(frame);
  picture.subtitle = subtitle_of(floor);
  write_frame_png(picture, folder_ / fmt::format("{:06}.png", frame.frame));
  std::erase_if(images_, [&](const Image& old) {
    return old.cloud.sensor == frame.sensor && old.cloud.frame <= frame.frame;
  });
}

}  // namespace floornav
