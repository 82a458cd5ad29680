// SPDX-License-Identifier: Apache-2.0
#include "robots.hpp"

#include <cmath>
#include <stdexcept>

#include "generated_map.hpp"
#include "support/room_picture.hpp"
#include "web_socket.hpp"
#include "wire/link_messages.hpp"

namespace homeward::bench {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kFrameEvery{200};
constexpr unsigned kPictures = 10;  // of a room, which differ by noise
constexpr std::chrono::seconds kFirstBeliefWithin{60};

std::string text_of(const wire::AgentMessage& message) {
  const auto bytes = wire::encode(message);
  return {bytes.begin(), bytes.end()};
}

std::vector<std::vector<std::uint8_t>> pictures_of(unsigned room) {
  std::vector<std::vector<std::uint8_t>> pictures;
  for (unsigned i = 0; i < kPictures; ++i) {
    const std::string jpeg = testing::room_picture(room, 1000 * room + i + 1);
    pictures.emplace_back(jpeg.begin(), jpeg.end());
  }
  return pictures;
}

std::int64_t wall_us() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::microseconds>(now).count();
}

/// A robot's link: says hello, then sends a frame every kFrameEvery and how it is, and hears whatever comes.
void drive_link(const std::stop_token& told, std::uint16_t port, const Robot& robot, unsigned room, FrameLog& log) {
  const auto pictures = pictures_of(room);
  WebSocket link;
  wire::Hello hello;
  hello.agent = "homeward-agent/bench";
  hello.robot_name = "chair";
  hello.session = "bench";
  hello.camera = testing::small_panorama_camera();
  if (!link.open(port, "/api/v1/robots/" + robot.id + "/link", robot.token) || !link.send(text_of(hello))) {
    return log.broke("a robot could not connect");
  }
  std::int64_t seq = 0;
  // Robots do not send all at once.
  auto next = Clock::now() + kFrameEvery * room / Robots::kCount;
  while (!told.stop_requested()) {
    if (!link.hear_until(next, [](std::string_view) {})) break;
    next += kFrameEvery;
    wire::AgentStatus status;
    status.seq = ++seq;
    status.t_us = wall_us();
    const wire::Frame frame{seq, status.t_us, pictures[static_cast<std::size_t>(seq) % pictures.size()]};
    const std::string status_text = text_of(status);
    const std::string frame_text = text_of(frame);
    if (!link.send(status_text)) break;
    log.sent(robot.id, frame.t_us);
    if (!link.send(frame_text)) break;
  }
  if (!told.stop_requested()) log.broke("the link of robot " + robot.id + " ended");
}

void hear_events(const std::stop_token& told, std::uint16_t port, const std::string& token, FrameLog& log) {
  WebSocket events;
  if (!events.open(port, "/api/v1/events", token)) return log.broke("the event socket was refused");
  while (!told.stop_requested()) {
    const bool goes_on = events.hear_until(Clock::now() + milliseconds(100), [&](std::string_view message) {
      const auto event = nlohmann::json::parse(message);
      if (event.at("type") != "robot" || event.at("robot").at("belief").is_null()) return;
      const nlohmann::json& belief = event.at("robot").at("belief");
      log.believed(event.at("robot").at("id"), belief.at("t_us"), belief.at("lost"));
    });
    if (!goes_on) return log.broke("the event socket ended");
  }
}

}  // namespace

void FrameLog::sent(const std::string& robot, std::int64_t t_us) {
  const std::scoped_lock lock(mutex_);
  frames_[robot][t_us] = {Clock::now(), counting_};
}

void FrameLog::believed(const std::string& robot, std::int64_t t_us, bool lost) {
  const auto now = Clock::now();
  const std::scoped_lock lock(mutex_);
  const auto found = frames_[robot].find(t_us);
  // The same belief comes again with whatever else changes of the robot.
  if (found == frames_[robot].end() || found->second.belief_ms >= 0.0) return;
  found->second.belief_ms = std::chrono::duration<double, std::milli>(now - found->second.sent_at).count();
  found->second.lost = lost;
  ++beliefs_[robot];
}

void FrameLog::broke(const std::string& what) {
  const std::scoped_lock lock(mutex_);
  broken_.push_back(what);
}

std::size_t FrameLog::robots_believed() const {
  const std::scoped_lock lock(mutex_);
  return beliefs_.size();
}

void FrameLog::begin() {
  const std::scoped_lock lock(mutex_);
  frames_.clear();
  counting_ = true;
}

void FrameLog::end() {
  const std::scoped_lock lock(mutex_);
  counting_ = false;
}

nlohmann::json FrameLog::figures() const {
  const std::scoped_lock lock(mutex_);
  std::int64_t sent = 0;
  std::int64_t lost = 0;
  std::vector<double> times_ms;
  for (const auto& [robot, frames] : frames_) {
    for (const auto& [t_us, frame] : frames) {
      if (!frame.counts) continue;
      ++sent;
      if (frame.belief_ms < 0.0) continue;
      times_ms.push_back(frame.belief_ms);
      if (frame.lost) ++lost;
    }
  }
  const double share = sent == 0 ? 0.0 : static_cast<double>(times_ms.size()) / static_cast<double>(sent);
  nlohmann::json figures = {{"sent", sent}, {"share_followed", std::round(share * 1000.0) / 1000.0}, {"lost", lost}};
  figures["belief"] = summary(std::move(times_ms));
  if (!broken_.empty()) figures["broken"] = broken_;
  return figures;
}

Robots::Robots(ServerProcess& server, const std::string& map) : port_(server.port()) {
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    robots_[i] = server.add_robot("chair " + std::to_string(i + 1), map);
  }
  threads_.emplace_back(
      [this, token = server.token("viewer")](const std::stop_token& told) { hear_events(told, port_, token, log); });
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    threads_.emplace_back([this, i](const std::stop_token& told) {
      drive_link(told, port_, robots_[i], static_cast<unsigned>(i) + 1, log);
    });
  }
  const auto end = Clock::now() + kFirstBeliefWithin;
  while (log.robots_believed() < robots_.size()) {
    if (Clock::now() > end) throw std::runtime_error("The robots have no beliefs: " + log.figures().dump());
    std::this_thread::sleep_for(milliseconds(20));
  }
}

Robots::~Robots() {
  for (std::jthread& thread : threads_) thread.request_stop();
}

}  // namespace homeward::bench
