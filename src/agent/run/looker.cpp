// SPDX-License-Identifier: Apache-2.0
#include "agent/run/looker.hpp"

namespace homeward::agent {

Looker::Looker(driving::Driver& driver, const pipeline::Eye& eye, std::function<driving::Milliseconds()> now_ms,
               std::function<void(const recording::CameraPicture&)> show)
    : driver_(driver),
      eye_(eye),
      now_ms_(std::move(now_ms)),
      show_(std::move(show)),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

Looker::~Looker() {
  thread_.request_stop();
  thread_.join();
}

std::optional<LookedAt> Looker::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(newest_, std::nullopt);
}

std::optional<Error> Looker::trouble() {
  const std::lock_guard lock(mutex_);
  return trouble_;
}

void Looker::fail_with(const Error& error) {
  const std::lock_guard lock(mutex_);
  trouble_ = error;
}

void Looker::run(const std::stop_token& stop) {
  driving::Milliseconds shown_ms = -1'000'000;
  while (!stop.stop_requested()) {
    auto taken = driver_.next_picture(stop);
    if (!taken) return fail_with(taken.error());
    if (!*taken) return;
    const driving::Milliseconds taken_ms = now_ms_();
    const bool shown = taken_ms - shown_ms >= show_period_ms_;
    if (!shown && !looking_) continue;
    recording::CameraPicture picture = recording::as_sent(std::move(**taken));
    picture.recognised = features_wanted_;
    if (shown) {
      shown_ms = taken_ms;
      show_(picture);
    }
    if (!looking_) continue;
    auto seen = recording::look(picture, eye_);
    if (!seen) return fail_with(seen.error());
    const std::lock_guard lock(mutex_);
    newest_ = LookedAt{std::move(*seen), picture.bytes};
  }
}

}  // namespace homeward::agent
