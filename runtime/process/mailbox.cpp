#include "runtime/process/mailbox.hpp"

#include <algorithm>
#include <utility>

#include "runtime/process/message_header.hpp"

namespace floornav {

void Mailbox::open(const std::string& channel, Keep keep) {
  slots_[channel].keep = keep;
}

void Mailbox::put(std::string_view channel, std::span<const std::uint8_t> bytes) {
  Mail mail{std::string(channel), {bytes.begin(), bytes.end()}, std::chrono::steady_clock::now()};
  const std::lock_guard lock(mutex_);
  const auto place = slots_.find(channel);
  if (place == slots_.end()) return;
  Slot& slot = place->second;
  Held held{++order_, std::move(mail)};
  if (slot.keep == Keep::kLatest) {
    put_latest(slot, std::move(held));
  } else {
    put_all(slot, std::move(held));
  }
  arrived_.notify_one();
}

void Mailbox::put_latest(Slot& slot, Held held) {
  std::string source;
  if (const auto header = peek_header(held.mail.bytes)) source = header->source;
  if (!slot.latest.contains(source) && slot.latest.size() >= kMaxSources) source.clear();
  const auto [place, inserted] = slot.latest.try_emplace(source);
  if (inserted) {
    ++waiting_;
  } else {
    ++slot.superseded;
  }
  place->second = std::move(held);
}

void Mailbox::put_all(Slot& slot, Held held) {
  slot.bytes += held.mail.bytes.size();
  slot.held.push_back(std::move(held));
  ++waiting_;
  while (slot.held.size() > 1 && (slot.held.size() > kMaxMessages || slot.bytes > kMaxBytes)) {
    slot.bytes -= slot.held.front().mail.bytes.size();
    slot.held.pop_front();
    --waiting_;
    ++slot.superseded;
  }
}

void Mailbox::wake() {
  {
    const std::scoped_lock lock(mutex_);
    woken_ = true;
  }
  arrived_.notify_one();
}

std::vector<Mail> Mailbox::take(std::chrono::steady_clock::time_point deadline) {
  const auto earlier = [](const Held& a, const Held& b) { return a.order < b.order; };
  std::vector<Held> taken;
  {
    std::unique_lock lock(mutex_);
    arrived_.wait_until(lock, deadline, [this] { return waiting_ > 0 || woken_; });
    woken_ = false;
    for (auto& [channel, slot] : slots_) {
      const std::size_t first = taken.size();
      std::move(slot.held.begin(), slot.held.end(), std::back_inserter(taken));
      for (auto& [source, held] : slot.latest) taken.push_back(std::move(held));
      if (taken.size() == first) continue;
      const auto oldest =
          std::min_element(taken.begin() + static_cast<std::ptrdiff_t>(first), taken.end(), earlier);
      oldest->mail.superseded = std::exchange(slot.superseded, 0);
      slot.held.clear();
      slot.latest.clear();
      slot.bytes = 0;
    }
    waiting_ = 0;
  }
  std::sort(taken.begin(), taken.end(), earlier);
  std::vector<Mail> mail;
  mail.reserve(taken.size());
  for (Held& held : taken) mail.push_back(std::move(held.mail));
  return mail;
}

}  // namespace floornav
