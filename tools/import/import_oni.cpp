#include <algorithm>
#include <chrono>
#include <stdexcept>

#include <fmt/format.h>

#include "drivers/kinect/device_frame.hpp"
#include "drivers/kinect/node/openni_device.hpp"
#include "tools/import/frame_place.hpp"
#include "tools/import/import.hpp"
#include "tools/import/recording.hpp"

namespace floornav {

ImportReport import_oni(const OniImport& what, const ImportTarget& target) {
  KinectSettings settings;
  settings.device = what.file.string();
  OpenNiDevice device(settings, {Playback::kByHand, ""});
  if (!device.listed()) throw std::runtime_error(device.absence());
  const DepthStream stream = device.open();
  const Pinhole camera = what.camera.value_or(stream.camera);
  Recording recording(target.log, target.sensor);
  DepthImage image;
  image.width = stream.shape.width;
  image.height = stream.shape.height;
  std::int64_t damaged = 0;
  for (DepthDevice::Event event;
       (event = device.wait(std::chrono::seconds(1))) != DepthDevice::Event::kGone;) {
    target.before_each(recording.clouds() + damaged, device.frames_in_file());
    if (event != DepthDevice::Event::kFrame ||
        copy_depths(device.frame(), stream.shape, image.pixels) != FrameFlaw::kNone) {
      ++damaged;
      continue;
    }
    const std::int64_t utime = 1'000'000 + recording.clouds() * FixedMounting::period_us;
    recording.pose(utime, place_of(recording.clouds(), what.mounting));
    recording.cloud(utime, image, camera, static_cast<double>(stream.count_m), sensor_pose(what.mounting));
  }
  if (recording.clouds() == 0) throw std::runtime_error(what.file.string() + ": holds no depth frames");
  recording.finish();
  ImportReport report{
      recording.clouds(), recording.poses(), (recording.clouds() - 1) * FixedMounting::period_us, {}};
  report.notes.push_back(fmt::format("{}{}, camera {:.1f},{:.1f},{:.1f},{:.1f}", stream.device,
                                     stream.shape.mirrored ? ", mirrored (undone)" : "", camera.fx, camera.fy,
                                     camera.cx, camera.cy));
  if (damaged > 0) report.notes.push_back(fmt::format("{} damaged frames left out", damaged));
  return report;
}

}  // namespace floornav
