#include "runtime/process/live_executor.hpp"

#include <algorithm>
#include <exception>
#include <set>

#include <fmt/format.h>

#include "lcmtypes/channels.hpp"
#include "runtime/process/health.hpp"
#include "runtime/process/message_header.hpp"

namespace floornav {
namespace {

using namespace std::chrono_literals;

constexpr auto kHealthPeriod = 1s;
constexpr auto kLookPeriod = 100ms;  // how soon a change of state is told
constexpr auto kLongestWait = 20ms;  // how soon a request to stop is seen
constexpr auto kBusWait = 50ms;
constexpr auto kBusRetry = 200ms;
constexpr auto kLogSilence = 1s;  // a log that is silent so long has ended
constexpr auto kLogRunOn = 1s;    // time that passes after its end, so that what waits can time out

const char* name_of(std::int8_t state) {
  switch (state) {
    case health_t::OK:
      return "OK";
    case health_t::DEGRADED:
      return "DEGRADED";
    default:
      return "FAULT";
  }
}

}  // namespace

LiveExecutor::LiveExecutor(Node& node, Transport& transport, LiveOptions options)
    : node_(node),
      transport_(transport),
      options_(std::move(options)),
      identity_(random_identity(node.name())),
      out_(identity_),
      rivals_(identity_, node.outputs()) {
  if (node_.tick_period() <= Micros(0)) throw std::logic_error(node_.name() + ": ticks without a period");
  const std::optional<Micros> deadline = options_.log_time ? std::nullopt : node_.deadline();
  budget_ = deadline ? std::unique_ptr<Budget>(std::make_unique<DeadlineBudget>(*deadline))
                     : std::make_unique<UnlimitedBudget>();
  out_.set_hurry([this] { publish(); });
  node_.subscribe(inbox_);
}

void LiveExecutor::run(const std::atomic<bool>& stop) {
  subscribe();
  node_.set_wake([this] { mailbox_.wake(); });
  {
    const std::jthread bus([this](const std::stop_token& token) { listen(token); });
    last_mail_ = last_health_ = last_look_ = std::chrono::steady_clock::now();
    while (!stop) turn();
  }
  node_.set_wake({});
  guard("stop", [this] { node_.stop(node_time(std::chrono::steady_clock::now()), out_); });
  publish();
}

void LiveExecutor::subscribe() {
  std::set<std::string> channels;
  for (const auto& [channel, keep] : inbox_.channels()) {
    mailbox_.open(channel, options_.log_time ? Keep::kAll : keep);
    channels.insert(channel);
  }
  for (const std::string& channel : node_.outputs()) channels.insert(channel);
  for (const std::string& channel : channels) transport_.subscribe(channel);
}

/// The bus thread: empties the bus and does nothing else.
void LiveExecutor::listen(const std::stop_token& stop) {
  const Transport::Receiver receive = [this](std::string_view channel, std::span<const std::uint8_t> bytes) {
    rivals_.look(channel, bytes, std::chrono::steady_clock::now());
    mailbox_.put(channel, bytes);
  };
  while (!stop.stop_requested()) {
    try {
      transport_.receive(kBusWait, receive);
    } catch (const std::exception&) {
      ++bus_errors_;
      std::this_thread::sleep_for(kBusRetry);
    }
  }
}

/// One turn of the worker: what came, the ticks that are due, one step. In log time one message has its turn
/// when the node is done with the one before, as in a replay.
void LiveExecutor::turn() {
  if (mail_.empty()) {
    for (Mail& mail : mailbox_.take(next_wake(std::chrono::steady_clock::now())))
      mail_.push_back(std::move(mail));
  }
  const bool idle = mail_.empty();
  std::size_t turns = options_.log_time ? (resting_ ? 1 : 0) : mail_.size();
  for (; turns > 0 && !mail_.empty(); --turns) {
    hand_over(mail_.front());
    mail_.pop_front();
  }
  const Instant now = std::chrono::steady_clock::now();
  if (options_.log_time) run_on(now, idle);
  fire_ticks(now);
  step();
  tell_health(std::chrono::steady_clock::now());
}

LiveExecutor::Instant LiveExecutor::next_wake(Instant now) const {
  if (!resting_) return now;
  Instant wake = now + kLongestWait;
  if (!options_.log_time && next_tick_) wake = std::min(wake, Instant(*next_tick_));
  return wake;
}

Micros LiveExecutor::node_time(Instant now) const {
  if (options_.log_time) return log_clock_.now();
  return std::chrono::duration_cast<Micros>(now.time_since_epoch());
}

void LiveExecutor::hand_over(const Mail& mail) {
  last_mail_ = mail.arrived;
  if (options_.log_time) {
    const std::int64_t jumps = log_clock_.jumps();
    if (const auto utime = peek_utime(mail.bytes)) log_clock_.advance(*utime, mail.channel);
    if (log_clock_.jumps() != jumps) inbox_.forget_order();  // the log begins again, or another one does
    fire_ticks(mail.arrived);
  }
  if (run_began_ == Instant{}) run_began_ = mail.arrived;
  const auto begin = std::chrono::steady_clock::now();
  if (mail.superseded > 0) inbox_.count_superseded(mail.channel, mail.superseded);
  inbox_.deliver(mail.channel, mail.bytes, node_time(begin));
  busy_ += std::chrono::steady_clock::now() - begin;
}

/// Lets log time run on a little where the log seems to have ended.
void LiveExecutor::run_on(Instant now, bool idle) {
  if (!idle || !log_clock_.started()) {
    ran_on_ = now + kLogSilence;
    return;
  }
  const Instant end = std::min(now, last_mail_ + kLogSilence + kLogRunOn);
  if (end <= ran_on_) return;
  log_clock_.run_on(std::chrono::duration_cast<Micros>(end - ran_on_));
  ran_on_ = end;
}

/// In log time every tick has its turn, as in a replay; live those that were missed are left out.
void LiveExecutor::fire_ticks(Instant now) {
  const Micros time = node_time(now);
  if (options_.log_time && !log_clock_.started()) return;
  if (!next_tick_) next_tick_ = time + node_.tick_period();
  while (*next_tick_ <= time) {
    const Micros due = options_.log_time ? *next_tick_ : time;
    const auto begin = std::chrono::steady_clock::now();
    guard("tick", [&] { node_.tick(due, out_); });
    busy_ += std::chrono::steady_clock::now() - begin;
    publish();
    const auto missed = options_.log_time ? 0 : (time - *next_tick_) / node_.tick_period();
    *next_tick_ += (1 + missed) * node_.tick_period();
  }
}

void LiveExecutor::step() {
  const Instant begin = std::chrono::steady_clock::now();
  if (run_began_ == Instant{}) run_began_ = begin;
  bool more = false;
  guard("step", [&] { more = node_.step(node_time(begin), *budget_, out_); });
  publish();
  const Instant end = std::chrono::steady_clock::now();
  busy_ += end - begin;
  resting_ = !more;
  if (more) return;
  if (published_) {
    steps_.add(busy_, end);
    responses_.add(end - run_began_, end);
  }
  published_ = false;
  busy_ = {};
  run_began_ = {};
}

void LiveExecutor::publish() {
  for (const EncodedMessage& message : out_.take()) {
    const bool sent = transport_.publish(message);
    if (message.channel == channel::kHealth) continue;
    ++(sent ? sent_ : not_sent_)[message.channel];
    published_ = true;
  }
}

bool LiveExecutor::guard(const char* doing, const std::function<void()>& work) {
  std::string what;
  try {
    work();
    return true;
  } catch (const std::exception& e) {
    what = e.what();
  } catch (...) {
    what = "unknown exception";
  }
  faults_.add(fmt::format("{} failed: {}", doing, what), std::chrono::steady_clock::now());
  return false;
}

void LiveExecutor::tell_health(Instant now) {
  if (now - last_look_ < kLookPeriod) return;
  last_look_ = now;
  const bool due = now - last_health_ >= kHealthPeriod;
  const health_t current = health(now);
  const bool changed = current.state != state_ || current.reason != reason_;
  if (changed && current.state != state_)
    options_.log(
        fmt::format("{}{}{}", name_of(current.state), current.reason.empty() ? "" : ": ", current.reason));
  if (!due && current.state == state_) return;
  state_ = current.state;
  reason_ = current.reason;
  guard("HEALTH", [&] { out_.publish(channel::kHealth, current); });
  publish();
}

health_t LiveExecutor::health(Instant now) {
  health_t health{};
  health.utime =
      std::chrono::duration_cast<Micros>(std::chrono::system_clock::now().time_since_epoch()).count();
  if (options_.log_time) health.utime = log_clock_.now().count();
  health.state = health_t::OK;
  health.config_hash = options_.config_hash;
  guard("report", [&] { node_.report(health); });
  add_rates(health, now);
  add_latency(health, "step", steps_.recent(now));
  add_latency(health, "response", responses_.recent(now));
  add_drops(health, inbox_.counts());
  for (const auto& [channel, count] : not_sent_) add_drop(health, channel + " not sent", count);
  add_drop(health, "bus errors", bus_errors_);
  faults_.report(health, now);
  rivals_.report(health, now);
  health.n_latencies = static_cast<std::int32_t>(health.latencies.size());  // whatever the node counted
  health.n_drops = static_cast<std::int32_t>(health.drops.size());
  make_printable(health);
  return health;
}

/// Counts since the start, and messages a second since the last periodic HEALTH.
void LiveExecutor::add_rates(health_t& health, Instant now) {
  std::map<std::string, std::int64_t> counts = sent_;
  for (const auto& [channel, c] : inbox_.counts()) counts[channel] = c.received;
  const double seconds = std::chrono::duration<double>(now - last_health_).count();
  if (now - last_health_ >= kHealthPeriod) {
    for (const auto& [channel, count] : counts)
      hz_[channel] = static_cast<float>(static_cast<double>(count - counts_before_[channel]) / seconds);
    counts_before_ = counts;
    last_health_ = now;
  }
  for (const auto& [channel, count] : counts) {
    rate_t rate;
    rate.channel = channel;
    rate.count = count;
    rate.hz = hz_[channel];
    health.rates.push_back(rate);
  }
  health.n_rates = static_cast<std::int32_t>(health.rates.size());
}

}  // namespace floornav
