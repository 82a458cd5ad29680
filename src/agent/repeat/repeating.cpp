// SPDX-License-Identifier: Apache-2.0
#include "agent/repeat/repeating.hpp"

#include <utility>
#include <variant>

#include "imageio/decode.hpp"

namespace homeward::agent {
namespace {

bool repeats(const driving::DrivingState& state) {
  return state.drive == wire::DriveState::kDriving && state.mission && state.mission->repeats;
}

}  // namespace

Repeating::Repeating(camera::CameraConfig camera, FetchesMap fetch, std::function<void(const std::string&)> log)
    : camera_(std::move(camera)),
      fetch_(std::move(fetch)),
      log_(std::move(log)),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

Repeating::~Repeating() {
  thread_.request_stop();
  thread_.join();
}

void Repeating::prepare(driving::Inputs& inputs, const driving::DrivingState& state) {
  const std::lock_guard lock(mutex_);
  if (!repeats(state) || !order_ || order_->mission != state.mission->id) return;
  // What is said of the path of an order is not for one that comes with this step.
  for (const wire::ServerMessage& message : inputs.messages) {
    if (std::holds_alternative<wire::RepeatOrder>(message)) return;
  }
  inputs.path_sight = std::exchange(sight_, std::nullopt);
  inputs.why_not_repeating = unusable_;
}

void Repeating::follow(const driving::Inputs& inputs, const recording::PictureBytes& picture,
                       const driving::DrivingState& state) {
  const std::lock_guard lock(mutex_);
  if (!repeats(state)) {
    order_.reset();
    newest_.reset();
    return;
  }
  for (const wire::ServerMessage& message : inputs.messages) {
    const auto* order = std::get_if<wire::RepeatOrder>(&message);
    if (order == nullptr || order->mission != state.mission->id) continue;
    order_ = *order;
    sight_.reset();
    unusable_.reset();
    newest_.reset();
    came_.notify_one();
  }
  if (!inputs.picture || !picture) return;
  newest_ = Taken{inputs.picture->taken_ms, inputs.picture->odometry, picture};
  came_.notify_one();
}

Result<driving::PathWatch> Repeating::take_up(const wire::RepeatOrder& order) try {
  if (!map_ || map_id_ != order.map || revision_ != order.revision) {
    auto fetched = fetch_(order.map);
    if (!fetched) return pass_on(fetched);
    map_ = *std::move(fetched);
    map_id_ = order.map;
    revision_ = order.revision;
  }
  return driving::PathWatch::create(map_, camera_, order.image, order.rounds);
} catch (const std::exception& trouble) {
  return fail(ErrorCode::kInternal, trouble.what(), "maps/" + order.map.str());
}

Result<driving::PathSight> Repeating::look(driving::PathWatch& watch, const Taken& taken) {
  try {
    const auto picture = imageio::decode(*taken.bytes, "picture");
    if (!picture) return pass_on(picture);
    return watch.see(*picture, taken.taken_ms, taken.odometry);
  } catch (const std::exception& trouble) {  // of the libraries that look
    return fail(ErrorCode::kInternal, trouble.what(), "picture");
  }
}

void Repeating::tell(const MissionId& mission, std::optional<driving::PathSight> sight,
                     const std::optional<Error>& error) {
  if (error && log_) log_("the taught path cannot be followed: " + error->message);
  const std::lock_guard lock(mutex_);
  if (!order_ || order_->mission != mission) return;
  if (sight) sight_ = std::move(sight);
  if (error) unusable_ = wire::reason_at(*error);
}

void Repeating::run(const std::stop_token& stop) {
  std::optional<MissionId> followed;
  std::optional<driving::PathWatch> watch;
  while (!stop.stop_requested()) {
    wire::RepeatOrder order;
    std::optional<Taken> taken;
    {
      std::unique_lock lock(mutex_);
      came_.wait(lock, stop, [&] { return order_ && (order_->mission != followed || (newest_ && !unusable_)); });
      if (stop.stop_requested()) return;
      order = *order_;
      if (order.mission == followed) taken = std::exchange(newest_, std::nullopt);
    }
    if (!taken) {
      followed = order.mission;
      auto taken_up = take_up(order);
      watch.reset();
      if (taken_up) {
        watch.emplace(*std::move(taken_up));
      } else {
        tell(order.mission, std::nullopt, taken_up.error());
      }
      continue;
    }
    if (!watch) continue;
    const auto sight = look(*watch, *taken);
    tell(order.mission, sight ? std::optional(*sight) : std::nullopt,
         sight ? std::nullopt : std::optional(sight.error()));
  }
}

}  // namespace homeward::agent
