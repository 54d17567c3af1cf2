#include "drivers/camera/node/capture_health.hpp"

#include <fmt/format.h>

#include "runtime/process/health.hpp"

namespace floornav {
namespace {

using namespace std::chrono_literals;

constexpr Micros kLossRemembered = 2s;
constexpr std::int64_t kHanging_us = 2'000'000;

void report_verdict(health_t& health, FrameContent::Verdict verdict, const char* sparse) {
  switch (verdict) {
    case FrameContent::Verdict::kGood:
      return;
    case FrameContent::Verdict::kSparse:
      return worsen(health, health_t::DEGRADED, fmt::format("few pixels measure anything: {}", sparse));
    case FrameContent::Verdict::kEmpty:
      return worsen(health, health_t::DEGRADED, fmt::format("no pixel measures anything: {}", sparse));
    case FrameContent::Verdict::kStuck:
      return worsen(health, health_t::FAULT, "the same image again and again: nothing is published");
  }
}

}  // namespace

void report_capture(health_t& health, const CaptureStatus& status, const FrameHealth& frames, Micros now,
                    const char* library, const char* sparse) {
  if (status.doing_us > kHanging_us)
    worsen(health, health_t::FAULT,
           fmt::format("{} has not come back from {} for {} s", library, status.doing,
                       status.doing_us / 1'000'000));
  if (!status.trouble.empty())
    worsen(health, health_t::FAULT, status.trouble);
  else
    report_verdict(health, frames.verdict, sparse);
  if (frames.last_loss > 0us && now - frames.last_loss < kLossRemembered)
    worsen(health, health_t::DEGRADED, "the device loses frames");
  add_drop(health, "frame lost by the device", frames.lost);
  add_drop(health, "frame stuck", frames.withheld);
  for (const auto& [cause, count] : status.drops) add_drop(health, cause, count);
  add_drop(health, "device opened anew", status.opened - 1);
}

}  // namespace floornav
