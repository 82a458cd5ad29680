// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "figures.hpp"
#include "plain_socket.hpp"

namespace homeward::bench {

/// How often each status was answered. Callable from any thread.
class StatusCounter {
 public:
  void add(int status) {
    const std::scoped_lock lock(mutex_);
    ++statuses_[status];
  }
  [[nodiscard]] Statuses statuses() const {
    const std::scoped_lock lock(mutex_);
    return statuses_;
  }

 private:
  mutable std::mutex mutex_;
  Statuses statuses_;
};

/// Everything of a kind that goes on until it goes. What it did, figures() says.
class Flood {
 public:
  virtual ~Flood() = default;
  [[nodiscard]] virtual nlohmann::json figures() const = 0;
};

/// Connections of strangers with half a head. Each has its turn once a second: it sends one more byte, or is opened
/// anew where the server has closed it.
class SlowConnections : public Flood {
 public:
  SlowConnections(std::uint16_t port, int count);
  [[nodiscard]] nlohmann::json figures() const override;

 private:
  void flood(const std::stop_token& told);
  std::uint16_t port_;
  int count_;
  std::atomic<std::int64_t> opened_ = 0;
  std::atomic<std::int64_t> bytes_ = 0;
  std::jthread thread_;
};

/// Connections that are kept and ask for the same again as soon as it was answered, each answer read to its end.
class Readers : public Flood {
 public:
  Readers(std::uint16_t port, const std::string& path, const std::string& token, int count);
  ~Readers() override;
  [[nodiscard]] nlohmann::json figures() const override;

 private:
  StatusCounter answers_;
  std::atomic<std::uint64_t> bytes_ = 0;
  std::vector<std::jthread> threads_;
};

/// Logins with wrong passwords, each from another address (of X-Forwarded-For), so that no counter of failures keeps
/// them from being checked. Where one is refused unchecked, its connection waits for 50 ms.
class WrongLogins : public Flood {
 public:
  WrongLogins(std::uint16_t port, int connections);
  ~WrongLogins() override;
  [[nodiscard]] nlohmann::json figures() const override;

 private:
  void flood(const std::stop_token& told, std::uint16_t port);
  StatusCounter answers_;
  std::atomic<std::uint32_t> address_ = 0;
  std::vector<std::jthread> threads_;
};

/// A map that is none is uploaded as fast as the server takes it, again and again. After a refusal it waits for 100 ms.
class Upload : public Flood {
 public:
  Upload(std::uint16_t port, const std::string& token, std::uint64_t bytes);
  [[nodiscard]] nlohmann::json figures() const override;

 private:
  void flood(const std::stop_token& told);
  /// The status of one upload; 0 when there was none.
  int upload(const std::stop_token& told);
  std::uint16_t port_;
  std::uint64_t size_bytes_;
  std::string head_;
  StatusCounter answers_;
  std::atomic<std::uint64_t> bytes_ = 0;
  std::jthread thread_;
};

/// Connections of strangers that send a head with a wrong token and a large body as fast as it is taken, whatever is
/// answered. One that the server has closed is opened anew after 100 ms.
class LargeBodies : public Flood {
 public:
  LargeBodies(std::uint16_t port, int count, std::uint64_t bytes);
  [[nodiscard]] nlohmann::json figures() const override;

 private:
  void flood(const std::stop_token& told);
  std::uint16_t port_;
  int count_;
  std::string head_;
  StatusCounter answers_;
  std::atomic<std::int64_t> opened_ = 0;
  std::atomic<std::uint64_t> bytes_ = 0;
  std::jthread thread_;
};

}  // namespace homeward::bench
