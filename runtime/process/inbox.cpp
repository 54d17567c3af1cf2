#include "runtime/process/inbox.hpp"

#include <algorithm>
#include <stdexcept>

namespace floornav {

void Inbox::add(const std::string& channel, Keep keep, std::function<void(Entry&, Bytes, Micros)> accept) {
  const auto [place, inserted] = entries_.try_emplace(channel);
  if (!inserted) throw std::logic_error(channel + ": subscribed twice by one node");
  place->second.keep = keep;
  place->second.accept = std::move(accept);
}

bool Inbox::in_order(Entry& entry, const std::string& source, std::int64_t session, std::int64_t seq,
                     Micros now) {
  using Verdict = SequenceCheck::Verdict;
  const SequenceCheck::Result result = entry.sequence.check(source, session, seq, now);
  switch (result.verdict) {
    case Verdict::kInvalid:
      ++entry.counts.malformed;
      return false;
    case Verdict::kOld:
      ++entry.counts.old;
      return false;
    case Verdict::kUnconfirmed:
      ++entry.counts.unconfirmed;
      return false;
    case Verdict::kRival:
      ++entry.counts.rival;
      return false;
    case Verdict::kNew:
      break;
  }
  const std::int64_t known = std::min(result.missing, entry.known_gap);
  entry.known_gap -= known;
  const std::int64_t room = std::numeric_limits<std::int64_t>::max() - entry.counts.lost;
  entry.counts.lost += std::min(result.missing - known, room);
  return true;
}

void Inbox::deliver(std::string_view channel, Bytes bytes, Micros now) {
  const auto place = entries_.find(channel);
  if (place == entries_.end()) return;
  Entry& entry = place->second;
  ++entry.counts.received;
  try {
    entry.accept(entry, bytes, now);
  } catch (const std::exception&) {
    ++entry.counts.malformed;
  }
}

void Inbox::count_superseded(std::string_view channel, std::int64_t count) {
  const auto place = entries_.find(channel);
  if (place == entries_.end()) return;
  place->second.counts.received += count;
  place->second.counts.superseded += count;
  place->second.known_gap += count;
}

void Inbox::forget_order() {
  for (auto& [channel, entry] : entries_) entry.sequence = {};
}

std::vector<std::pair<std::string, Keep>> Inbox::channels() const {
  std::vector<std::pair<std::string, Keep>> all;
  for (const auto& [channel, entry] : entries_) all.emplace_back(channel, entry.keep);
  return all;
}

std::map<std::string, ChannelCounts> Inbox::counts() const {
  std::map<std::string, ChannelCounts> all;
  for (const auto& [channel, entry] : entries_) all.emplace(channel, entry.counts);
  return all;
}

}  // namespace floornav
