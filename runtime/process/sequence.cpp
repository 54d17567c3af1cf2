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
  if (known.session == session) {
    if (seq <= known.last_seq) return {Verdict::kOld, 0};
    missing = seq - known.last_seq - 1;
  } else if (known.session != 0) {
    if (std::find(known.replaced.begin(), known.replaced.end(), session) != known.replaced.end())
      return {Verdict::kOld, 0};
    if (now - known.heard < kSessionSilence) return {Verdict::kRival, 0};
    known.replaced.push_back(known.session);
    if (known.replaced.size() > kMaxReplaced) known.replaced.pop_front();
  }
  known.session = session;
  known.last_seq = seq;
  known.heard = now;
  return {Verdict::kNew, missing};
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
