// SPDX-License-Identifier: Apache-2.0
#include "plain_socket.hpp"

#include <arpa/inet.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <strings.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>

namespace homeward::bench {
namespace {

sockaddr_in address_of(std::uint16_t port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return address;
}

int connect_to(int descriptor, std::uint16_t port) {
  const sockaddr_in address = address_of(port);
  sockaddr plain{};
  static_assert(sizeof plain == sizeof address);
  std::memcpy(&plain, &address, sizeof plain);
  return ::connect(descriptor, &plain, sizeof plain);
}

void set_timeouts(int descriptor, std::chrono::milliseconds patience) {
  timeval time{};
  time.tv_sec = patience.count() / 1000;
  time.tv_usec = patience.count() % 1000 * 1000;
  ::setsockopt(descriptor, SOL_SOCKET, SO_RCVTIMEO, &time, sizeof time);
  ::setsockopt(descriptor, SOL_SOCKET, SO_SNDTIMEO, &time, sizeof time);
  const int on = 1;
  ::setsockopt(descriptor, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
}

/// The value of a field in a head; empty where it is not there.
std::string_view field_of(std::string_view head, std::string_view name) {
  std::size_t at = head.find("\r\n");
  while (at != std::string_view::npos && at + 2 < head.size()) {
    const std::string_view line = head.substr(at + 2, head.find("\r\n", at + 2) - at - 2);
    if (line.size() > name.size() && line[name.size()] == ':' &&
        ::strncasecmp(line.data(), name.data(), name.size()) == 0) {
      const std::size_t value = line.find_first_not_of(' ', name.size() + 1);
      return value == std::string_view::npos ? std::string_view() : line.substr(value);
    }
    at = head.find("\r\n", at + 2);
  }
  return {};
}

}  // namespace

PlainSocket& PlainSocket::operator=(PlainSocket&& other) noexcept {
  if (this != &other) {
    close();
    descriptor_ = std::exchange(other.descriptor_, -1);
  }
  return *this;
}

PlainSocket PlainSocket::connected(std::uint16_t port, std::chrono::milliseconds patience) {
  PlainSocket socket(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
  if (!socket.open()) return socket;
  set_timeouts(socket.descriptor_, patience);
  if (connect_to(socket.descriptor_, port) != 0) socket.close();
  return socket;
}

PlainSocket PlainSocket::connecting(std::uint16_t port) {
  PlainSocket socket(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (socket.open() && connect_to(socket.descriptor_, port) != 0 && errno != EINPROGRESS) socket.close();
  return socket;
}

void PlainSocket::close() {
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = -1;
}

bool PlainSocket::send(std::string_view bytes) const {
  while (!bytes.empty()) {
    const long count = ::send(descriptor_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

long PlainSocket::send_some(std::string_view bytes) const {
  const long count = ::send(descriptor_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
  if (count >= 0) return count;
  return errno == EAGAIN || errno == EINTR ? 0 : -1;
}

long PlainSocket::receive(char* to, std::size_t room) const {
  long count = -1;
  do {
    count = ::recv(descriptor_, to, room, 0);
  } while (count < 0 && errno == EINTR);
  return count;
}

bool PlainSocket::comes_within(std::chrono::milliseconds time) const {
  pollfd waited{descriptor_, POLLIN, 0};
  return ::poll(&waited, 1, static_cast<int>(time.count())) > 0;
}

bool PlainSocket::discard_what_came() const {
  std::array<char, 4096> piece{};
  while (true) {
    const long count = ::recv(descriptor_, piece.data(), piece.size(), MSG_DONTWAIT);
    if (count > 0) continue;
    return count < 0 && (errno == EAGAIN || errno == EINTR);
  }
}

std::string head_of(const std::string& method, const std::string& path, const std::string& token,
                    std::uint64_t body_bytes, const std::string& fields) {
  std::string head = method + " " + path + " HTTP/1.1\r\nHost: 127.0.0.1\r\n";
  if (!token.empty()) head += "Authorization: Bearer " + token + "\r\n";
  if (method != "GET") head += "Content-Length: " + std::to_string(body_bytes) + "\r\n";
  return head + fields + "\r\n";
}

Answered read_answer(const PlainSocket& socket) {
  constexpr std::size_t kMostOfHead_bytes = 64UL * 1024;
  std::string come;
  std::size_t end = std::string::npos;
  std::array<char, 64UL * 1024> piece{};
  while ((end = come.find("\r\n\r\n")) == std::string::npos) {
    const long count = socket.receive(piece.data(), piece.size());
    if (count <= 0 || come.size() > kMostOfHead_bytes) return {};
    come.append(piece.data(), static_cast<std::size_t>(count));
  }
  const std::string_view head = std::string_view(come).substr(0, end + 2);
  Answered answer;
  if (head.size() > 12 && head.starts_with("HTTP/1.1 ")) answer.status = std::atoi(head.data() + 9);
  const std::string length(field_of(head, "Content-Length"));
  answer.stays = !field_of(head, "Connection").starts_with("close");
  const std::uint64_t wanted = std::strtoull(length.c_str(), nullptr, 10);
  answer.body_bytes = come.size() - end - 4;
  while (answer.body_bytes < wanted) {
    const long count = socket.receive(piece.data(), piece.size());
    if (count <= 0) return {};
    answer.body_bytes += static_cast<std::uint64_t>(count);
  }
  return answer;
}

Answered Caller::ask(std::string_view request) {
  // What was idle may have been closed meanwhile.
  if (!socket_.open() || !socket_.discard_what_came()) socket_ = PlainSocket::connected(port_, kPatience);
  Answered answer;
  if (socket_.open() && socket_.send(request)) answer = read_answer(socket_);
  if (!answer.stays) socket_.close();
  return answer;
}

void allow_many_sockets() {
  rlimit limit{};
  if (::getrlimit(RLIMIT_NOFILE, &limit) != 0) return;
  limit.rlim_cur = limit.rlim_max;
  ::setrlimit(RLIMIT_NOFILE, &limit);
}

}  // namespace homeward::bench
