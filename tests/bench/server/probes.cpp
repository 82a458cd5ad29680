// SPDX-License-Identifier: Apache-2.0
#include "probes.hpp"

#include <mutex>
#include <thread>

#include "plain_socket.hpp"

namespace homeward::bench {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kStopEvery{100};
constexpr milliseconds kReadEvery{20};

/// What was answered, and how long each answer with the wanted status took.
class Tally {
 public:
  explicit Tally(int wanted) : wanted_(wanted) {}
  void add(int status, double time_ms) {
    const std::scoped_lock lock(mutex_);
    ++statuses_[status];
    if (status == wanted_) times_ms_.push_back(time_ms);
  }
  [[nodiscard]] nlohmann::json figures() const {
    const std::scoped_lock lock(mutex_);
    std::int64_t all = 0;
    for (const auto& [status, count] : statuses_) all += count;
    nlohmann::json figures = summary(times_ms_);
    figures["refused"] = all - static_cast<std::int64_t>(times_ms_.size());
    figures["answers"] = to_json(statuses_);
    return figures;
  }

 private:
  int wanted_;
  mutable std::mutex mutex_;
  Statuses statuses_;
  std::vector<double> times_ms_;
};

}  // namespace

int stops_in(int seconds) { return static_cast<int>(std::chrono::seconds(seconds) / kStopEvery); }

nlohmann::json stop_again_and_again(std::uint16_t port, const std::vector<std::string>& robots,
                                    const std::vector<std::string>& tokens) {
  Tally tally(202);
  std::vector<std::jthread> stops;
  auto next = Clock::now();
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    std::this_thread::sleep_until(next);
    next += kStopEvery;
    const std::string path = "/api/v1/robots/" + robots[i % robots.size()] + "/stop";
    stops.emplace_back([&tally, port, request = head_of("POST", path, tokens[i], 0)] {
      const auto began = Clock::now();
      const PlainSocket socket = PlainSocket::connected(port, kPatience);
      const int status = socket.open() && socket.send(request) ? read_answer(socket).status : 0;
      tally.add(status, milliseconds_since(began));
    });
  }
  stops.clear();  // once all are answered
  return tally.figures();
}

nlohmann::json ask_again_and_again(std::uint16_t port, const std::string& request, int seconds) {
  Tally tally(200);
  Caller caller(port);
  const auto end = Clock::now() + std::chrono::seconds(seconds);
  std::int64_t not_asked = 0;
  for (auto due = Clock::now(); due < end; due += kReadEvery) {
    if (Clock::now() > end + kPatience) {
      ++not_asked;
      continue;
    }
    std::this_thread::sleep_until(due);
    const int status = caller.ask(request).status;
    tally.add(status, milliseconds_since(due));
  }
  nlohmann::json figures = tally.figures();
  if (not_asked > 0) figures["not_asked"] = not_asked;
  return figures;
}

}  // namespace homeward::bench
