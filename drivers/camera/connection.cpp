#include "drivers/camera/connection.hpp"

namespace floornav {

Connection::Action Connection::next(std::int64_t now_us, bool listed) {
  if (open_) {
    if (gone_) {
      library_tells_ = true;
      library_is_fresh_ = true;  // what comes back is a new device to it
      return close(now_us);
    }
    const std::int64_t patience_us = streaming_ ? periods_.silence_us : periods_.first_frame_us;
    return now_us - alive_us_ >= patience_us ? close(now_us) : Action::kNothing;
  }
  if (listed && library_is_fresh_) return Action::kOpen;
  if (!listed && library_tells_) return Action::kNothing;
  return now_us >= retry_us_ ? restart(now_us) : Action::kNothing;
}

void Connection::opened(std::int64_t now_us) {
  open_ = true;
  streaming_ = gone_ = library_is_fresh_ = false;
  alive_us_ = now_us;
}

void Connection::failed(std::int64_t now_us) {
  library_is_fresh_ = library_tells_ = false;
  retry_us_ = now_us + periods_.retry_us;
}

void Connection::frame(std::int64_t now_us) {
  streaming_ = true;
  alive_us_ = now_us;
}

Connection::Action Connection::close(std::int64_t now_us) {
  open_ = gone_ = false;
  retry_us_ = now_us;
  return Action::kClose;
}

Connection::Action Connection::restart(std::int64_t now_us) {
  library_is_fresh_ = true;
  retry_us_ = now_us + periods_.retry_us;
  return Action::kRestart;
}

}  // namespace floornav
