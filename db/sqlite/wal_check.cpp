// SPDX-License-Identifier: Apache-2.0
#include "db/sqlite/wal_check.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "db/sqlite/durable_file.hpp"
#include "db/sqlite/statements.hpp"

namespace homeward::db {
namespace {

constexpr std::size_t kHeader_bytes = 32;
constexpr std::size_t kFrameHeader_bytes = 24;
constexpr std::uint32_t kMagic = 0x377f0682;  // the last bit says in which order checksums take bytes

using Bytes = std::span<const std::uint8_t>;
using Pair = std::pair<std::uint32_t, std::uint32_t>;

std::uint32_t big_endian(Bytes bytes, std::size_t at) {
  return std::uint32_t{bytes[at]} << 24 | std::uint32_t{bytes[at + 1]} << 16 | std::uint32_t{bytes[at + 2]} << 8 |
         std::uint32_t{bytes[at + 3]};
}

std::uint32_t little_endian(Bytes bytes, std::size_t at) { return __builtin_bswap32(big_endian(bytes, at)); }

Pair pair_at(Bytes bytes, std::size_t at) { return {big_endian(bytes, at), big_endian(bytes, at + 4)}; }

Pair checksum(Bytes bytes, bool big, Pair sum) {
  for (std::size_t at = 0; at + 8 <= bytes.size(); at += 8) {
    sum.first += (big ? big_endian(bytes, at) : little_endian(bytes, at)) + sum.second;
    sum.second += (big ? big_endian(bytes, at + 4) : little_endian(bytes, at + 4)) + sum.first;
  }
  return sum;
}

struct Frame {
  Pair salt;
  bool commits = false;
  bool whole = false;  // it follows from all before it
};

class Log {
 public:
  explicit Log(Bytes bytes) : bytes_(bytes) {
    const bool big = (big_endian(bytes, 0) & 1U) != 0;
    Pair sum = checksum(bytes.first(24), big, {0, 0});
    whole_ = (big_endian(bytes, 0) & ~1U) == kMagic && sum == pair_at(bytes, 24);
    salt_ = pair_at(bytes, 16);
  }

  /// Nothing where the header is damaged.
  [[nodiscard]] std::optional<Pair> salt() const { return whole_ ? std::optional(salt_) : std::nullopt; }
  /// Of pages of this size.
  [[nodiscard]] std::vector<Frame> frames(std::size_t page_bytes) const {
    const bool big = (big_endian(bytes_, 0) & 1U) != 0;
    const std::size_t frame_bytes = kFrameHeader_bytes + page_bytes;
    std::vector<Frame> frames;
    Pair sum = pair_at(bytes_, 24);
    bool whole = whole_;
    for (std::size_t at = kHeader_bytes; at + frame_bytes <= bytes_.size(); at += frame_bytes) {
      const Bytes frame = bytes_.subspan(at, frame_bytes);
      sum = checksum(frame.subspan(kFrameHeader_bytes), big, checksum(frame.first(8), big, sum));
      whole = whole && pair_at(frame, 8) == salt_ && pair_at(frame, 16) == sum;
      frames.push_back({pair_at(frame, 8), big_endian(frame, 4) != 0, whole});
    }
    return frames;
  }

 private:
  Bytes bytes_;
  bool whole_ = false;
  Pair salt_;
};

/// Whether a transaction is lost that another one followed: it was on the disk before that one began. `salt`: of the
/// frames that belong to the log; older ones may stand behind them, from before it was begun anew.
bool loses_something(const std::vector<Frame>& frames, const Pair& salt) {
  bool lost = false;       // a frame that is not whole
  bool committed = false;  // and then a transaction ended
  for (const Frame& frame : frames) {
    if (frame.salt == salt && committed) return true;
    lost = lost || !frame.whole;
    committed = committed || (lost && frame.commits && frame.salt == salt);
  }
  return false;
}

/// Of a log whose header is damaged: its first frames'. One of them may be damaged too.
Pair likeliest_salt(const std::vector<Frame>& frames) {
  const auto count = [&](const Pair& salt) {
    return std::ranges::count_if(frames, [&](const Frame& frame) { return frame.salt == salt; });
  };
  if (frames.empty()) return {};
  const bool second = frames.size() > 1 && count(frames[0].salt) < count(frames[1].salt);
  return frames[second ? 1 : 0].salt;
}

}  // namespace

void check_write_ahead_log(const std::filesystem::path& database) {
  const std::filesystem::path file = database.string() + "-wal";
  if (!std::filesystem::exists(file) || !std::filesystem::exists(database)) return;
  const std::vector<std::uint8_t> log = read_whole(file);
  if (log.size() < kHeader_bytes) return;
  std::array<unsigned char, 18> head{};
  std::ifstream(database, std::ios::binary).read(reinterpret_cast<char*>(head.data()), head.size());
  const std::size_t in_database = std::size_t{head[16]} << 8 | head[17];
  const std::size_t page_bytes = in_database == 1 ? 65536 : in_database == 0 ? big_endian(log, 8) : in_database;
  if (page_bytes < 512 || page_bytes > 65536) return;  // SQLite says what is wrong with it
  const Log read(log);
  const std::vector<Frame> frames = read.frames(page_bytes);
  // A whole header says which frames are its own: none yet, where the log was just begun anew.
  if (!loses_something(frames, read.salt().value_or(likeliest_salt(frames)))) return;
  refuse(ErrorCode::kCorruptFile,
         "The log of the database's newest changes is damaged. Restore a backup; or move this file away, to go on "
         "without what it holds.",
         file.string());
}

}  // namespace homeward::db
