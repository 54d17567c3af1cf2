#include "runtime/process/replay_executor.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace floornav {
namespace {

// More steps than any frame needs: a node that still has more to do never will rest.
constexpr int kMaxRounds = 1'000'000;

template <class Work>
std::chrono::nanoseconds time_of(Work&& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::steady_clock::now() - begin;
}

}  // namespace

ReplayExecutor::ReplayExecutor(const std::vector<Node*>& nodes, Sink sink, ReplayOptions options)
    : sink_(std::move(sink)), options_(options) {
  for (Node* node : nodes) {
    if (node->tick_period() <= Micros(0)) throw std::logic_error(node->name() + ": ticks without a period");
    node->subscribe(seats_.emplace_back(*node, options_.work_budget_ns).inbox);
  }
}

void ReplayExecutor::inject(EncodedMessage message) {
  injected_.push_back(std::move(message));
}

void ReplayExecutor::deliver(const LogEvent& event) {
  if (!clock_.started()) start(clock_.advance(event.timestamp_us));
  const Micros now = clock_.advance(event.timestamp_us);
  fire_ticks(now);
  for (const EncodedMessage& message : std::exchange(injected_, {})) {
    hand_out(message, now);
    settle(now);
  }
  const bool ours = std::any_of(seats_.begin(), seats_.end(), [&](const Seat& seat) {
    const auto outputs = seat.node->outputs();
    return std::find(outputs.begin(), outputs.end(), event.channel) != outputs.end();
  });
  if (ours) {
    ++left_out_;
    return;
  }
  hand_out(event.channel, event.bytes, now);
  settle(now);
}

void ReplayExecutor::finish() {
  if (!clock_.started()) return;
  clock_.run_on(options_.run_on);
  fire_ticks(clock_.now());
}

std::map<std::string, ChannelCounts> ReplayExecutor::counts(std::size_t node) const {
  return seats_.at(node).inbox.counts();
}

void ReplayExecutor::start(Micros now) {
  for (Seat& seat : seats_) seat.next_tick = now + seat.node->tick_period();
}

void ReplayExecutor::fire_ticks(Micros until) {
  while (true) {
    const auto next = std::min_element(
        seats_.begin(), seats_.end(), [](const Seat& a, const Seat& b) { return a.next_tick < b.next_tick; });
    if (next == seats_.end() || next->next_tick > until) return;
    const Micros now = next->next_tick;
    const auto took = time_of([&] { next->node->tick(now, next->out); });
    next->timing.tick += took;
    next->busy += took;
    next->next_tick += next->node->tick_period();
    publish(*next, now);
    settle(now);
  }
}

void ReplayExecutor::settle(Micros now) {
  for (int round = 0; round < kMaxRounds; ++round) {
    bool more = false;
    for (Seat& seat : seats_) {
      const bool unfinished = step(seat, now);
      const bool published = publish(seat, now);
      more = more || unfinished || published;
    }
    if (!more) return;
  }
  throw std::runtime_error("a node never comes to rest");
}

bool ReplayExecutor::step(Seat& seat, Micros now) {
  bool more = false;
  const auto took = time_of([&] { more = seat.node->step(now, seat.budget, seat.out); });
  seat.timing.step += took;
  seat.busy += took;
  seat.resting = !more;
  return more;
}

bool ReplayExecutor::publish(Seat& seat, Micros now) {
  const std::vector<EncodedMessage> messages = seat.out.take();
  seat.published = seat.published || !messages.empty();
  if (seat.resting) {
    if (seat.published) seat.timing.runs.add(seat.busy);
    seat.published = false;
    seat.busy = {};
  }
  for (const EncodedMessage& message : messages) hand_out(message, now);
  return !messages.empty();
}

void ReplayExecutor::hand_out(const EncodedMessage& message, Micros now) {
  sink_(message, now);
  hand_out(message.channel, message.bytes, now);
}

void ReplayExecutor::hand_out(const std::string& channel, std::span<const std::uint8_t> bytes, Micros now) {
  for (Seat& seat : seats_) {
    const auto took = time_of([&] { seat.inbox.deliver(channel, bytes, now); });
    seat.timing.accept += took;
    seat.busy += took;
  }
}

}  // namespace floornav
