// SPDX-License-Identifier: Apache-2.0
#include "server/driving/relay_queue.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

namespace homeward::server {

void RelayQueue::put_state(Outgoing state) { state_ = std::move(state); }

bool RelayQueue::put_view(Outgoing view) {
  const std::size_t size = view.bytes->size();
  if (size > kMostView_bytes || views_.size() >= kMostViews || bytes_ + size > kMost_bytes) return false;
  bytes_ += size;
  views_.push_back(std::move(view));
  return true;
}

std::optional<Outgoing> RelayQueue::next(SteadyTime now) {
  if (state_ && now >= next_state_at_) {
    next_state_at_ = now + kStatesApart;
    return std::exchange(state_, std::nullopt);
  }
  if (views_.empty() || now < next_view_at_) return std::nullopt;
  Outgoing view = std::move(views_.front());
  views_.pop_front();
  const std::size_t size = view.bytes->size();
  bytes_ -= size;
  next_view_at_ = now + std::max<std::chrono::microseconds>(
                            kViewsApart, std::chrono::microseconds(1'000'000 * size / kPerSecond_bytes));
  return view;
}

void RelayQueue::clear() {
  state_.reset();
  views_.clear();
  bytes_ = 0;
}

}  // namespace homeward::server
