// SPDX-License-Identifier: Apache-2.0
#include "agent/run/agent_loop.hpp"

#include <sodium.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <memory>
#include <stop_token>
#include <utility>

#include "agent/drivers/joystick.hpp"
#include "agent/explore/exploring.hpp"
#include "agent/link/link_client.hpp"
#include "agent/repeat/fetch_map.hpp"
#include "agent/repeat/repeating.hpp"
#include "agent/run/looker.hpp"
#include "agent/run/real_time.hpp"
#include "agent/upload/upload.hpp"
#include "core/version.hpp"
#include "driving/follow.hpp"
#include "driving/stated.hpp"
#include "driving/step.hpp"
#include "pipeline/eye.hpp"
#include "recording/recorder.hpp"
#include "wire/lease_durations.hpp"

namespace homeward::agent {
namespace {

using Clock = std::chrono::steady_clock;
constexpr auto kCycle = std::chrono::milliseconds(40);
constexpr const char* kProgram = "homeward-agent";
constexpr const char* kNotInRealTime =
    "other programs on this computer may hold up the loop that drives, and then the robot stops: permit this program "
    "to run in real time (CAP_SYS_NICE, or a real-time priority limit of 10)";

/// Goes on while the machine sleeps, unlike the steady clock: one that wakes up knows that its permit has run out.
driving::Milliseconds now_ms() {
  timespec now{};
  ::clock_gettime(CLOCK_BOOTTIME, &now);
  return std::int64_t{now.tv_sec} * 1000 + now.tv_nsec / 1'000'000;
}

TimeUs now_us() {
  return std::chrono::duration_cast<std::chrono::microseconds>(std::chrono::system_clock::now().time_since_epoch())
      .count();
}

std::string random_session() {
  if (sodium_init() < 0) return "unknown";
  std::string text(16, '0');
  for (char& letter : text) letter = "0123456789abcdef"[randombytes_uniform(16)];
  return text;
}

wire::AgentStatus status_of(const driving::DrivingState& state, const driving::DrivingConfig& config,
                            const driving::Reading& reading, std::int64_t seq) {
  wire::AgentStatus status;
  status.seq = seq;
  status.t_us = now_us();
  status.state = state.drive;
  if (state.mission) status.mission = state.mission->id;
  status.epoch = state.newest.epoch;
  status.path_index = driving::stated_index(state);
  status.reason = state.reason;
  status.speed_mps = reading.speed_mps;
  if (state.drive == wire::DriveState::kDriving && state.seen.vector) {
    status.home =
        wire::HomeReport{state.seen.vector->bearing_rad, state.seen.vector->confidence, state.seen.vector->inliers};
  }
  status.min_range_m = state.min_range_m;
  status.vectors_per_s = static_cast<double>(state.answers_ms.size());
  status.arrival_probability = driving::stated_arrival(state, config);
  status.estimate = driving::stated_estimate(state, config);
  status.possible_places = driving::stated_places(state);
  status.question = driving::open_question(state, config, reading.t_ms);
  status.displaced = state.displaced;
  status.astray = state.drive == wire::DriveState::kFailed && state.astray;
  return status;
}

/// What the rider's joystick says: of two joysticks the one that is deflected.
std::optional<driving::JoystickReading> joystick_reading(const driving::Reading& reading, Joystick* joystick,
                                                         const driving::Body& body) {
  std::optional<driving::JoystickReading> hand = reading.rider;
  if (joystick == nullptr) return hand;
  const auto own = joystick->read(body, now_ms(), reading.t_ms);
  return own && (!hand || own->deflected) ? own : hand;
}

/// The driver stands still however the loop is left.
class StandStill {
 public:
  explicit StandStill(driving::Driver& driver) : driver_(driver) {}
  ~StandStill() { driver_.command({}); }
  StandStill(const StandStill&) = delete;
  StandStill& operator=(const StandStill&) = delete;

 private:
  driving::Driver& driver_;
};

/// What the driver's sensors say.
driving::Inputs sensed(const driving::Reading& reading) {
  driving::Inputs inputs;
  inputs.odometry = reading.odometry;
  inputs.sensors_now_ms = reading.t_ms;
  inputs.robot_link_up = reading.robot_link_up;
  if (reading.scan) inputs.scan = {reading.scan_t_ms.value_or(reading.t_ms), *reading.scan};
  return inputs;
}

/// Messages of the driving step, which knows no time of day.
void send(LinkClient& link, const std::vector<wire::AgentMessage>& messages) {
  for (wire::AgentMessage message : messages) {
    if (auto* stopped = std::get_if<wire::Stopped>(&message)) stopped->t_us = now_us();
    link.send(message);
  }
}

/// The joystick of the options; nothing if they name none.
Result<std::unique_ptr<Joystick>> open_joystick(const AgentOptions& options) {
  if (options.joystick.empty()) return std::unique_ptr<Joystick>();
  return Joystick::open(options.joystick, options.log);
}

/// What writes recordings; nothing if the options want none.
Result<std::unique_ptr<recording::Recorder>> open_recorder(const AgentOptions& options,
                                                           const camera::CameraConfig& camera,
                                                           const features::FeatureConfig& features,
                                                           const driving::DrivingConfig& config) {
  if (!options.record) return std::unique_ptr<recording::Recorder>();
  return recording::Recorder::create(*options.record, {name_with_version(kProgram), camera, features, config},
                                     options.log);
}

/// What explores; nothing if the options name no folder for that.
Result<std::unique_ptr<Exploring>> open_exploring(const AgentOptions& options, const camera::CameraConfig& camera,
                                                  const pipeline::Eye& eye, const driving::Body& body) {
  if (!options.explorations) return std::unique_ptr<Exploring>();
  ThinkerOptions thinker;
  thinker.folder = *options.explorations;
  thinker.explorer.reach.radius_m = body.outline.radius_m + body.outline.side_m;
  thinker.log = options.log;
  thinker.upload = [server = options.server, token = options.token](
                       const KeptFiles& kept, const std::string& name,
                       const std::function<bool(double)>& progress) -> Result<TourId> {
    RestClient client(server, token);
    auto sweeps = kept.sweeps();
    if (!sweeps) return pass_on(sweeps);
    UploadOptions upload;
    upload.folder = kept.tour_folder().string();
    upload.name = name;
    upload.own_name = true;  // it tells the exploration's id
    upload.sweeps = std::move(*sweeps);
    const auto uploaded = upload_tour(client, upload, progress);
    if (!uploaded) return pass_on(uploaded);
    return TourId(uploaded->id);
  };
  return Exploring::create(std::move(thinker), camera, eye);
}

/// What follows paths that were taught.
std::unique_ptr<Repeating> begin_repeating(const AgentOptions& options, const camera::CameraConfig& camera) {
  const auto fetch = [server = options.server, token = options.token](const MapId& map) {
    return fetch_map(server, token, map);
  };
  return std::make_unique<Repeating>(camera, fetch, options.log);
}

driving::DrivingConfig driving_config(const driving::Driver& driver, const features::FeatureConfig& features) {
  driving::DrivingConfig config;
  config.body = driver.body();
  config.feature_config_id = features::feature_config_id(features);
  return config;
}

wire::Hello hello_of(const AgentOptions& options, const camera::CameraConfig& camera, const driving::Body& body) {
  wire::Hello hello;
  hello.agent = name_with_version(kProgram);
  hello.robot_name = options.robot_name;
  hello.session = random_session();
  hello.camera = camera;
  hello.radius_m = std::min(wire::kMostRadius_m, swept_radius_m(body.outline));
  hello.max_speed_mps = body.max_speed_mps;
  hello.explores = options.explorations.has_value();
  hello.repeats = true;
  return hello;
}

void show_as_often_as_asked(const std::vector<wire::ServerMessage>& messages, Looker& looker) {
  for (const wire::ServerMessage& message : messages) {
    if (const auto* welcome = std::get_if<wire::Welcome>(&message)) looker.set_show_period(welcome->frame_period_ms);
  }
}

/// What the server says. What another robot told goes to what leads an exploration, and nowhere else.
std::vector<wire::ServerMessage> received(LinkClient& link, Exploring* exploring) {
  std::vector<wire::ServerMessage> messages = link.take_messages();
  auto told = take_from_companion(messages);
  if (exploring != nullptr) exploring->hear(std::move(told));
  return messages;
}

/// What leads an exploration, or holds pictures against a path, has its say before a step.
void lead(const Exploring* exploring, Repeating& repeating, driving::Inputs& inputs,
          const driving::DrivingState& state) {
  repeating.prepare(inputs, state);
  if (exploring != nullptr) return exploring->prepare(inputs, state);
  inputs.why_not_exploring = wire::Reason{wire::ReasonCode::kDoesNotExplore};
}

/// What it has decided since the step before, for a recording. To be taken also where there is none: it piles up.
std::vector<wire::StateRow> decided(Exploring* exploring) {
  return exploring != nullptr ? exploring->take_rows() : std::vector<wire::StateRow>();
}

/// And hears what came of it after the step. Whether features of pictures are wanted.
bool follow(Exploring* exploring, const driving::Inputs& inputs, const recording::PictureBytes& picture,
            const driving::DrivingState& state, driving::Milliseconds now, LinkClient& link) {
  if (exploring != nullptr) {
    exploring->follow(inputs, picture, state, now);
    if (link.up()) {
      if (const auto report = exploring->take_report()) link.send_encoded(*report);
      for (auto& message : exploring->take_to_companion()) link.send_encoded(std::move(message));
    }
  }
  if (state.mission && state.mission->repeats) return false;  // it is held against the path as it is
  if (state.mission && state.mission->explores) return exploring != nullptr && exploring->wants_features();
  return driving::wants_features(state.follow);
}

/// Says in the log and to the server how the robot fares: at each change, and every so often.
class Reporting {
 public:
  Reporting(const AgentOptions& options, LinkClient& link) : options_(options), link_(link) {}

  void report(const driving::DrivingState& state, const driving::DrivingConfig& config, const driving::Reading& reading,
              driving::Milliseconds now) {
    const bool changed = state.drive != state_;
    if (changed)
      options_.log(std::string(wire::drive_state_name(state.drive)) +
                   (state.reason ? ": " + wire::english(*state.reason) : ""));
    state_ = state.drive;
    const bool asks = driving::open_question(state, config, reading.t_ms).has_value();
    const bool asks_anew = asks != std::exchange(asks_, asks);
    if (changed || asks_anew || now - sent_ms_ >= wire::kStatusEvery_ms) {
      sent_ms_ = now;
      link_.send(status_of(state, config, reading, ++seq_));
    }
  }

 private:
  const AgentOptions& options_;
  LinkClient& link_;
  std::int64_t seq_ = 0;
  driving::Milliseconds sent_ms_ = 0;
  wire::DriveState state_ = wire::DriveState::kIdle;
  bool asks_ = false;
};

}  // namespace

Status run_agent(driving::Driver& driver, const AgentOptions& options, const std::stop_token& stop) {
  const auto camera = camera::Camera::create(driver.camera());
  if (!camera) return pass_on(camera);
  const features::FeatureConfig features = pipeline::suited_feature_config(**camera);
  const auto eye = pipeline::Eye::create(driver.camera(), features);
  if (!eye) return pass_on(eye);
  const driving::DrivingConfig config = driving_config(driver, features);
  const auto joystick = open_joystick(options);
  if (!joystick) return pass_on(joystick);
  const auto exploring = open_exploring(options, driver.camera(), *eye, config.body);
  if (!exploring) return pass_on(exploring);

  const auto repeating = begin_repeating(options, driver.camera());
  const StandStill at_the_end(driver);
  LinkClient link(options.server, options.robot, options.token, hello_of(options, driver.camera(), config.body),
                  options.log);
  std::int64_t frame_seq = 0;
  Looker looker(driver, *eye, now_ms, [&](const recording::CameraPicture& picture) {
    if (link.up()) link.send(wire::Frame{++frame_seq, now_us(), *picture.bytes, picture.odometry});
  });
  const auto recorder = open_recorder(options, driver.camera(), features, config);
  if (!recorder) return pass_on(recorder);

  if (!run_in_real_time()) options.log(kNotInRealTime);
  driving::DrivingState state;
  Reporting reporting(options, link);
  auto next_cycle = Clock::now();
  while (!stop.stop_requested()) {
    if (auto trouble = looker.trouble()) return tl::unexpected<Error>(*trouble);
    const driving::Reading reading = driver.read();
    driving::Inputs inputs = sensed(reading);
    inputs.rider = joystick_reading(reading, joystick->get(), config.body);
    inputs.link_up = link.up();
    inputs.messages = received(link, exploring->get());
    recording::PictureBytes picture;
    if (auto looked_at = looker.take()) {
      inputs.picture = std::move(looked_at->seen);
      picture = std::move(looked_at->bytes);
    }
    const driving::Milliseconds now = now_ms();
    show_as_often_as_asked(inputs.messages, looker);
    lead(exploring->get(), *repeating, inputs, state);
    auto rows = decided(exploring->get());
    const driving::Outputs outputs = *recorder ? (*recorder)->step(state, inputs, picture, now, std::move(rows))
                                               : driving::step(state, inputs, config, now);
    // Frozen while it thought, it must not do what it thought before; the next step says why it stopped.
    const bool held_up = now_ms() - now > config.loop_silence_ms;
    driver.command(held_up ? driving::Motion{} : outputs.motion);
    send(link, outputs.messages);
    repeating->follow(inputs, picture, state);
    looker.set_looking(state.drive == wire::DriveState::kDriving);
    looker.set_features_wanted(follow(exploring->get(), inputs, picture, state, now, link));
    reporting.report(state, config, reading, now);
    if (Clock::now() >= next_cycle) next_cycle = std::max(next_cycle + kCycle, Clock::now());
    // What is received is obeyed at once, and its silence counts from when it came.
    link.wait_for_message(next_cycle);
  }
  return {};
}

}  // namespace homeward::agent
