#pragma once

#include <atomic>
#include <cstdint>
#include <random>
#include <thread>
#include <vector>

#include "tests/devices/kinect/control_block.hpp"
#include "tests/devices/kinect/plugin/openni_driver_api.hpp"
#include "tests/devices/kinect/plugin/scene.hpp"

namespace floornav {

/// The depth or the colour stream of a virtual Kinect: a thread that raises the scene's frames, each
/// `transfer_us` after its exposure, with the faults that the control block asks for.
class Stream final : public oni::driver::StreamBase {
 public:
  Stream(OniSensorType type, int device, const Scene& scene, ControlBlock& control);
  ~Stream() override;

  /// What the sensor offers; the first one is the default.
  static std::vector<OniVideoMode> modes_of(OniSensorType type, const Scene& scene);

  OniStatus start() override;
  void stop() override;
  OniBool isPropertySupported(int id) override;
  OniStatus getProperty(int id, void* data, int* size) override;
  OniStatus setProperty(int id, const void* data, int size) override;
  OniStatus convertDepthToColorCoordinates(StreamBase*, int x, int y, OniDepthPixel, int* color_x,
                                           int* color_y) override;

 private:
  void play();
  void raise(std::int64_t step, std::int64_t exposure_us);
  void fill_depth(OniFrame& frame, std::int64_t step);
  [[nodiscard]] int seen_column(const OniFrame& frame, int column) const;
  [[nodiscard]] int seen_row(const OniFrame& frame, int row) const;
  void fill_color(OniFrame& frame, std::int64_t step);
  void spoil(OniFrame& frame);
  [[nodiscard]] bool unplugged() const;
  [[nodiscard]] float field_of_view(float of_depth_rad) const;
  [[nodiscard]] std::uint64_t clock_at(std::int64_t monotonic_us) const;
  [[nodiscard]] int bytes_per_pixel() const { return type_ == ONI_SENSOR_DEPTH ? 2 : 3; }

  /// Focal length of the depth camera in the colour camera's: a Kinect's colour camera sees more.
  static constexpr double kColorIsWider = 575.8 / 525.0;

  const OniSensorType type_;
  const int device_;
  const Scene& scene_;
  ControlBlock& control_;
  OniVideoMode mode_;
  std::atomic<OniBool> mirrored_{TRUE};  // as PrimeSense's do
  std::atomic<bool> running_{false};
  std::thread thread_;
  int index_ = 0;
  std::int64_t frozen_step_ = -1;
  std::minstd_rand random_;
};

}  // namespace floornav
