#include "runtime/process/health.hpp"

#include <algorithm>

namespace floornav {

void add_drop(health_t& health, const std::string& cause, std::int64_t count) {
  if (count == 0) return;
  drop_t drop;
  drop.cause = cause;
  drop.count = count;
  health.drops.push_back(drop);
  health.n_drops = static_cast<std::int32_t>(health.drops.size());
}

void add_latency(health_t& health, const std::string& what, const LatencyHistogram& latency) {
  if (latency.count() == 0) return;
  latency_t entry;
  entry.what = what;
  entry.p50_ms = static_cast<float>(latency.percentile_ms(0.50));
  entry.p99_ms = static_cast<float>(latency.percentile_ms(0.99));
  entry.max_ms = static_cast<float>(latency.max_ms());
  health.latencies.push_back(entry);
  health.n_latencies = static_cast<std::int32_t>(health.latencies.size());
}

void add_drops(health_t& health, const std::map<std::string, ChannelCounts>& counts) {
  for (const auto& [channel, c] : counts) {
    add_drop(health, channel + " malformed", c.malformed);
    add_drop(health, channel + " superseded", c.superseded);
    add_drop(health, channel + " old", c.old);
    add_drop(health, channel + " rival", c.rival);
    add_drop(health, channel + " unconfirmed", c.unconfirmed);
    add_drop(health, channel + " lost", c.lost);
  }
}

void worsen(health_t& health, std::int8_t state, const std::string& reason) {
  health.state = std::max(health.state, state);
  health.reason += (health.reason.empty() ? "" : "; ") + reason;
}

void make_printable(health_t& health) {
  const auto clean = [](std::string& text) {
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c < 0x20 || c > 0x7E; }, '?');
  };
  clean(health.reason);
  for (rate_t& rate : health.rates) clean(rate.channel);
  for (latency_t& latency : health.latencies) clean(latency.what);
  for (drop_t& drop : health.drops) clean(drop.cause);
}

}  // namespace floornav
