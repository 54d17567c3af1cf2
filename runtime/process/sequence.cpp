#include "runtime/process/sequence.hpp"

#include <algorithm>
#include <cstddef>

namespace floornav {
namespace {

// Bounds on what senders can make us remember.
constexpr std::size_t kMaxSources = 64;
constexpr std::size_t kMaxReplaced = 32;

}  // namespace

SequenceCheck::Result SequenceCheck::check(const std::string& source, std::int64_t session, std::int64_t seq,
                                           Micros now) {
  if (session == 0 || seq < 1) return {Verdict::kInvalid, 0};
  Source& known = source_of(source);
  std::int64_t missing = 0;
  if (known.session == 0) {
    if (seq > kMaxMissing && !is_confirmed(known, session, seq)) return {Verdict::kUnconfirmed, 0};
  } else if (known.session == session) {
    if (seq <= known.last_seq) return {Verdict::kOld, 0};
    missing = seq - known.last_seq - 1;
    if (missing > kMaxMissing && !is_confirmed(known, session, seq)) return {Verdict::kUnconfirmed, 0};
    known.interval = now - known.heard;
  } else {
    if (std::find(known.replaced.begin(), known.replaced.end(), session) != known.replaced.end())
      return {Verdict::kOld, 0};
    const Micros silence = std::clamp(3 * known.interval, kSessionSilence, kLongestSilence);
    if (now - known.heard < silence) return {Verdict::kRival, 0};
    if (!is_confirmed(known, session, seq)) return {Verdict::kUnconfirmed, 0};
    known.replaced.push_back(known.session);
    if (known.replaced.size() > kMaxReplaced) known.replaced.pop_front();
    known.interval = {};
  }
  known.session = session;
  known.last_seq = seq;
  known.heard = now;
  return {Verdict::kNew, missing};
}

/// True where the last message in doubt was of this session and shortly before.
bool SequenceCheck::is_confirmed(Source& known, std::int64_t session, std::int64_t seq) {
  const bool agrees = known.suspect_session == session && seq > known.suspect_seq &&
                      seq - known.suspect_seq - 1 <= kMaxMissing;
  known.suspect_session = agrees ? 0 : session;
  known.suspect_seq = seq;
  return agrees;
}

SequenceCheck::Source& SequenceCheck::source_of(const std::string& name) {
  if (!sources_.contains(name) && sources_.size() >= kMaxSources) {
    const auto oldest = std::min_element(sources_.begin(), sources_.end(), [](const auto& a, const auto& b) {
      return a.second.heard < b.second.heard;
    });
    sources_.erase(oldest);
  }
  return sources_[name];
}

}  // namespace floornav
