// SPDX-License-Identifier: Apache-2.0
#include "floods.hpp"

#include <poll.h>

#include <algorithm>
#include <array>
#include <cstdlib>

namespace homeward::bench {
namespace {

using std::chrono::milliseconds;

constexpr std::size_t kBlock_bytes = 256UL * 1024;

void wait(const std::stop_token& told, milliseconds time) {
  const auto end = Clock::now() + time;
  while (!told.stop_requested() && Clock::now() < end) std::this_thread::sleep_for(std::min(time, milliseconds(20)));
}

/// All at once, so that none goes on while another is waited for.
void stop_all(std::vector<std::jthread>& threads) {
  for (std::jthread& thread : threads) thread.request_stop();
}

double megabytes(std::uint64_t bytes) { return static_cast<double>(bytes / 100'000) / 10.0; }

/// A part of a large body; its beginning is that of a database, which is what a map is.
const std::string& block() {
  static const std::string zeros = [] {
    std::string text(kBlock_bytes, '\0');
    const std::string_view magic("SQLite format 3\0", 16);
    std::ranges::copy(magic, text.begin());
    return text;
  }();
  return zeros;
}

/// One of LargeBodies.
struct Sender {
  PlainSocket socket;
  std::size_t head_sent = 0;
  bool answered = false;
  Clock::time_point opens_at;  // where it is not open
};

}  // namespace

SlowConnections::SlowConnections(std::uint16_t port, int count)
    : port_(port), count_(count), thread_([this](const std::stop_token& told) { flood(told); }) {}

void SlowConnections::flood(const std::stop_token& told) {
  constexpr std::string_view kHalfHead = "GET /api/v1/robots HTTP/1.1\r\nHost: 127.0.0.1\r\nX-Slow: ";
  constexpr std::size_t kRounds = 100;  // a second
  constexpr milliseconds kRound(1000 / kRounds);
  std::vector<PlainSocket> connections(static_cast<std::size_t>(count_));
  auto next = Clock::now();
  for (std::size_t round = 0; !told.stop_requested(); round = (round + 1) % kRounds) {
    for (std::size_t i = round; i < connections.size(); i += kRounds) {
      const bool stays = connections[i].open() && connections[i].discard_what_came();
      if (!stays) {
        connections[i] = PlainSocket::connecting(port_);
        ++opened_;
      }
      bytes_ += std::max(0L, connections[i].send_some(stays ? "a" : kHalfHead));
    }
    next += kRound;
    std::this_thread::sleep_until(next);
  }
}

nlohmann::json SlowConnections::figures() const {
  return {{"connections", count_}, {"opened", opened_.load()}, {"bytes", bytes_.load()}};
}

Readers::Readers(std::uint16_t port, const std::string& path, const std::string& token, int count) {
  const std::string request = head_of("GET", path, token, 0);
  for (int i = 0; i < count; ++i) {
    threads_.emplace_back([this, port, request](const std::stop_token& told) {
      Caller caller(port);
      while (!told.stop_requested()) {
        const Answered answer = caller.ask(request);
        answers_.add(answer.status);
        bytes_ += answer.body_bytes;
        if (answer.status != 200) wait(told, milliseconds(100));
      }
    });
  }
}

Readers::~Readers() { stop_all(threads_); }

nlohmann::json Readers::figures() const {
  return {{"connections", threads_.size()}, {"answers", to_json(answers_.statuses())}, {"read_mb", megabytes(bytes_)}};
}

WrongLogins::WrongLogins(std::uint16_t port, int connections) {
  for (int i = 0; i < connections; ++i) {
    threads_.emplace_back([this, port](const std::stop_token& told) { flood(told, port); });
  }
}

WrongLogins::~WrongLogins() { stop_all(threads_); }

void WrongLogins::flood(const std::stop_token& told, std::uint16_t port) {
  Caller caller(port);
  const std::string body = R"({"name": "anna", "password": "not the right one"})";
  while (!told.stop_requested()) {
    const std::uint32_t number = ++address_;
    const std::string address = "10." + std::to_string(number >> 16 & 0xFF) + "." + std::to_string(number >> 8 & 0xFF) +
                                "." + std::to_string(number & 0xFF);
    const std::string fields = "Content-Type: application/json\r\nX-Forwarded-For: " + address + "\r\n";
    const int status = caller.ask(head_of("POST", "/api/v1/login", "", body.size(), fields) + body).status;
    answers_.add(status);
    if (status != 401) wait(told, milliseconds(50));
  }
}

nlohmann::json WrongLogins::figures() const {
  return {{"connections", threads_.size()}, {"answers", to_json(answers_.statuses())}};
}

Upload::Upload(std::uint16_t port, const std::string& token, std::uint64_t bytes)
    : port_(port),
      size_bytes_(bytes),
      head_(head_of("POST", "/api/v1/maps/import", token, bytes, "Content-Type: application/vnd.sqlite3\r\n")),
      thread_([this](const std::stop_token& told) { flood(told); }) {}

int Upload::upload(const std::stop_token& told) {
  const PlainSocket socket = PlainSocket::connected(port_, kPatience);
  if (!socket.open() || !socket.send(head_)) return 0;
  for (std::uint64_t left = size_bytes_; left > 0;) {
    // An answer before the end is a refusal.
    if (socket.comes_within(milliseconds(0))) break;
    if (told.stop_requested()) return -1;
    const std::size_t count = std::min<std::uint64_t>(left, kBlock_bytes);
    if (!socket.send(std::string_view(block()).substr(0, count))) break;
    left -= count;
    bytes_ += count;
  }
  while (!socket.comes_within(milliseconds(100))) {
    if (told.stop_requested()) return -1;
  }
  return read_answer(socket).status;
}

void Upload::flood(const std::stop_token& told) {
  while (!told.stop_requested()) {
    const int status = upload(told);
    if (status >= 0) answers_.add(status);
    const bool taken_whole = status == 201 || status == 422;  // it is no map, but it was looked at
    if (!taken_whole) wait(told, milliseconds(100));
  }
}

nlohmann::json Upload::figures() const {
  return {
      {"each_mb", megabytes(size_bytes_)}, {"answers", to_json(answers_.statuses())}, {"sent_mb", megabytes(bytes_)}};
}

LargeBodies::LargeBodies(std::uint16_t port, int count, std::uint64_t bytes)
    : port_(port),
      count_(count),
      head_(head_of("POST", "/api/v1/maps/import", "wrong", bytes, "Content-Type: application/vnd.sqlite3\r\n")),
      thread_([this](const std::stop_token& told) { flood(told); }) {}

void LargeBodies::flood(const std::stop_token& told) {
  std::vector<Sender> senders(static_cast<std::size_t>(count_));
  std::vector<pollfd> waited(senders.size());
  std::array<char, 4096> piece{};
  const auto serve = [&](Sender& sender, short come) {
    if ((come & (POLLIN | POLLERR | POLLHUP)) != 0) {
      const long count = sender.socket.receive(piece.data(), piece.size());
      const bool status_came = count >= 12 && !sender.answered;
      if (status_came) answers_.add(std::atoi(piece.data() + 9));
      sender.answered = sender.answered || status_came;
      if (count <= 0) return false;
    }
    if ((come & POLLOUT) == 0) return true;
    const std::string_view rest = std::string_view(head_).substr(sender.head_sent);
    const long count = sender.socket.send_some(rest.empty() ? std::string_view(block()) : rest);
    if (count < 0) return false;
    if (rest.empty()) bytes_ += static_cast<std::uint64_t>(count);
    if (!rest.empty()) sender.head_sent += static_cast<std::size_t>(count);
    return true;
  };
  while (!told.stop_requested()) {
    for (std::size_t i = 0; i < senders.size(); ++i) {
      if (!senders[i].socket.open() && Clock::now() >= senders[i].opens_at) {
        senders[i] = {PlainSocket::connecting(port_), 0, false, {}};
        ++opened_;
      }
      waited[i] = {senders[i].socket.descriptor(), POLLIN | POLLOUT, 0};
    }
    if (::poll(waited.data(), waited.size(), 50) <= 0) continue;
    for (std::size_t i = 0; i < senders.size(); ++i) {
      if (waited[i].revents == 0 || serve(senders[i], waited[i].revents)) continue;
      if (!senders[i].answered) answers_.add(0);
      senders[i].socket.close();
      senders[i].opens_at = Clock::now() + milliseconds(100);
    }
  }
}

nlohmann::json LargeBodies::figures() const {
  return {{"connections", count_},
          {"opened", opened_.load()},
          {"answers", to_json(answers_.statuses())},
          {"sent_mb", megabytes(bytes_)}};
}

}  // namespace homeward::bench
