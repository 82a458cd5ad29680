// SPDX-License-Identifier: Apache-2.0
#include "agent/link/reconnecting_socket.hpp"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>
#include <utility>

#include "agent/link/socket_connection.hpp"

namespace homeward::agent {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kFirstPause(200);
constexpr std::chrono::milliseconds kLongestPause(2000);
constexpr const char* kEnded = "ended";

/// How long to wait between one connection and the next.
class Pauses {
 public:
  /// After a connection that, or the try to make it, lasted so long.
  std::chrono::milliseconds after(const ConnectionEnd& end, Clock::duration lasted, const SocketOptions& options) {
    const bool settled = options.settled_after ? lasted > *options.settled_after : end.heard && !end.given_up;
    pause_ = settled || pause_ == pause_.zero() ? kFirstPause : std::min(2 * pause_, kLongestPause);
    return pause_;
  }

 private:
  std::chrono::milliseconds pause_{0};  // the last one; 0: none yet
};

}  // namespace

struct ReconnectingSocket::Impl final : ConnectionOwner {
  Impl(SocketOptions socket_options, Events socket_events)
      : options(std::move(socket_options)), events(std::move(socket_events)) {}

  const SocketOptions options;
  const Events events;

  std::atomic<bool> is_up{false};
  std::atomic<std::int64_t> answered_ms{0};  // when the newest ping that came back was sent
  std::mutex mutex;                          // of all that follows
  SocketConnection* connection = nullptr;    // the present one, made or about to be
  bool open = false;                         // messages may wait: the greeting is before them
  std::deque<Message> waiting;
  std::optional<Message> newest;
  Clock::time_point newest_good_until;
  bool finishing = false;
  bool finished = false;  // everything that waited while finishing is sent, or never will be
  bool given_up = false;  // the present connection
  std::condition_variable_any pause;
  std::condition_variable_any flushed;
  bool heard = false;  // a message on the present connection; of the socket's thread alone
  std::jthread thread;

  void run(const std::stop_token& stop) {
    Pauses pauses;
    while (!stop.stop_requested()) {
      const auto begun = Clock::now();
      const ConnectionEnd end = connect_once(stop);
      if (stop.stop_requested()) return;
      {
        const std::lock_guard lock(mutex);
        if (finishing) return;
      }
      events.ended(end);
      const auto next_pause = pauses.after(end, Clock::now() - begun, options);
      std::unique_lock lock(mutex);
      if (pause.wait_for(lock, stop, next_pause, [this] { return finishing; })) return;
    }
  }

  ConnectionEnd connect_once(const std::stop_token& stop) {
    ConnectionEnd end;
    std::unique_ptr<SocketConnection> made;
    heard = false;
    try {
      made = make_connection(options, *this);
      {
        const std::lock_guard lock(mutex);
        connection = made.get();
        given_up = false;
      }
      // Whoever stops after this cuts the connection.
      end.why = stop.stop_requested() ? "ended" : made->run();
    } catch (const std::exception& broken) {
      end.why = broken.what();
    }
    if (made) end.stage = made->stage();
    end.heard = heard;
    down();
    {
      const std::lock_guard lock(mutex);
      end.given_up = given_up;
      connection = nullptr;
      open = false;
      waiting.clear();
      newest.reset();
      finished = finishing;
    }
    flushed.notify_all();
    return end;
  }

  void opened() override {
    std::vector<Message> messages = events.greeting();
    {
      const std::lock_guard lock(mutex);
      for (Message& message : messages) waiting.push_back(std::move(message));
      open = true;
    }
    answered_ms = steady_now_ms();
    is_up = true;
  }

  std::optional<Message> next_message() override {
    const std::lock_guard lock(mutex);
    std::optional<Message> message;
    if (newest && Clock::now() > newest_good_until) newest.reset();
    if (!waiting.empty()) {
      message = std::move(waiting.front());
      waiting.pop_front();
    } else {
      message = std::exchange(newest, std::nullopt);
    }
    return message;
  }

  bool closing() override {
    const std::lock_guard lock(mutex);
    return finishing && waiting.empty();
  }

  Status arrived(std::span<const std::uint8_t> message) override {
    heard = true;
    return events.arrived(message);
  }

  void answered(std::int64_t sent_ms) override { answered_ms = std::max(answered_ms.load(), sent_ms); }

  void down() override { is_up = false; }

  /// Whether a message may be put with those that wait. The mutex is held.
  [[nodiscard]] bool takes_messages() const { return is_up && open && !finishing; }
};

ReconnectingSocket::ReconnectingSocket(SocketOptions options, Events events)
    : impl_(std::make_unique<Impl>(std::move(options), std::move(events))) {
  impl_->thread = std::jthread([impl = impl_.get()](const std::stop_token& stop) { impl->run(stop); });
}

ReconnectingSocket::~ReconnectingSocket() {
  impl_->thread.request_stop();
  {
    const std::lock_guard lock(impl_->mutex);
    if (impl_->connection != nullptr) impl_->connection->cut(kEnded);
  }
  impl_->thread.join();
}

bool ReconnectingSocket::up() const { return impl_->is_up; }

std::chrono::milliseconds ReconnectingSocket::lag() const {
  if (!impl_->is_up || !impl_->options.ping_period) return std::chrono::hours(1);
  return std::chrono::milliseconds(steady_now_ms() - impl_->answered_ms);
}

void ReconnectingSocket::send(Message message) {
  const std::lock_guard lock(impl_->mutex);
  if (!impl_->takes_messages()) return;
  impl_->waiting.push_back(std::move(message));
  if (impl_->waiting.size() > impl_->options.max_waiting) impl_->connection->cut(kEnded);
  impl_->connection->wake();
}

void ReconnectingSocket::send_newest(Message message, std::chrono::steady_clock::time_point good_until) {
  const std::lock_guard lock(impl_->mutex);
  if (!impl_->takes_messages()) return;
  impl_->newest = std::move(message);
  impl_->newest_good_until = good_until;
  impl_->connection->wake();
}

void ReconnectingSocket::restart(const std::string& why) {
  const std::lock_guard lock(impl_->mutex);
  if (!impl_->takes_messages()) return;
  impl_->given_up = true;
  impl_->is_up = false;
  impl_->connection->cut(why);
}

void ReconnectingSocket::finish(std::vector<Message> messages, std::chrono::milliseconds limit) {
  std::unique_lock lock(impl_->mutex);
  impl_->newest.reset();
  impl_->finishing = true;
  impl_->pause.notify_all();
  if (!impl_->is_up || !impl_->open) {
    if (impl_->connection != nullptr) impl_->connection->cut(kEnded);
    return;
  }
  for (Message& message : messages) impl_->waiting.push_back(std::move(message));
  impl_->connection->wake();
  impl_->flushed.wait_for(lock, limit, [this] { return impl_->finished; });
}

}  // namespace homeward::agent
