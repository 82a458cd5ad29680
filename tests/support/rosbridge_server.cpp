// SPDX-License-Identifier: Apache-2.0
#include "support/rosbridge_server.hpp"

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <deque>
#include <future>
#include <map>
#include <mutex>
#include <set>
#include <thread>

#include "support/ros_twists.hpp"

namespace homeward::testing {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using Tcp = asio::ip::tcp;
using Clock = std::chrono::steady_clock;
using nlohmann::json;

struct Subscription {
  std::chrono::milliseconds throttle{0};
  std::size_t queue_length = 0;
  Clock::time_point sent;
  std::deque<std::string> held;  // back because of the throttle, at most queue_length
};

struct Waiting {
  std::string topic;  // empty: any text
  std::string text;
};

/// What waits for its time.
struct Due {
  Clock::time_point at;
  std::string text;
};
struct DueMessage {
  Clock::time_point at;
  std::string topic;
  json msg;
};

}  // namespace

struct RosbridgeServer::Impl {
  struct Session : std::enable_shared_from_this<Session> {
    Session(Impl& server, Tcp::socket socket) : impl(server), stream(std::move(socket)) {}

    void start() {
      stream.text(true);
      http::async_read(stream.next_layer(), buffer, request,
                       [self = shared_from_this()](beast::error_code error, std::size_t) {
                         if (error) return self->end();
                         self->impl.paths.emplace_back(self->request.target());
                         self->accept();
                       });
    }

    void accept() {
      stream.async_accept(request, [self = shared_from_this()](beast::error_code error) {
        if (error) return self->end();
        ++self->impl.connections;
        self->open = true;
        self->read();
        self->write();
      });
    }

    void read() {
      stream.async_read(buffer, [self = shared_from_this()](beast::error_code error, std::size_t) {
        if (error) return self->end();
        const std::string text = beast::buffers_to_string(self->buffer.data());
        self->buffer.consume(self->buffer.size());
        self->in.push_back({Clock::now() + self->impl.taken_up_after, text});
        self->take_up();
        self->read();
      });
    }

    void send(const std::string& topic, std::string text, std::size_t queue_length) {
      if (queue_length > 0) {
        std::size_t waits = 0;
        for (const Waiting& other : out) waits += other.topic == topic ? 1 : 0;
        for (auto other = out.begin(); waits >= queue_length && other != out.end();) {
          if (other->topic != topic) {
            ++other;
            continue;
          }
          other = out.erase(other);
          --waits;
        }
      }
      out.push_back({topic, std::move(text)});
      write();
    }

    /// What has come and whose time it is.
    void take_up() {
      while (!in.empty() && Clock::now() >= in.front().at) {
        const std::string text = std::move(in.front().text);
        in.pop_front();
        impl.take(*this, text);
      }
    }

    /// As the client is told of a message: whole, or in fragments.
    void tell(const std::string& topic, const std::string& text, std::size_t queue_length) {
      if (fragment_bytes == 0 || text.size() <= fragment_bytes) return send(topic, text, queue_length);
      const std::size_t total = (text.size() + fragment_bytes - 1) / fragment_bytes;
      for (std::size_t i = 0; i < total; ++i) {
        const json part = {{"op", "fragment"},
                           {"id", "0"},
                           {"data", text.substr(i * fragment_bytes, fragment_bytes)},
                           {"num", i},
                           {"total", total}};
        send("", part.dump(), 0);
      }
    }

    void close() {
      if (!open || std::exchange(closing, true)) return;
      stream.async_close(websocket::close_code::normal, [self = shared_from_this()](beast::error_code) {});
    }

    void write() {
      if (!open || writing || closing || out.empty()) return;
      writing = true;
      sending = std::move(out.front().text);
      out.pop_front();
      stream.async_write(asio::buffer(sending), [self = shared_from_this()](beast::error_code error, std::size_t) {
        self->writing = false;
        if (error) return self->end();
        self->write();
      });
    }

    void end() {
      beast::get_lowest_layer(stream).close();
      impl.sessions.erase(shared_from_this());
    }

    Impl& impl;
    websocket::stream<beast::tcp_stream> stream;
    beast::flat_buffer buffer;
    http::request<http::string_body> request;
    std::deque<Due> in;
    std::deque<Waiting> out;
    std::string sending;
    bool open = false;  // the answer to the handshake is out
    bool writing = false;
    bool closing = false;
    std::size_t fragment_bytes = 0;
    std::map<std::string, Subscription> subscriptions;
    std::set<std::string> advertised;
  };

  explicit Impl(Events e) : events(std::move(e)) {}

  Events events;
  asio::io_context context{1};
  Tcp::acceptor acceptor{context};
  asio::steady_timer ticker{context};
  unsigned short port = 0;
  bool refused = false;
  std::set<std::shared_ptr<Session>> sessions;
  std::map<std::string, std::string> types;
  std::deque<DueMessage> delayed;
  std::chrono::milliseconds delay{0};
  std::chrono::milliseconds taken_up_after{0};
  std::size_t fragment_bytes = 0;
  bool authenticates = false;
  std::vector<json> received;
  std::vector<std::string> paths;
  int connections = 0;
  std::thread thread;

  /// Runs on the server's thread and waits for it; from that thread itself, at once.
  template <class Work>
  auto on_thread(Work work) {
    if (std::this_thread::get_id() == thread.get_id()) return work();
    // Shared: the task is still at work for a moment after its result can be had.
    const auto task = std::make_shared<std::packaged_task<decltype(work())()>>(std::move(work));
    auto result = task->get_future();
    asio::post(context, [task] { (*task)(); });
    return result.get();
  }

  void listen(unsigned short wanted) {
    const Tcp::endpoint here(asio::ip::make_address_v4("127.0.0.1"), wanted);
    acceptor.open(here.protocol());
    acceptor.set_option(asio::socket_base::reuse_address(true));
    acceptor.bind(here);
    acceptor.listen();
    port = acceptor.local_endpoint().port();
  }

  void accept() {
    acceptor.async_accept([this](beast::error_code error, Tcp::socket socket) {
      if (error) return;
      if (!refused) {
        const auto session = std::make_shared<Session>(*this, std::move(socket));
        session->fragment_bytes = fragment_bytes;
        sessions.insert(session);
        session->start();
      }
      accept();
    });
  }

  void cut() {
    // Each end erases its session.
    const auto ending = sessions;
    for (const auto& session : ending) session->end();
  }

  void take(Session& session, const std::string& text) {
    const json message = json::parse(text, nullptr, false);
    if (!message.is_object() || !message.contains("op") || !message["op"].is_string()) return;
    received.push_back(message);
    const std::string op = message["op"];
    if (authenticates && op != "auth") return session.close();
    session.fragment_bytes = message.value("fragment_size", session.fragment_bytes);
    const std::string topic = message.value("topic", "");
    const std::string type = message.value("type", "");
    const auto known = types.find(topic);
    const bool fits = known == types.end() || type.empty() || names_type(type, known->second);
    if (op == "advertise" && fits && !type.empty()) {
      types.emplace(topic, type);
      session.advertised.insert(topic);
    } else if (op == "unadvertise") {
      session.advertised.erase(topic);
    } else if (op == "publish" && known != types.end()) {
      const auto msg = as_published(known->second, message.value("msg", json::object()));
      if (!msg) return;
      if (events.published) events.published(topic, *msg);
      send_out(topic, *msg);
    } else if (op == "subscribe" && fits) {
      Subscription subscription;
      subscription.throttle = std::chrono::milliseconds(message.value("throttle_rate", 0));
      subscription.queue_length = message.value<std::size_t>("queue_length", 0);
      session.subscriptions[topic] = std::move(subscription);
    } else if (op == "unsubscribe") {
      session.subscriptions.erase(topic);
    }
  }

  void publish(const std::string& topic, json msg) {
    if (delay.count() == 0 && delayed.empty()) return send_out(topic, msg);
    delayed.push_back({Clock::now() + delay, topic, std::move(msg)});
  }

  void send_out(const std::string& topic, const json& msg) {
    std::string text;
    for (const auto& session : sessions) {
      const auto found = session->subscriptions.find(topic);
      if (found == session->subscriptions.end()) continue;
      if (text.empty()) text = json{{"op", "publish"}, {"topic", topic}, {"msg", msg}}.dump();
      Subscription& subscription = found->second;
      subscription.held.push_back(text);
      while (subscription.held.size() > std::max<std::size_t>(1, subscription.queue_length)) {
        subscription.held.pop_front();
      }
      send_held(*session, topic, subscription);
      if (subscription.queue_length == 0) subscription.held.clear();
    }
  }

  static void send_held(Session& session, const std::string& topic, Subscription& subscription) {
    const auto now = Clock::now();
    if (subscription.held.empty() || now - subscription.sent < subscription.throttle) return;
    subscription.sent = now;
    session.tell(topic, subscription.held.front(), subscription.queue_length);
    subscription.held.pop_front();
  }

  /// What waits for its time, when that has come.
  void tick() {
    ticker.expires_after(std::chrono::milliseconds(10));
    ticker.async_wait([this](beast::error_code ended) {
      if (ended) return;
      while (!delayed.empty() && Clock::now() >= delayed.front().at) {
        const DueMessage due = std::move(delayed.front());
        delayed.pop_front();
        send_out(due.topic, due.msg);
      }
      for (const auto& session : std::set(sessions)) {
        session->take_up();
        for (auto& [topic, subscription] : session->subscriptions) send_held(*session, topic, subscription);
      }
      tick();
    });
  }
};

RosbridgeServer::RosbridgeServer(unsigned short port, Events events)
    : impl_(std::make_unique<Impl>(std::move(events))) {
  impl_->listen(port);
  impl_->accept();
  impl_->tick();
  impl_->thread = std::thread([this] { impl_->context.run(); });
}

RosbridgeServer::~RosbridgeServer() {
  impl_->on_thread([this] {
    impl_->refused = true;  // a connection may be on its way through the queue
    impl_->acceptor.close();
    impl_->cut();
    // A tick that is already due cannot be cancelled, and would set the next.
    impl_->context.stop();
  });
  impl_->thread.join();
}

unsigned short RosbridgeServer::port() const { return impl_->port; }

void RosbridgeServer::serve_topic(const std::string& topic, const std::string& type) {
  impl_->on_thread([&] { impl_->types[topic] = type; });
}

void RosbridgeServer::publish(const std::string& topic, json msg) {
  asio::post(impl_->context, [impl = impl_.get(), topic, msg = std::move(msg)] { impl->publish(topic, msg); });
}

void RosbridgeServer::send_raw(const std::string& text) {
  asio::post(impl_->context, [impl = impl_.get(), text] {
    for (const auto& session : std::set(impl->sessions)) session->send("", text, 0);
  });
}

void RosbridgeServer::delay(std::chrono::milliseconds time) {
  impl_->on_thread([this, time] { impl_->delay = time; });
}

void RosbridgeServer::take_up_after(std::chrono::milliseconds time) {
  impl_->on_thread([this, time] { impl_->taken_up_after = time; });
}

void RosbridgeServer::authenticate() {
  impl_->on_thread([this] { impl_->authenticates = true; });
}

void RosbridgeServer::fragment(std::size_t most_bytes) {
  impl_->on_thread([this, most_bytes] {
    impl_->fragment_bytes = most_bytes;
    for (const auto& session : impl_->sessions) session->fragment_bytes = most_bytes;
  });
}

void RosbridgeServer::cut() {
  impl_->on_thread([this] { impl_->cut(); });
}

void RosbridgeServer::freeze(std::chrono::milliseconds duration) {
  asio::post(impl_->context, [duration] { std::this_thread::sleep_for(duration); });
}

void RosbridgeServer::refuse(bool refused) {
  impl_->on_thread([this, refused] {
    impl_->refused = refused;
    if (refused) impl_->cut();
  });
}

int RosbridgeServer::connections() const {
  return impl_->on_thread([this] { return impl_->connections; });
}

std::vector<std::string> RosbridgeServer::subscribed() const {
  return impl_->on_thread([this] {
    std::vector<std::string> topics;
    for (const auto& session : impl_->sessions) {
      for (const auto& [topic, ignored] : session->subscriptions) topics.push_back(topic);
    }
    return topics;
  });
}

std::vector<json> RosbridgeServer::received() const {
  return impl_->on_thread([this] { return impl_->received; });
}

std::vector<std::string> RosbridgeServer::paths() const {
  return impl_->on_thread([this] { return impl_->paths; });
}

}  // namespace homeward::testing
