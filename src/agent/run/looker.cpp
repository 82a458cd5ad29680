// SPDX-License-Identifier: Apache-2.0
#include "agent/run/looker.hpp"

namespace homeward::agent {

Looker::Looker(Driver& driver, const pipeline::Eye& eye, std::function<Milliseconds()> now_ms,
               std::function<void(const TakenPicture&)> show)
    : driver_(driver),
      eye_(eye),
      now_ms_(std::move(now_ms)),
      show_(std::move(show)),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

Looker::~Looker() {
  thread_.request_stop();
  thread_.join();
}

std::optional<SeenPicture> Looker::take() {
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
  Milliseconds shown_ms = -1'000'000;
  while (!stop.stop_requested()) {
    auto taken = driver_.next_picture(stop);
    if (!taken) return fail_with(taken.error());
    if (!*taken) return;
    const Milliseconds taken_ms = now_ms_();
    if (taken_ms - shown_ms >= show_period_ms_) {
      shown_ms = taken_ms;
      show_(**taken);
    }
    if (!looking_) continue;
    auto appearance = eye_.look((*taken)->picture);
    if (!appearance) return fail_with(appearance.error());
    const std::lock_guard lock(mutex_);
    newest_ = {(*taken)->t_ms, std::make_shared<const features::Appearance>(std::move(*appearance)),
               (*taken)->odometry.value_or(Pose2{})};
  }
}

}  // namespace homeward::agent
