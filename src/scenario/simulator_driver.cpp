// SPDX-License-Identifier: Apache-2.0
#include "scenario/simulator_driver.hpp"

#include <chrono>
#include <condition_variable>
#include <fstream>
#include <mutex>
#include <nlohmann/json.hpp>
#include <utility>

#include "files/read_file.hpp"
#include "scenario/shared_world.hpp"
#include "scenario/usual_cameras.hpp"
#include "scenario/world_folder.hpp"
#include "sim/tour_path.hpp"

namespace homeward::scenario {
namespace {

using Clock = std::chrono::steady_clock;
constexpr auto kPicturePeriod = std::chrono::milliseconds(100);
constexpr auto kSharedPeriod = std::chrono::milliseconds(100);
constexpr auto kTruthPeriod = std::chrono::milliseconds(30);
constexpr double kPictureLife_s = 0.12;
// A motion command expires by itself: the wheels stop when the loop above them hangs.
constexpr auto kCommandLife = std::chrono::milliseconds(100);

class SimulatorDriver final : public driving::Driver {
 public:
  SimulatorDriver(std::unique_ptr<sim::LitWorld> world, SimulatedRobot robot, SimulatedRobotConfig config,
                  const driving::Body& body, std::optional<SharedWorld> shared, const SimulatorDriverConfig& driver)
      : world_(std::move(world)),
        robot_(std::move(robot)),
        config_(std::move(config)),
        body_(body),
        shared_(std::move(shared)),
        rider_(driver.rider) {
    const std::string& truth_file = driver.truth_file;
    if (!truth_file.empty()) truth_.open(truth_file, std::ios::app);
  }

  [[nodiscard]] const camera::CameraConfig& camera() const override { return config_.camera; }
  [[nodiscard]] driving::Body body() const override { return body_; }

  driving::Reading read() override {
    const std::lock_guard lock(mutex_);
    const auto now = Clock::now();
    if (now - commanded_ > kCommandLife) {
      obey({}, now);
    }
    constexpr double kLongestStep_s = 0.1;
    double seconds = std::min(kLongestStep_s, std::chrono::duration<double>(now - advanced_).count());
    advanced_ = now;
    // A robot under way sees ten pictures a second of its own time: where rendering cannot keep up, its time waits.
    if (moves_) seconds = std::min(seconds, until_picture_s_);
    until_picture_s_ -= seconds;
    if (seconds > 0.0) robot_.advance(seconds);
    see_others(now);
    tell_truth(now);
    return {simulated_ms(), robot_.odometry(), robot_.vehicle().motion().speed_mps,
            robot_.sweep(), std::nullopt,      rider_ ? rider_(simulated_ms()) : std::nullopt};
  }

  void command(const driving::Motion& motion) override {
    const std::lock_guard lock(mutex_);
    commanded_ = Clock::now();
    obey(motion, commanded_);
  }

  Result<std::optional<driving::TakenPicture>> next_picture(std::stop_token stop) override {
    std::unique_lock lock(mutex_);
    // Waiting on a condition that nobody signals: a sleep that `stop` can end.
    pause_.wait_until(lock, stop, pictured_ + kPicturePeriod, [] { return false; });
    if (stop.stop_requested()) return std::optional<driving::TakenPicture>();
    pictured_ = Clock::now();
    until_picture_s_ = kPictureLife_s;
    const SimulatedRobot::View view = robot_.view();
    const driving::Milliseconds taken_ms = simulated_ms();
    lock.unlock();
    return std::optional(driving::TakenPicture{taken_ms, robot_.render(view), view.odometry, {}});
  }

 private:
  [[nodiscard]] driving::Milliseconds simulated_ms() const {
    return static_cast<driving::Milliseconds>(1000.0 * robot_.seconds());
  }

  void obey(const driving::Motion& motion, Clock::time_point now) {
    const bool moved = std::exchange(moves_, motion.speed_mps != 0.0 || motion.turn_radps != 0.0);
    commanded_motion_ = motion;
    robot_.command(motion);
    if (moved && !moves_) reported_ = {};  // the moment of a stop is reported at once
    if (moved != moves_) tell_truth(now);
  }

  void see_others(Clock::time_point now) {
    if (!shared_ || now - shared_at_ < kSharedPeriod) return;
    shared_at_ = now;
    robot_.set_boxes(shared_->exchange(box_of(robot_)));
  }

  void tell_truth(Clock::time_point now) {
    if (!truth_.is_open() || now - reported_ < kTruthPeriod) return;
    reported_ = now;
    const sim::Vehicle& vehicle = robot_.vehicle();
    const auto t_us =
        std::chrono::duration_cast<std::chrono::microseconds>(std::chrono::system_clock::now().time_since_epoch())
            .count();
    const nlohmann::json line = {{"t_us", t_us},
                                 {"x_m", vehicle.pose().x_m},
                                 {"y_m", vehicle.pose().y_m},
                                 {"theta_rad", vehicle.pose().theta_rad},
                                 {"speed_mps", vehicle.motion().speed_mps},
                                 {"turn_radps", vehicle.motion().turn_radps},
                                 {"commanded_mps", commanded_motion_.speed_mps},
                                 {"commanded_radps", commanded_motion_.turn_radps},
                                 {"collisions", vehicle.collisions()}};
    truth_ << line.dump() << std::endl;
  }

  std::unique_ptr<sim::LitWorld> world_;
  SimulatedRobot robot_;
  SimulatedRobotConfig config_;
  driving::Body body_;
  std::optional<SharedWorld> shared_;
  std::function<std::optional<driving::JoystickReading>(driving::Milliseconds)> rider_;
  std::ofstream truth_;
  std::mutex mutex_;
  std::condition_variable_any pause_;
  Clock::time_point advanced_ = Clock::now();
  Clock::time_point commanded_ = Clock::now();
  Clock::time_point pictured_ = Clock::now();
  Clock::time_point reported_;
  Clock::time_point shared_at_;
  driving::Motion commanded_motion_;
  bool moves_ = false;
  double until_picture_s_ = kPictureLife_s;  // that simulated time may still pass before the next picture
};

}  // namespace

Result<std::unique_ptr<driving::Driver>> make_simulator_driver(const SimulatorDriverConfig& config) {
  SimulatedRobotConfig robot_config;
  robot_config.people = config.people;
  robot_config.seed = config.seed;
  robot_config.profile = config.robot == "chair" ? sim::chair_profile() : sim::disc_profile();
  if (config.ranges == "ultrasound") robot_config.profile.ranges = sim::RangeSensor::kUltrasound;
  if (const auto usual = usual_camera(config.camera)) {
    robot_config.camera = *usual;
  } else {
    const auto camera = files::read_camera(config.camera);
    if (!camera) return pass_on(camera);
    robot_config.camera = *camera;
  }
  const auto light = light_named(config.light);
  if (!light) return pass_on(light);
  robot_config.light = *light;
  auto loaded = load_world(config.world);
  if (!loaded) return pass_on(loaded);
  auto world = std::make_unique<sim::LitWorld>(std::move(*loaded));
  Pose2 start = world->world().start;
  if (config.start) {
    start = *config.start;
  } else if (!config.start_room.empty()) {
    const auto point = sim::room_point(world->world(), config.start_room);
    if (!point) return pass_on(point);
    start = {point->x(), point->y(), 0.0};
  }
  prepare_light(*world, *light);
  auto robot = SimulatedRobot::create(*world, robot_config, start);
  if (!robot) return pass_on(robot);
  const driving::Body body = body_of(robot_config.profile);
  std::optional<SharedWorld> shared;
  if (!config.shared_world.empty()) {
    auto joined = SharedWorld::join(config.shared_world);
    if (!joined) return pass_on(joined);
    shared.emplace(std::move(*joined));
  }
  return std::make_unique<SimulatorDriver>(std::move(world), std::move(*robot), std::move(robot_config), body,
                                           std::move(shared), config);
}

}  // namespace homeward::scenario
