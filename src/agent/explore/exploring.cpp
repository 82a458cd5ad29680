// SPDX-License-Identifier: Apache-2.0
#include "agent/explore/exploring.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <utility>

#include "files/write_file.hpp"

namespace homeward::agent {
namespace {

using wire::ReasonCode;

constexpr driving::Milliseconds kSweepsKept_ms = 2000;
constexpr driving::Milliseconds kOdometryKept_ms = 1000;
// Odometry is not believed to go on where for so long nothing was seen, or no step was made,
constexpr driving::Milliseconds kSeesNothing_ms = 500;
constexpr driving::Milliseconds kHeldUp_ms = 2000;
// or where it says that the robot moved faster than any.
constexpr double kJump_m = 0.3;
constexpr double kJump_rad = 0.8;
constexpr std::size_t kMostFromCompanion = 16;  // messages that the thread has not got to
constexpr std::size_t kMostToCompanion = 16;    // and that the loop has not

bool explores(const driving::DrivingState& state) {
  return state.mission && state.mission->explores && state.drive == wire::DriveState::kDriving;
}

}  // namespace

Result<std::unique_ptr<Exploring>> Exploring::create(ThinkerOptions options, const camera::CameraConfig& camera,
                                                     const pipeline::Eye& eye) {
  if (const Status made = files::make_folder(options.folder); !made) return pass_on(made);
  auto lock = files::FolderLock::take(options.folder, "folder of explorations");
  if (!lock) return pass_on(lock);
  return std::unique_ptr<Exploring>(new Exploring(std::move(*lock), std::move(options), camera, eye));
}

Exploring::Exploring(files::FolderLock lock, ThinkerOptions options, const camera::CameraConfig& camera,
                     const pipeline::Eye& eye)
    : lock_(std::move(lock)),
      thinker_(std::move(options), camera, eye),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

Exploring::~Exploring() {
  thread_.request_stop();
  thread_.join();
}

std::optional<wire::Reason> Exploring::why_not(const wire::ExploreOrder& order) const {
  if (order.goes_on && from_.exploration != order.exploration) return wire::Reason{ReasonCode::kExplorationUnknown};
  if (!from_.uploads) return std::nullopt;
  return wire::reason_with(ReasonCode::kExplorationNotUploaded, "because", wire::in_words("They are on their way."));
}

void Exploring::prepare(driving::Inputs& inputs, const driving::DrivingState& state) const {
  const std::lock_guard lock(mutex_);
  bool ordered = false;
  for (const wire::ServerMessage& message : inputs.messages) {
    const auto* order = std::get_if<wire::ExploreOrder>(&message);
    if (order == nullptr) continue;
    inputs.why_not_exploring = why_not(*order);
    ordered = true;  // what is said of the mission before is not for that one
  }
  if (ordered || !explores(state) || state.mission->id != from_.mission) return;
  if (from_.odometry_epoch == odometry_epoch_) inputs.leg = from_.leg;
  inputs.exploration_over = from_.over;
}

/// With the mails locked.
void Exploring::note_orders(const driving::Inputs& inputs, const driving::DrivingState& state) {
  const bool follows = explores(state);
  if (followed_ && (!follows || state.mission->id != *followed_)) {
    followed_.reset();
    to_.commands.emplace_back(OrderEnded{state.reason});
  }
  for (const wire::ServerMessage& message : inputs.messages) {
    if (const auto* order = std::get_if<wire::ExploreOrder>(&message)) {
      if (!follows || order->mission != state.mission->id || followed_) continue;
      followed_ = order->mission;
      to_.commands.emplace_back(OrderObeyed{*order, odometry_epoch_, inputs.sensors_now_ms.value_or(0)});
    } else if (const auto* fences = std::get_if<wire::Fences>(&message)) {
      to_.commands.emplace_back(*fences);
    } else if (const auto* finish = std::get_if<wire::Finish>(&message)) {
      to_.commands.emplace_back(*finish);
    } else if (const auto* companion = std::get_if<wire::Companion>(&message)) {
      to_.commands.emplace_back(*companion);
    } else if (std::holds_alternative<wire::Welcome>(message)) {
      welcomed_ = true;
    }
  }
}

bool Exploring::odometry_goes_on(const driving::Inputs& inputs, const driving::DrivingState& state,
                                 driving::Milliseconds now_ms) const {
  if (state.displaced != displaced_ || !inputs.robot_link_up) return false;
  if (step_ms_ && now_ms - *step_ms_ > kHeldUp_ms) return false;
  const driving::Milliseconds sensors_ms = inputs.sensors_now_ms.value_or(now_ms);
  if (sweep_ms_ && sensors_ms - *sweep_ms_ > kSeesNothing_ms) return false;
  if (odometry_.empty()) return true;
  const Pose2 moved = inverse(odometry_.back().second) * inputs.odometry;
  return position_m(moved).norm() <= kJump_m && std::abs(moved.theta_rad) <= kJump_rad;
}

/// With the mails locked.
void Exploring::watch_odometry(const driving::Inputs& inputs, const driving::DrivingState& state,
                               driving::Milliseconds now_ms) {
  const driving::Milliseconds sensors_ms = inputs.sensors_now_ms.value_or(now_ms);
  if (!odometry_goes_on(inputs, state, now_ms)) {
    ++odometry_epoch_;
    odometry_.clear();
    to_.sweeps.clear();
  }
  displaced_ = state.displaced;
  step_ms_ = now_ms;
  if (inputs.scan) sweep_ms_ = inputs.scan->taken_ms;
  to_.odometry_epoch = odometry_epoch_;
  odometry_.emplace_back(sensors_ms, inputs.odometry);
  while (sensors_ms - odometry_.front().first > kOdometryKept_ms) odometry_.pop_front();
}

void Exploring::follow(const driving::Inputs& inputs, const recording::PictureBytes& picture,
                       const driving::DrivingState& state, driving::Milliseconds now_ms) {
  const std::lock_guard lock(mutex_);
  const std::size_t commands = to_.commands.size();
  watch_odometry(inputs, state, now_ms);
  note_orders(inputs, state);
  to_.link_up = inputs.link_up;
  if (followed_) to_.blocked = to_.blocked || state.leg.blocked;
  if (inputs.scan && followed_) {
    // A sweep is a moment old when it comes; it is of where the robot was then.
    const auto then = std::ranges::min_element(
        odometry_, {}, [&](const auto& at) { return std::abs(at.first - inputs.scan->taken_ms); });
    to_.sweeps.push_back({inputs.scan->taken_ms, inputs.scan->scan, then->second});
    while (to_.sweeps.back().sensors_ms - to_.sweeps.front().sensors_ms > kSweepsKept_ms) to_.sweeps.pop_front();
    new_sweep_ = true;
  }
  if (inputs.picture && inputs.picture->appearance && picture && followed_)
    to_.picture = SeenByCamera{*inputs.picture, picture};
  if (new_sweep_ || to_.commands.size() != commands) came_.notify_one();
}

void Exploring::hear(std::vector<FromCompanion> told) {
  if (told.empty()) return;
  const std::lock_guard lock(mutex_);
  std::ranges::move(told, std::back_inserter(to_.companion));
  if (to_.companion.size() > kMostFromCompanion)
    to_.companion.erase(to_.companion.begin(), to_.companion.end() - kMostFromCompanion);
  came_.notify_one();
}

std::vector<std::vector<std::uint8_t>> Exploring::take_to_companion() {
  const std::lock_guard lock(mutex_);
  return std::exchange(from_.to_companion, {});
}

bool Exploring::wants_features() const {
  const std::lock_guard lock(mutex_);
  return from_.wants_features;
}

std::shared_ptr<const std::vector<std::uint8_t>> Exploring::take_report() {
  const std::lock_guard lock(mutex_);
  const bool again = std::exchange(welcomed_, false);
  if (new_report_) {
    told_ = std::exchange(new_report_, nullptr);
  } else if (!again) {
    return nullptr;
  }
  return told_;
}

std::vector<wire::StateRow> Exploring::take_rows() {
  const std::lock_guard lock(mutex_);
  return std::exchange(from_.rows, {});
}

void Exploring::run(const std::stop_token& stop) {
  const auto tell = [this](FromThinker said) {
    // A large one takes a while to encode, which the loop must not wait for.
    std::shared_ptr<const std::vector<std::uint8_t>> report;
    if (said.report) {
      report = std::make_shared<const std::vector<std::uint8_t>>(wire::encode(wire::Explored{std::move(*said.report)}));
      said.report.reset();
    }
    const std::lock_guard lock(mutex_);
    std::vector<wire::StateRow> rows = std::exchange(from_.rows, {});
    rows.insert(rows.end(), said.rows.begin(), said.rows.end());
    auto to_companion = std::exchange(from_.to_companion, {});
    std::ranges::move(said.to_companion, std::back_inserter(to_companion));
    // Nobody takes them, or they would be old by the time that the link is up again.
    if (to_companion.size() > kMostToCompanion || !to_.link_up) to_companion.clear();
    from_ = std::move(said);
    from_.rows = std::move(rows);
    from_.to_companion = std::move(to_companion);
    if (report) new_report_ = std::move(report);
  };
  thinker_.take_up_kept(tell, stop);
  while (!stop.stop_requested()) {
    ToThinker mail;
    {
      std::unique_lock lock(mutex_);
      constexpr auto kLooksUpEvery = std::chrono::milliseconds(500);
      came_.wait_for(lock, stop, kLooksUpEvery,
                     [this] { return new_sweep_ || !to_.commands.empty() || !to_.companion.empty(); });
      mail.only_heard = !new_sweep_ && !to_.companion.empty();
      mail.commands = std::exchange(to_.commands, {});
      mail.companion = std::exchange(to_.companion, {});
      mail.picture = std::exchange(to_.picture, std::nullopt);
      mail.link_up = to_.link_up;
      mail.sweeps = to_.sweeps;
      mail.blocked = std::exchange(to_.blocked, false);
      mail.odometry_epoch = to_.odometry_epoch;
      if (!mail.commands.empty()) to_.sweeps.clear();  // odometry may have moved between orders
      new_sweep_ = false;
    }
    thinker_.think(mail, tell, stop);
  }
}

}  // namespace homeward::agent
