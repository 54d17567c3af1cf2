#pragma once

#include <map>
#include <string>

#include "floornav/health_t.hpp"
#include "runtime/process/inbox.hpp"
#include "runtime/process/latency.hpp"

namespace floornav {

/// Appends a drop, unless its count is 0.
void add_drop(health_t& health, const std::string& cause, std::int64_t count);

/// Appends p50, p99 and the maximum, unless nothing was measured.
void add_latency(health_t& health, const std::string& what, const LatencyHistogram& latency);

/// Appends what an inbox dropped: "CHANNEL malformed", "CHANNEL superseded", "CHANNEL old", "CHANNEL rival",
/// "CHANNEL unconfirmed", "CHANNEL lost".
void add_drops(health_t& health, const std::map<std::string, ChannelCounts>& counts);

/// Makes the state worse, never better, and adds the reason to those that are there.
void worsen(health_t& health, std::int8_t state, const std::string& reason);

/// Puts a question mark for what is no printable ASCII: a reason may quote what came from the wire.
void make_printable(health_t& health);

}  // namespace floornav
