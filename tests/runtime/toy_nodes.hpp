#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <utility>
#include <vector>

#include "floornav/goal_t.hpp"
#include "floornav/pose_t.hpp"
#include "runtime/process/node.hpp"

namespace floornav {

template <class Message>
EncodedMessage encoded(const std::string& channel, const Message& message) {
  EncodedMessage result{channel,
                        std::vector<std::uint8_t>(static_cast<std::size_t>(message.getEncodedSize()))};
  message.encode(result.bytes.data(), 0, static_cast<int>(result.bytes.size()));
  return result;
}

inline goal_t goal_of(std::int64_t session, std::int64_t seq, std::int64_t id = 0) {
  goal_t goal{};
  goal.utime = 1000 * seq;
  goal.source = "sender";
  goal.session = session;
  goal.seq = seq;
  goal.id = id;
  return goal;
}

/// Answers each goal of `input` on `output` with a goal of the same id, one a step, as far as its budget
/// allows, and writes down all that happens to it.
class EchoNode : public Node {
 public:
  EchoNode(std::string name, std::string input, std::string output, Keep keep = Keep::kAll)
      : name_(std::move(name)), input_(std::move(input)), output_(std::move(output)), keep_(keep) {}

  [[nodiscard]] std::string name() const override { return name_; }
  [[nodiscard]] std::vector<std::string> outputs() const override { return {output_}; }
  void subscribe(Inbox& inbox) override {
    inbox.subscribe<goal_t>(input_, keep_, [this](const goal_t& goal, Micros now) {
      note("accept " + std::to_string(goal.id), now);
      waiting_.push_back(goal.id);
    });
  }
  bool step(Micros now, Budget& budget, Outbox& out) override {
    if (waiting_.empty()) return false;
    goal_t answer{};
    answer.id = waiting_.front();
    waiting_.pop_front();
    budget.begin(now);
    if (budget.spend(work_ns)) {
      note("step " + std::to_string(answer.id), now);
      out.publish(output_, answer);
    } else {
      ++refused;
    }
    return !waiting_.empty();
  }
  void tick(Micros now, Outbox&) override { note("tick", now); }
  [[nodiscard]] Micros tick_period() const override { return period; }
  void report(health_t&) const override {}

  std::int64_t work_ns = 1000;
  int refused = 0;
  Micros period = std::chrono::milliseconds(100);
  std::vector<std::string> diary;

 protected:
  void note(const std::string& what, Micros now) {
    diary.push_back(what + " @" + std::to_string(now.count()));
  }

 private:
  std::string name_;
  std::string input_;
  std::string output_;
  Keep keep_;
  std::deque<std::int64_t> waiting_;
};

}  // namespace floornav
