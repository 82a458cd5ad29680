// SPDX-License-Identifier: Apache-2.0
#include "agent/drivers/rosbridge_driver.hpp"

#include <bit>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <thread>

#include "agent/drivers/odometry_track.hpp"
#include "agent/drivers/range_ring.hpp"
#include "agent/drivers/ros_messages.hpp"
#include "agent/link/json_socket.hpp"
#include "files/read_file.hpp"
#include "imageio/decode.hpp"

namespace homeward::agent {
namespace {

using Clock = std::chrono::steady_clock;
constexpr auto kPublishPeriod = std::chrono::milliseconds(50);
// Some cycles of the agent's: a loop above that hangs has the robot brake, long before the base does so by itself.
constexpr driving::Milliseconds kCommandLife_ms = 150;
constexpr driving::Milliseconds kZerosAfterMotion_ms = 1000;  // said again and again: the bridge keeps no count
constexpr double kAtRest_mps = 0.005;                         // of a joystick; what is less is no hand
constexpr double kAtRest_radps = 0.01;
constexpr driving::Milliseconds kOdometrySilence_ms = 400;
constexpr driving::Milliseconds kOdometryPeriod_ms = 100;  // of the slowest that is asked for
constexpr driving::Milliseconds kMostLag_ms = 300;
constexpr driving::Milliseconds kRingLife_ms = 400;  // of a ring's sweep beside a scanner's
constexpr double kBlindBeyond_m = 0.05;              // what is kept free beside the body anyway
// Longer than the agent bears without sweeps: after a lost connection it stops for certain.
constexpr driving::Milliseconds kWithheld_ms = 600;
constexpr driving::Milliseconds kSuspicious_ms = 5000;
constexpr auto kFarewellLimit = std::chrono::milliseconds(1000);

/// Goes on while the computer is suspended, so that what was said before is old when it wakes up.
driving::Milliseconds now_ms() {
  timespec now{};
  ::clock_gettime(CLOCK_BOOTTIME, &now);
  return driving::Milliseconds{now.tv_sec} * 1000 + now.tv_nsec / 1'000'000;
}

bool stands(const driving::Motion& motion) { return motion.speed_mps == 0.0 && motion.turn_radps == 0.0; }

/// Foreign text for a log line.
std::string shown(std::string text) {
  text.resize(std::min<std::size_t>(text.size(), 200));
  for (char& c : text) {
    if (c < 0x20 || c > 0x7E) c = '?';
  }
  return text;
}

/// One topic that is listened to.
struct Feed {
  driving::Milliseconds arrived_ms = 0;
  RosStamp stamp_us;
  bool missed = false;  // its absence was logged

  /// Whether this is a new message, not one that a bridge or node said before.
  bool take(RosStamp stamp, driving::Milliseconds now) {
    if (stamp && stamp == stamp_us) return false;
    stamp_us = stamp;
    arrived_ms = now;
    missed = false;
    return true;
  }
};

class RosbridgeDriver final : public driving::Driver {
 public:
  RosbridgeDriver(wire::RosbridgeFile robot, camera::CameraConfig camera, const ServerAddress& address,
                  std::function<void(const std::string&)> log)
      : robot_(std::move(robot)),
        camera_(std::move(camera)),
        body_(body_of(robot_.body)),
        log_(std::move(log)),
        range_feeds_(robot_.ranges.size()),
        ring_(robot_.ranges) {
    body_.vague_ranges = !ring_.empty();
    if (const int uncovered_deg = ring_.uncovered_deg(); !robot_.scan && uncovered_deg > 0) {
      log_("the ring of range sensors covers nothing in " + std::to_string(uncovered_deg) +
           " of the 360 degrees around the robot: whoever steps in there is not seen");
    }
    JsonSocket::Events events;
    events.greeting = [this] { return greeting(); };
    events.arrived = [this](std::string_view text) { arrived(text); };
    events.lost = [this] { lost(); };
    events.log = log_;
    socket_ = std::make_unique<JsonSocket>(address, kMaxRosMessageBytes, std::move(events));
    publisher_ = std::jthread([this](const std::stop_token& stop) { publish(stop); });
  }

  ~RosbridgeDriver() override {
    publisher_.request_stop();
    publisher_.join();
    socket_->finish(ros_farewell(robot_), kFarewellLimit);
    socket_.reset();
  }
  RosbridgeDriver(const RosbridgeDriver&) = delete;
  RosbridgeDriver& operator=(const RosbridgeDriver&) = delete;

  [[nodiscard]] const camera::CameraConfig& camera() const override { return camera_; }
  [[nodiscard]] driving::Body body() const override { return body_; }

  driving::Reading read() override {
    const bool live = socket_->up() && socket_->lag().count() <= kMostLag_ms;
    const std::lock_guard lock(mutex_);
    driving::Reading reading;
    reading.t_ms = now_ms();
    reading.odometry = track_.at(std::nullopt);
    reading.speed_mps = speed_mps_;
    reading.rider = rider_;
    // A touch that is over already counts too.
    if (std::exchange(touched_, false) && reading.rider) reading.rider->deflected = true;
    std::optional<driving::Scan> sweep = std::exchange(sweep_, std::nullopt);
    if (!live || interrupted_ || reading.t_ms - odom_.arrived_ms > kOdometrySilence_ms) return reading;
    reading.scan = std::move(sweep);
    // A sweep says nothing of where the robot has got to since its wheels fell silent: it counts as old as their word.
    reading.scan_t_ms = std::min(sweep_ms_, odom_.arrived_ms + kOdometryPeriod_ms);
    return reading;
  }

  void command(const driving::Motion& motion) override {
    const std::lock_guard lock(mutex_);
    commanded_ms_ = now_ms();
    if (interrupted_ && stands(motion) && commanded_ms_ >= withheld_until_ms_) interrupted_ = false;
    const driving::Motion obeyed = interrupted_ ? driving::Motion{} : motion;
    const bool stops = stands(obeyed) && !stands(command_);
    command_ = obeyed;
    if (!stops) return;
    at_once_ = true;
    changed_.notify_all();
  }

  Result<std::optional<driving::TakenPicture>> next_picture(std::stop_token stop) override {
    while (true) {
      std::unique_lock lock(mutex_);
      if (!changed_.wait(lock, stop, [this] { return picture_.has_value(); }))
        return std::optional<driving::TakenPicture>();
      const RosPicture sent = std::move(*picture_);
      picture_.reset();
      driving::TakenPicture taken{image_.arrived_ms, {}, track_.at(sent.stamp_us), {}};
      lock.unlock();
      auto picture = decoded(sent.bytes);
      if (!picture) {
        complain(picture.error());
        continue;
      }
      const auto header = imageio::read_header(sent.bytes);
      if (header && header->format == imageio::ImageFormat::kJpeg) taken.jpeg = sent.bytes;
      taken.picture = std::move(*picture);
      return std::optional(std::move(taken));
    }
  }

 private:
  [[nodiscard]] Result<Image> decoded(const std::vector<std::uint8_t>& bytes) const {
    // Nothing larger than the camera is worth decoding.
    imageio::DecodeLimits limits;
    limits.max_bytes = kMaxRosMessageBytes;
    limits.max_pixels = std::int64_t{camera_.width_px} * camera_.height_px;
    auto picture = imageio::decode(bytes, robot_.image.topic, limits);
    if (picture && (picture->width_px != camera_.width_px || picture->height_px != camera_.height_px)) {
      return fail(ErrorCode::kWrongImageSize,
                  "The picture has " + std::to_string(picture->width_px) + " x " + std::to_string(picture->height_px) +
                      " pixels, its camera.json says " + std::to_string(camera_.width_px) + " x " +
                      std::to_string(camera_.height_px) + ".",
                  robot_.image.topic);
    }
    return picture;
  }

  std::vector<std::string> greeting() {
    std::vector<std::string> texts = ros_greeting(robot_);
    const std::lock_guard lock(mutex_);
    connected_ms_ = now_ms();
    // A base that was left moving when the connection broke is told to stand before anything else.
    if (moved_) {
      texts.push_back(ros_motion(robot_, {}));
      zeros_until_ms_ = connected_ms_ + kZerosAfterMotion_ms;
    }
    return texts;
  }

  void lost() {
    const std::lock_guard lock(mutex_);
    interrupted_ = true;
    withheld_until_ms_ = now_ms() + kWithheld_ms;
    command_ = {};
    sweep_.reset();
    ring_.forget();
    ring_sweep_.reset();
    rider_.reset();
    track_.clear();
  }

  void arrived(std::string_view text) {
    auto message = decode_ros_message(text, robot_);
    if (!message) return complain(message.error());
    if (const auto* status = std::get_if<RosStatus>(&*message)) return tell_status(*status);
    const driving::Milliseconds now = now_ms();
    bool blind = false;
    double blind_beyond_m = 0.0;
    {
      const std::lock_guard lock(mutex_);
      if (auto* odometry = std::get_if<RosOdometry>(&*message)) {
        if (!odom_.take(odometry->stamp_us, now)) return;
        track_.add(odometry->stamp_us, odometry->pose);
        speed_mps_ = odometry->speed_mps;
      } else if (auto* sweep = std::get_if<RosSweep>(&*message)) {
        // Within a house something is always in reach: a sweep without any return is that of a covered scanner.
        blind = std::none_of(sweep->scan.ranges_m.begin(), sweep->scan.ranges_m.end(),
                             [](float range_m) { return std::isfinite(range_m); });
        blind_beyond_m = sweep->blind_beyond_m;
        if (!blind && scan_.take(sweep->stamp_us, now)) take_sweep(std::move(sweep->scan), now);
      } else if (const auto* range = std::get_if<RosRange>(&*message)) {
        take_range(*range, now);
      } else if (const auto* twist = std::get_if<RosTwist>(&*message)) {
        take_hand(twist->motion, now);
      } else if (auto* picture = std::get_if<RosPicture>(&*message)) {
        if (!image_.take(picture->stamp_us, now)) return;
        picture_ = std::move(*picture);
        changed_.notify_all();
      }
    }
    if (blind_beyond_m > kBlindBeyond_m && !std::exchange(blindness_told_, true)) {
      log_("the scanner on " + robot_.scan->topic + " is blind to what is nearer than its range_min, up to " +
           std::to_string(std::lround(100.0 * blind_beyond_m)) +
           " cm beyond the body: whoever steps in there is not seen; add a scanner that sees them");
    }
    if (blind) complain({ErrorCode::kEmptyInput, "The sweep saw nothing at all.", robot_.scan->topic});
  }

  /// The mutex is held. A scanner beside which there is a ring says nothing alone.
  void take_sweep(driving::Scan scan, driving::Milliseconds now) {
    if (ring_.empty()) {
      sweep_ = std::move(scan);
      sweep_ms_ = now;
    } else if (ring_sweep_ && now - ring_sweep_->taken_ms <= kRingLife_ms) {
      sweep_ = with_ring(scan, *ring_sweep_, track_.at(std::nullopt));
      sweep_ms_ = std::min(now, ring_sweep_->taken_ms);
    }
  }

  /// The mutex is held.
  void take_range(const RosRange& range, driving::Milliseconds now) {
    if (odom_.arrived_ms == 0 || !range_feeds_[range.sensor].take(range.stamp_us, now)) return;
    ring_.add(range, now, track_.at(range.stamp_us));
    auto round = ring_.sweep(now, track_.at(std::nullopt));
    if (!round) return;
    if (robot_.scan) {
      ring_sweep_ = std::move(round);
      return;
    }
    sweep_ = std::move(round->scan);
    sweep_ms_ = round->taken_ms;
  }

  /// The mutex is held.
  void take_hand(const driving::Motion& motion, driving::Milliseconds now) {
    const bool deflected = std::abs(motion.speed_mps) > kAtRest_mps || std::abs(motion.turn_radps) > kAtRest_radps;
    touched_ = touched_ || deflected;
    rider_ = driving::JoystickReading{now, deflected, deflected && robot_.rider->relayed ? motion : driving::Motion{}};
  }

  void tell_status(const RosStatus& status) {
    if (status.level != "error" && status.level != "warning") return;
    const int count = ++statuses_;
    if (std::has_single_bit(static_cast<unsigned>(count))) log_("the rosbridge says: " + shown(status.text));
  }

  /// Tells of the first, second, fourth, eighth ... message that is of no use.
  void complain(const Error& error) {
    const int count = ++useless_;
    if (!std::has_single_bit(static_cast<unsigned>(count))) return;
    log_(std::to_string(count) + (count == 1 ? " message" : " messages") +
         " of no use; the last: " + shown(error.message) + " (" + shown(error.where) + ")");
  }

  void publish(const std::stop_token& stop) {
    auto next = Clock::now();
    while (!stop.stop_requested()) {
      next = std::max(next + kPublishPeriod, Clock::now());
      std::optional<driving::Motion> motion;
      Clock::time_point good_until;
      {
        std::unique_lock lock(mutex_);
        changed_.wait_until(lock, stop, next, [this] { return at_once_; });
        at_once_ = false;
        const driving::Milliseconds now = now_ms();
        if (now - commanded_ms_ > kCommandLife_ms) command_ = {};
        if (!stands(command_)) {
          moved_ = true;
          zeros_until_ms_ = now + kZerosAfterMotion_ms;
        }
        // Silent while it stands, so that others may drive the base by hand.
        if (now < zeros_until_ms_) motion = command_;
        // Standing is right however late it is said.
        constexpr std::chrono::milliseconds kLife(kCommandLife_ms);
        good_until = stands(command_) ? Clock::time_point::max() : Clock::now() + kLife;
      }
      if (motion) socket_->send_newest(ros_motion(robot_, *motion), good_until);
      if (socket_->up()) tell_of_missing();
    }
  }

  void tell_of_missing() {
    std::vector<std::pair<Feed*, const wire::RosTopic*>> feeds = {{&odom_, &robot_.odom}, {&image_, &robot_.image}};
    if (robot_.scan) feeds.emplace_back(&scan_, &*robot_.scan);
    for (std::size_t i = 0; i < robot_.ranges.size(); ++i)
      feeds.emplace_back(&range_feeds_[i], &robot_.ranges[i].topic);
    for (const auto& [feed, topic] : feeds) {
      {
        const std::lock_guard lock(mutex_);
        const driving::Milliseconds since_ms = std::max(feed->arrived_ms, connected_ms_);
        if (feed->missed || now_ms() - since_ms < kSuspicious_ms) continue;
        feed->missed = true;
      }
      log_("nothing comes on " + topic->topic + " (" + topic->type + ")");
    }
  }

  wire::RosbridgeFile robot_;
  camera::CameraConfig camera_;
  driving::Body body_;
  std::function<void(const std::string&)> log_;
  bool blindness_told_ = false;  // of the socket's thread alone
  std::atomic<int> useless_{0};
  std::atomic<int> statuses_{0};

  std::mutex mutex_;  // of all that follows
  std::condition_variable_any changed_;
  Feed odom_;
  Feed scan_;
  Feed image_;
  std::vector<Feed> range_feeds_;  // by sensor of the ring
  RangeRing ring_;
  std::optional<RingSweep> ring_sweep_;  // the latest, where there is a scanner too
  OdometryTrack track_;
  double speed_mps_ = 0.0;
  std::optional<driving::Scan> sweep_;
  driving::Milliseconds sweep_ms_ = 0;  // when it was taken
  std::optional<RosPicture> picture_;
  std::optional<driving::JoystickReading> rider_;
  bool touched_ = false;  // the hand was there at some moment since the last reading
  driving::Motion command_;
  driving::Milliseconds commanded_ms_ = 0;
  driving::Milliseconds connected_ms_ = 0;
  driving::Milliseconds zeros_until_ms_ = 0;
  driving::Milliseconds withheld_until_ms_ = 0;
  bool interrupted_ = false;  // a connection was lost, and the agent has not stood still since
  bool moved_ = false;
  bool at_once_ = false;

  std::unique_ptr<JsonSocket> socket_;  // these two last: they use all of the above
  std::jthread publisher_;
};

}  // namespace

Result<std::unique_ptr<driving::Driver>> make_rosbridge_driver(const std::string& file,
                                                               std::function<void(const std::string&)> log) {
  const auto text = files::read_text(file);
  if (!text) return pass_on(text);
  auto robot = wire::parse_rosbridge(*text, file);
  if (!robot) return pass_on(robot);
  const auto address = parse_websocket_address(robot->address);
  if (!address) return pass_on(address);
  if (!robot->scan && !RangeRing(robot->ranges).covers_ahead()) {
    return fail(
        ErrorCode::kInvalidInput,
        "A ring without a scanner must cover all within 30 degrees of straight ahead, where the robot drives to.",
        file + "/ranges");
  }
  auto camera = files::read_camera(std::filesystem::path(file).parent_path() / robot->camera);
  if (!camera) return pass_on(camera);
  return std::make_unique<RosbridgeDriver>(std::move(*robot), std::move(*camera), *address, std::move(log));
}

}  // namespace homeward::agent
