// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

namespace homeward::bench {

/// A TCP socket to a port of this machine, closed when it goes. It costs next to nothing beside the server that shares
/// the processors with it. No call throws.
class PlainSocket {
 public:
  PlainSocket() = default;
  PlainSocket(PlainSocket&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  PlainSocket& operator=(PlainSocket&& other) noexcept;
  ~PlainSocket() { close(); }

  /// Waits until it is connected. No call waits longer than `patience` afterwards. Not open when it failed.
  static PlainSocket connected(std::uint16_t port, std::chrono::milliseconds patience);
  /// Never waits, now or later.
  static PlainSocket connecting(std::uint16_t port);

  [[nodiscard]] bool open() const { return descriptor_ >= 0; }
  [[nodiscard]] int descriptor() const { return descriptor_; }
  void close();
  /// Whether all of it was taken.
  [[nodiscard]] bool send(std::string_view bytes) const;
  /// As many bytes as are taken at once, at least none; -1 when the connection has ended.
  [[nodiscard]] long send_some(std::string_view bytes) const;
  /// The number of bytes read; 0 when the other end has closed, -1 when nothing came in time or the connection failed.
  [[nodiscard]] long receive(char* to, std::size_t room) const;
  /// Whether something, the end too, comes within that time.
  [[nodiscard]] bool comes_within(std::chrono::milliseconds time) const;
  /// Throws away what has come, without waiting. False when the other end has closed or the connection has failed.
  [[nodiscard]] bool discard_what_came() const;

 private:
  explicit PlainSocket(int descriptor) : descriptor_(descriptor) {}
  int descriptor_ = -1;
};

/// A head with Host, the bearer token where there is one, `fields` (whole lines) and the length of the body.
std::string head_of(const std::string& method, const std::string& path, const std::string& token,
                    std::uint64_t body_bytes, const std::string& fields = "");

/// One answer: its status, 0 where none came; and the bytes of its body, which was thrown away.
struct Answered {
  int status = 0;
  std::uint64_t body_bytes = 0;
  bool stays = false;  // the connection
};
Answered read_answer(const PlainSocket& socket);

/// Asks on one connection, which is opened anew when the other end has closed it.
class Caller {
 public:
  explicit Caller(std::uint16_t port) : port_(port) {}
  /// `request`: head and body.
  Answered ask(std::string_view request);

 private:
  std::uint16_t port_;
  PlainSocket socket_;
};

/// No call of a blocking socket waits longer.
inline constexpr std::chrono::seconds kPatience{30};

/// As many descriptors as this system lets a process open. To be called after the server was started, whose limit is to
/// stay what it is.
void allow_many_sockets();

}  // namespace homeward::bench
