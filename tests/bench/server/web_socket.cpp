// SPDX-License-Identifier: Apache-2.0
#include "web_socket.hpp"

#include <algorithm>
#include <array>

namespace homeward::bench {
namespace {

constexpr std::uint8_t kLast = 0x80;    // frame of a message
constexpr std::uint8_t kMasked = 0x80;  // as all frames of a client are
constexpr std::size_t kShort = 126;     // lengths from here on have two bytes of their own
constexpr std::size_t kLong = 127;      // and eight

struct FrameHead {
  int opcode = 0;
  bool last = false;
  std::size_t head_bytes = 0;
  std::size_t payload_bytes = 0;
};

std::uint64_t number(std::string_view bytes) {
  std::uint64_t value = 0;
  for (const char byte : bytes) value = value << 8 | static_cast<std::uint8_t>(byte);
  return value;
}

/// Of a frame from a server, which is not masked. No bytes of a head: it has not come whole.
FrameHead head_in(std::string_view bytes) {
  if (bytes.size() < 2) return {};
  FrameHead head;
  head.last = (static_cast<std::uint8_t>(bytes[0]) & kLast) != 0;
  head.opcode = static_cast<std::uint8_t>(bytes[0]) & 0x0F;
  const std::size_t length = static_cast<std::uint8_t>(bytes[1]) & 0x7F;
  const std::size_t more = length == kShort ? 2 : length == kLong ? 8 : 0;
  if (bytes.size() < 2 + more) return {};
  head.payload_bytes = more == 0 ? length : static_cast<std::size_t>(number(bytes.substr(2, more)));
  head.head_bytes = 2 + more;
  return head;
}

}  // namespace

bool WebSocket::open(std::uint16_t port, const std::string& path, const std::string& token) {
  socket_ = PlainSocket::connected(port, kPatience);
  const std::string fields =
      "Connection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
      "Sec-WebSocket-Key: MDEyMzQ1Njc4OWFiY2RlZg==\r\n";
  if (!socket_.open() || !socket_.send(head_of("GET", path, token, 0, fields))) return false;
  come_.clear();
  message_.clear();
  std::array<char, 4096> piece{};
  std::size_t end = std::string::npos;
  while ((end = come_.find("\r\n\r\n")) == std::string::npos) {
    const long count = socket_.receive(piece.data(), piece.size());
    if (count <= 0) return false;
    come_.append(piece.data(), static_cast<std::size_t>(count));
  }
  const bool agreed = come_.starts_with("HTTP/1.1 101");
  come_.erase(0, end + 4);
  return agreed;
}

bool WebSocket::send_frame(int opcode, std::string_view payload) {
  std::string bytes;
  bytes.reserve(payload.size() + 14);
  bytes.push_back(static_cast<char>(kLast | opcode));
  const std::size_t length = payload.size();
  const std::size_t more = length < kShort ? 0 : length < 65536 ? 2 : 8;
  bytes.push_back(static_cast<char>(kMasked | (more == 0 ? length : more == 2 ? kShort : kLong)));
  for (std::size_t i = more; i-- > 0;) bytes.push_back(static_cast<char>(length >> (8 * i) & 0xFF));
  bytes.append(4, '\0');  // the masking key
  bytes.append(payload);
  return socket_.send(bytes);
}

bool WebSocket::take_frames(const Heard& heard) {
  std::size_t taken = 0;
  bool goes_on = true;
  while (goes_on) {
    const std::string_view rest = std::string_view(come_).substr(taken);
    const FrameHead head = head_in(rest);
    if (head.head_bytes == 0 || rest.size() - head.head_bytes < head.payload_bytes) break;
    const std::string_view payload = rest.substr(head.head_bytes, head.payload_bytes);
    taken += head.head_bytes + head.payload_bytes;
    if (head.opcode == kClose) goes_on = false;
    if (head.opcode == kPing) goes_on = send_frame(kPong, payload);
    if (head.opcode > kBinary) continue;
    message_.append(payload);
    if (!head.last) continue;
    heard(message_);
    message_.clear();
  }
  come_.erase(0, taken);
  return goes_on;
}

bool WebSocket::hear_until(std::chrono::steady_clock::time_point end, const Heard& heard) {
  using std::chrono::milliseconds;
  std::array<char, 16384> piece{};
  while (true) {
    if (!take_frames(heard)) return false;
    const auto left = std::chrono::ceil<milliseconds>(end - std::chrono::steady_clock::now());
    if (!socket_.comes_within(std::max(left, milliseconds(0)))) return true;
    const long count = socket_.receive(piece.data(), piece.size());
    if (count <= 0) return false;
    come_.append(piece.data(), static_cast<std::size_t>(count));
    if (left <= milliseconds(0)) return take_frames(heard);
  }
}

}  // namespace homeward::bench
