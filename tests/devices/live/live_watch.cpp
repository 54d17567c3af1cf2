#include "tests/devices/live/live_watch.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include <fmt/format.h>

#include "floornav/grid_map_t.hpp"
#include "lcmtypes/channels.hpp"

namespace floornav {
namespace {

template <class Clock>
std::int64_t now_us() {
  return std::chrono::duration_cast<std::chrono::microseconds>(Clock::now().time_since_epoch()).count();
}

double percentile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  const auto at = static_cast<std::size_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(at), values.end());
  return values[at];
}

std::string text_of(const health_t& health) {
  std::string text = fmt::format("HEALTH of {}: state {} {}\n", health.source, health.state, health.reason);
  for (const drop_t& drop : health.drops) text += fmt::format("    {}: {}\n", drop.cause, drop.count);
  for (const latency_t& l : health.latencies)
    text += fmt::format("    {}: p50 {:.2f} ms, p99 {:.2f} ms, max {:.2f} ms\n", l.what, l.p50_ms, l.p99_ms,
                        l.max_ms);
  return text;
}

std::string text_of(const std::optional<double>& ms) {
  return ms ? fmt::format("{:.0f} ms", *ms) : "never";
}

}  // namespace

void LiveWatch::Reaction::end() {
  if (since && !ms) ms = std::chrono::duration<double, std::milli>(Clock::now() - *since).count();
}

LiveWatch::LiveWatch(LcmTransport& bus, const LiveCamera& camera) : bus_(bus), camera_(camera) {
  inbox_.subscribe<depth_cloud_t>(camera.channel, Keep::kAll, [this](const auto& m, Micros) { see(m); });
  inbox_.subscribe<surfels_t>(channel::kSurfels, Keep::kAll, [this](const auto& m, Micros) { see(m); });
  inbox_.subscribe<grid_map_t>(channel::kGridMap, Keep::kAll, [](const auto&, Micros) {});
  inbox_.subscribe<path_t>(channel::kPath, Keep::kAll, [this](const auto& m, Micros) { see(m); });
  inbox_.subscribe<health_t>(channel::kHealth, Keep::kAll,
                             [this](const auto& m, Micros) { health_[m.source] = m; });
  for (const auto& [name, keep] : inbox_.channels()) bus.subscribe(name);
}

void LiveWatch::receive(std::chrono::milliseconds timeout) {
  bus_.receive(timeout, [this](std::string_view name, std::span<const std::uint8_t> bytes) {
    inbox_.deliver(name, bytes, Micros(now_us<Clock>()));
  });
}

void LiveWatch::unplugged() {
  stop_.begin();
}

void LiveWatch::plugged() {
  frames_.begin();
  moves_.begin();
}

void LiveWatch::see(const depth_cloud_t& cloud) {
  const std::int64_t now = now_us<Clock>();
  frames_.end();
  const std::int64_t step = step_at(cloud.utime - now_us<std::chrono::system_clock>() + now);
  if (clouds_ == 0) first_step_ = step;
  if (clouds_++ > 0) frame_gaps_ += cloud.frame - last_frame_ - 1;
  last_frame_ = cloud.frame;
  arrived_us_.emplace(cloud.frame, now);
  const double ms = static_cast<double>(now - camera_.raised_us(step)) * 1e-3;
  if (ms >= 0 && ms < 1000) latency_ms_.push_back(ms);
}

void LiveWatch::see(const surfels_t& surfels) {
  if (std::exchange(last_surfels_, surfels.frame) != surfels.frame) ++surfel_frames_;
  const bool nearest = std::any_of(surfels.sections.begin(), surfels.sections.end(), [](const section_t& s) {
    return s.ix == 0 && s.state == section_t::DONE;
  });
  if (!nearest || std::exchange(last_nearest_, surfels.frame) == surfels.frame) return;
  ++nearest_frames_;
  const auto cloud = arrived_us_.find(surfels.frame);
  if (cloud == arrived_us_.end()) return;
  near_ms_.push_back(static_cast<double>(now_us<Clock>() - cloud->second) * 1e-3);
  arrived_us_.erase(arrived_us_.begin(), std::next(cloud));
}

void LiveWatch::see(const path_t& path) {
  ++path_status_[path.status];
  const bool moves = path.status == path_t::FOLLOWING || path.status == path_t::FRONTIER;
  if (moves)
    moves_.end();
  else
    stop_.end();
}

std::int64_t LiveWatch::step_at(std::int64_t monotonic_us) const {
  return (monotonic_us - camera_.origin_us + camera_.period_us / 2) / camera_.period_us;
}

std::int64_t LiveWatch::raised() const {
  std::int64_t count = 0;
  const std::int64_t now = now_us<Clock>();
  for (std::int64_t step = first_step_; step <= step_at(now); ++step)
    count += camera_.raised_us(step) > 0 ? 1 : 0;
  return count;
}

std::int64_t LiveWatch::may_be_untold() const {
  constexpr int kAtTheEnds = 2;  // the device may be one frame ahead or behind at either end
  constexpr int kRing = 8;       // of the driver's library, which nobody empties where the camera is gone
  return kAtTheEnds + (stop_.since ? kRing : 0);
}

bool LiveWatch::all_told() const {
  return std::abs(raised() - clouds_ - frame_gaps_) <= may_be_untold();
}

std::int64_t LiveWatch::lost_on_bus() const {
  return inbox_.counts().at(camera_.channel).lost;
}

std::string LiveWatch::nearest_text() const {
  const double period_ms = static_cast<double>(camera_.period_us) * 1e-3;
  const auto late =
      std::count_if(near_ms_.begin(), near_ms_.end(), [&](double ms) { return ms > period_ms; });
  return fmt::format(
      "nearest sections after the cloud: median {:.1f} ms, p99 {:.1f} ms, max {:.1f} ms; {} later than "
      "{:.0f} "
      "ms\n",
      percentile(near_ms_, 0.5), percentile(near_ms_, 0.99), percentile(near_ms_, 1), late, period_ms);
}

std::string LiveWatch::table() const {
  std::string text =
      fmt::format("frames of the device {}, clouds {}, lost in the driver {}, lost on the bus {}\n", raised(),
                  clouds_, frame_gaps_ - lost_on_bus(), lost_on_bus());
  text +=
      fmt::format("device's frame to message received: median {:.2f} ms, p99 {:.2f} ms, max {:.2f} ms\n",
                  percentile(latency_ms_, 0.5), percentile(latency_ms_, 0.99), percentile(latency_ms_, 1));
  if (stop_.since) text += fmt::format("unplugged: the planner stops after {}\n", text_of(stop_.ms));
  if (frames_.since)
    text += fmt::format("plugged in again: frames after {}, the robot may drive after {}\n",
                        text_of(frames_.ms), text_of(moves_.ms));
  text += fmt::format("frames with surfels {}, of them with the nearest sections {}\n", surfel_frames_,
                      nearest_frames_);
  text += nearest_text();
  for (const auto& [name, counts] : inbox_.counts())
    text += fmt::format("{:14} received {:6}  lost {:4}  malformed {}\n", name, counts.received, counts.lost,
                        counts.malformed);
  for (const auto& [status, count] : path_status_) text += fmt::format("PATH status {}: {}\n", status, count);
  for (const auto& [source, health] : health_) text += text_of(health);
  return text;
}

std::string LiveWatch::silence() const {
  for (const auto& [name, counts] : inbox_.counts())
    if (counts.received == 0) return fmt::format("nothing came on {}", name);
  for (const std::string& source :
       {camera_.source, std::string("perception"), std::string("mapper"), std::string("planner")})
    if (!health_.contains(source)) return fmt::format("nothing heard of {}", source);
  if (stop_.since && !stop_.ms) return "the planner does not stop where the camera is gone";
  if (frames_.since && !frames_.ms) return "no frame after the camera was plugged in again";
  return "";
}

std::string LiveWatch::flaw(std::int64_t may_lose) const {
  if (!settled()) return silence();
  if (!all_told())
    return fmt::format("{} frames of the device, but {} clouds and {} told as lost", raised(), clouds_,
                       frame_gaps_);
  if (!stop_.since && nearest_frames_ < surfel_frames_)
    return fmt::format("{} frames without the nearest sections", surfel_frames_ - nearest_frames_);
  return frame_gaps_ > may_lose ? fmt::format("{} frames lost", frame_gaps_) : "";
}

}  // namespace floornav
