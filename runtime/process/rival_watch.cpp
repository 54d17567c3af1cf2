#include "runtime/process/rival_watch.hpp"

#include <fmt/format.h>

#include "runtime/process/health.hpp"
#include "runtime/process/message_header.hpp"

namespace floornav {

void RivalWatch::look(std::string_view channel, std::span<const std::uint8_t> bytes, Instant now) {
  if (!channels_.contains(channel)) return;
  const auto header = peek_header(bytes);
  if (!header || header->session == identity_.session) return;
  const std::lock_guard lock(mutex_);
  last_ = now;
  ++count_;
  who_ = fmt::format("'{}' also publishes {}: a log is played here, or this process runs twice",
                     header->source, channel);
}

void RivalWatch::report(health_t& health, Instant now) const {
  const std::lock_guard lock(mutex_);
  add_drop(health, "rival publisher", count_);
  if (count_ > 0 && now - last_ < kRemembered) worsen(health, health_t::DEGRADED, who_);
}

}  // namespace floornav
