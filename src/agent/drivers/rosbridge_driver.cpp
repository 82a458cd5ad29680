// SPDX-License-Identifier: Apache-2.0
#include "agent/drivers/rosbridge_driver.hpp"

#include <atomic>
#include <bit>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <thread>

#include "agent/drivers/command_echo.hpp"
#include "agent/drivers/range_ring.hpp"
#include "agent/drivers/ros_messages.hpp"
#include "agent/drivers/ros_requests.hpp"
#include "agent/drivers/rosbridge_config.hpp"
#include "agent/drivers/rosbridge_feeds.hpp"
#include "agent/link/json_socket.hpp"
#include "files/read_file.hpp"
#include "imageio/decode.hpp"

namespace homeward::agent {
namespace {

using Clock = std::chrono::steady_clock;
constexpr const char* kIfUnheard =
    "it may want to be authenticated to (its parameter 'authenticate'), which this program cannot do";

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

/// Whether the first, second, fourth, eighth ... of something that may come again and again.
bool worth_a_line(int count) { return std::has_single_bit(static_cast<unsigned>(count)); }

class RosbridgeDriver final : public driving::Driver {
 public:
  RosbridgeDriver(wire::RosbridgeFile robot, camera::CameraConfig camera, const WebSocketAddress& address,
                  std::function<void(const std::string&)> log)
      : robot_(std::move(robot)),
        camera_(std::move(camera)),
        body_(body_of(robot_.body)),
        log_(std::move(log)),
        feeds_(robot_, config_),
        echo_(config_.unheard_commands) {
    const RangeRing ring(robot_.ranges);
    body_.vague_ranges = !ring.empty();
    if (const int uncovered_deg = ring.uncovered_deg(); !robot_.scan && uncovered_deg > 0) {
      log_("the ring of range sensors covers nothing in " + std::to_string(uncovered_deg) +
           " of the 360 degrees around the robot: whoever steps in there is not seen");
    }
    JsonSocket::Events events;
    events.greeting = [this] { return greeting(); };
    events.arrived = [this](std::string_view text, std::chrono::milliseconds lag) { arrived(text, lag); };
    events.lost = [this] { lost(); };
    events.log = log_;
    events.if_unheard = kIfUnheard;
    socket_ = std::make_unique<JsonSocket>(address, kMaxRosMessageBytes, std::move(events));
    publisher_ = std::jthread([this](const std::stop_token& stop) { publish(stop); });
  }

  ~RosbridgeDriver() override {
    publisher_.request_stop();
    publisher_.join();
    if (socket_->up()) {
      // Apart from the farewell: a bridge drops what it has not taken up when the connection closes. In place of a
      // motion that may still wait, which would come after it.
      socket_->send_newest(ros_motion(robot_, {}), Clock::time_point::max());
      std::this_thread::sleep_for(std::chrono::milliseconds(config_.farewell_pause_ms));
    }
    socket_->finish(ros_farewell(robot_), std::chrono::milliseconds(config_.farewell_limit_ms));
    socket_.reset();
  }
  RosbridgeDriver(const RosbridgeDriver&) = delete;
  RosbridgeDriver& operator=(const RosbridgeDriver&) = delete;

  [[nodiscard]] const camera::CameraConfig& camera() const override { return camera_; }
  [[nodiscard]] driving::Body body() const override { return body_; }

  driving::Reading read() override {
    const bool live = socket_->up() && socket_->lag().count() <= config_.lag.most_ms;
    const std::lock_guard lock(mutex_);
    return feeds_.reading(live, interrupted_, now_ms());
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
      if (!changed_.wait(lock, stop, [this] { return feeds_.has_picture(); }))
        return std::optional<driving::TakenPicture>();
      const CamePicture sent = *feeds_.picture();
      driving::TakenPicture taken{sent.arrived_ms, {}, sent.odometry, {}};
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
    const driving::Milliseconds now = now_ms();
    feeds_.begin(now);
    echo_.begin();
    // A base that was left moving when the connection broke is told to stand before anything else.
    if (moved_) {
      texts.push_back(ros_motion(robot_, {}));
      zeros_until_ms_ = now + config_.zeros_after_motion_ms;
    }
    return texts;
  }

  void lost() {
    const std::lock_guard lock(mutex_);
    interrupted_ = true;
    withheld_until_ms_ = now_ms() + config_.withheld_ms;
    command_ = {};
    feeds_.lose();
  }

  void arrived(std::string_view text, std::chrono::milliseconds lag) {
    auto message = decode_ros_message(text, robot_);
    if (!message) return complain(message.error());
    if (const auto* status = std::get_if<RosStatus>(&*message)) return tell_status(*status);
    if (const auto* sweep = std::get_if<RosSweep>(&*message)) tell_of_blindness(*sweep);
    std::string passed_over;
    bool commands_back = false;
    {
      const std::lock_guard lock(mutex_);
      const driving::Milliseconds now = now_ms();
      feeds_.pinged(lag.count(), now);
      if (const auto* command = std::get_if<RosEcho>(&*message)) commands_back = echo_.heard(command->motion);
      passed_over = feeds_.take(std::move(*message), now);
      if (feeds_.has_picture()) changed_.notify_all();
    }
    if (commands_back) log_("commands come back on " + robot_.cmd_vel.topic);
    if (!passed_over.empty()) tell_of_passed_over(passed_over);
  }

  void tell_of_blindness(const RosSweep& sweep) {
    if (sweep.blind_beyond_m > config_.blind_beyond_m && !std::exchange(blindness_told_, true)) {
      log_("the scanner on " + robot_.scan->topic + " is blind to what is nearer than its range_min, up to " +
           std::to_string(std::lround(100.0 * sweep.blind_beyond_m)) +
           " cm beyond the body: whoever steps in there is not seen; add a scanner that sees them");
    }
    if (sees_nothing(sweep.scan)) {
      complain({ErrorCode::kEmptyInput, "The sweep saw nothing at all.", robot_.scan->topic});
    }
  }

  void tell_of_passed_over(const std::string& why) {
    const int count = ++passed_over_;
    if (!worth_a_line(count)) return;
    log_(std::to_string(count) + (count == 1 ? " message" : " messages") + " passed over; the last: " + why);
  }

  void tell_status(const RosStatus& status) {
    if (status.level != "error" && status.level != "warning") return;
    if (worth_a_line(++statuses_)) log_("the rosbridge says: " + shown(status.text));
  }

  /// Tells of the first, second, fourth, eighth ... message that is of no use.
  void complain(const Error& error) {
    const int count = ++useless_;
    if (!worth_a_line(count)) return;
    log_(std::to_string(count) + (count == 1 ? " message" : " messages") +
         " of no use; the last: " + shown(error.message) + " (" + shown(error.where) + ")");
  }

  void publish(const std::stop_token& stop) {
    const std::chrono::milliseconds period(config_.publish_period_ms);
    auto next = Clock::now();
    while (!stop.stop_requested()) {
      next = std::max(next + period, Clock::now());
      std::optional<driving::Motion> motion;
      Clock::time_point good_until;
      {
        std::unique_lock lock(mutex_);
        changed_.wait_until(lock, stop, next, [this] { return at_once_; });
        at_once_ = false;
        const driving::Milliseconds now = now_ms();
        if (now - commanded_ms_ > config_.command_life_ms) command_ = {};
        if (!stands(command_)) {
          moved_ = true;
          zeros_until_ms_ = now + config_.zeros_after_motion_ms;
        }
        // Silent while it stands, so that others may drive the base by hand.
        if (now < zeros_until_ms_) motion = command_;
        // Standing is right however late it is said.
        const std::chrono::milliseconds life(config_.command_life_ms);
        good_until = stands(command_) ? Clock::time_point::max() : Clock::now() + life;
      }
      if (motion) socket_->send_newest(ros_motion(robot_, *motion), good_until);
      if (socket_->up()) watch_connection(motion);
    }
  }

  /// Looks whether the connection brings what is new, on all topics, and whether `sent` and what was sent before came
  /// back.
  void watch_connection(const std::optional<driving::Motion>& sent) {
    const std::chrono::milliseconds lag = socket_->lag();
    std::vector<RosbridgeFeeds::SilentTopic> silent;
    bool commands_missed = false;
    bool first_missed = false;
    {
      const std::lock_guard lock(mutex_);
      const driving::Milliseconds now = now_ms();
      feeds_.pinged(lag.count(), now);
      if (feeds_.lag().lost(now)) {
        return socket_->restart("it has lagged for more than " + std::to_string(config_.lag.lasts_ms) +
                                " ms, so that nothing that comes on it may move the robot");
      }
      silent = feeds_.silent_topics(now);
      const bool missed_before = echo_.missed();
      if (sent && !feeds_.lag().late(now)) commands_missed = echo_.sent(*sent);
      first_missed = commands_missed && !missed_before;
    }
    for (const auto& [subscription, first] : silent) {
      if (first) {
        log_("nothing comes on " + subscription.topic.topic + " (" + subscription.topic.type +
             "); it is asked for again every " + std::to_string(config_.topic_silence_ms / 1000) + " s");
      }
      for (const std::string& text : ros_asked_again(subscription)) socket_->send(text);
    }
    if (!commands_missed) return;
    if (first_missed) {
      log_("no command comes back on " + robot_.cmd_vel.topic + " (" + robot_.cmd_vel.type +
           "): the rosbridge refuses them, or the topic has another type; the rosbridge's own log says which");
    }
    for (const std::string& text : ros_advertised_again(robot_)) socket_->send(text);
  }

  wire::RosbridgeFile robot_;
  camera::CameraConfig camera_;
  driving::Body body_;
  std::function<void(const std::string&)> log_;
  const RosbridgeConfig config_;
  bool blindness_told_ = false;  // of the socket's thread alone
  std::atomic<int> useless_{0};
  std::atomic<int> passed_over_{0};
  std::atomic<int> statuses_{0};

  std::mutex mutex_;  // of all that follows
  std::condition_variable_any changed_;
  RosbridgeFeeds feeds_;
  CommandEcho echo_;
  driving::Motion command_;
  driving::Milliseconds commanded_ms_ = 0;
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
