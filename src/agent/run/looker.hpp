// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

#include "core/result.hpp"
#include "driving/driver.hpp"
#include "driving/inputs.hpp"
#include "pipeline/eye.hpp"
#include "recording/look.hpp"
#include "wire/lease_durations.hpp"

namespace homeward::agent {

/// A picture that was looked at, and the bytes that were.
struct LookedAt {
  driving::SeenPicture seen;
  recording::PictureBytes bytes;
};

/// Takes pictures from a driver in a thread of its own: what was seen for the driving step, JPEGs for the server.
class Looker {
 public:
  /// `now_ms`: the clock of the driving step. `show`: hears of a picture for the server, as often as `set_show_period`
  /// says.
  Looker(driving::Driver& driver, const pipeline::Eye& eye, std::function<driving::Milliseconds()> now_ms,
         std::function<void(const recording::CameraPicture&)> show);
  ~Looker();
  Looker(const Looker&) = delete;
  Looker& operator=(const Looker&) = delete;

  /// The newest picture that was not taken yet.
  std::optional<LookedAt> take();
  /// Whether pictures are looked at; standing robots need not.
  void set_looking(bool looking) { looking_ = looking; }
  /// Whether pictures are recognised; otherwise they are only made ready for tracking.
  void set_features_wanted(bool wanted) { features_wanted_ = wanted; }
  void set_show_period(driving::Milliseconds period_ms) { show_period_ms_ = period_ms; }
  /// Why there are no more pictures, when there are none.
  std::optional<Error> trouble();

 private:
  void run(const std::stop_token& stop);
  void fail_with(const Error& error);

  driving::Driver& driver_;
  const pipeline::Eye& eye_;
  std::function<driving::Milliseconds()> now_ms_;
  std::function<void(const recording::CameraPicture&)> show_;
  std::atomic<bool> looking_{false};
  std::atomic<bool> features_wanted_{true};
  std::atomic<driving::Milliseconds> show_period_ms_{wire::kFrameEvery_ms};
  std::mutex mutex_;
  std::optional<LookedAt> newest_;
  std::optional<Error> trouble_;
  std::jthread thread_;  // last: it uses all of the above
};

}  // namespace homeward::agent
