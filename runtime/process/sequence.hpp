#pragma once

#include <concepts>
#include <cstdint>
#include <deque>
#include <map>
#include <string>

#include "runtime/process/time.hpp"

namespace floornav {

/// A message that says who sent it and as which one. POSE, which keeps bot_core's form, does not.
template <class Message>
concept Sequenced = requires(Message m) {
  { m.source } -> std::same_as<std::string&>;
  { m.session } -> std::same_as<std::int64_t&>;
  { m.seq } -> std::same_as<std::int64_t&>;
};

/// Orders the messages of one channel by session and seq. Several sources on the channel are told apart by
/// name. No single message can shut its source out: a new session, or a seq far ahead, holds from its second
/// message on.
class SequenceCheck {
 public:
  enum class Verdict {
    kNew,    ///< take it
    kOld,    ///< duplicate, or of an older seq or session
    kRival,  ///< of a second session while the first one is alive: somebody plays a log, or a process runs
             ///< twice
    kUnconfirmed,  ///< of a new session or far ahead: waits for a second message that agrees
    kInvalid,      ///< session 0 or seq < 1
  };
  struct Result {
    Verdict verdict = Verdict::kNew;
    std::int64_t missing = 0;  ///< messages between this one and the last one taken of its source
  };

  /// How long a session must have been silent before another one of the same source takes its place: at least
  /// this, and three times what lay between its last two messages, but not more than kLongestSilence.
  static constexpr Micros kSessionSilence = std::chrono::milliseconds(500);
  static constexpr Micros kLongestSilence = std::chrono::seconds(5);
  /// A seq that is farther ahead (of 1, for a source never heard) needs a second message that agrees.
  static constexpr std::int64_t kMaxMissing = 1000;

  Result check(const std::string& source, std::int64_t session, std::int64_t seq, Micros now);

 private:
  struct Source {
    std::int64_t session = 0;
    std::int64_t last_seq = 0;
    Micros heard{0};
    Micros interval{0};                ///< between the last two messages taken
    std::int64_t suspect_session = 0;  ///< of the last message that waits for another one that agrees
    std::int64_t suspect_seq = 0;
    std::deque<std::int64_t> replaced;  ///< sessions that will not come back
  };
  static bool is_confirmed(Source& known, std::int64_t session, std::int64_t seq);
  Source& source_of(const std::string& name);

  std::map<std::string, Source> sources_;
};

}  // namespace floornav
