// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

namespace homeward::agent {

struct PicturesToldConfig {
  std::int64_t beyond = 4;        // so many are under way at most
  std::int64_t apart_ms = 250;    // one goes out no sooner after the other
  std::int64_t again_ms = 3'000;  // none of them having arrived for so long, they go out again
};

/// Which picture of an exploration a companion is told next: from what it has got on, and what was lost once more.
/// Times in ms of one steady clock.
class PicturesTold {
 public:
  explicit PicturesTold(const PicturesToldConfig& config = {}) : config_(config) {}

  /// The companion has got so many, from the first on.
  void heard(std::int64_t has, std::int64_t now_ms);
  /// The one to tell now, of so many that there are; nothing: none.
  std::optional<std::int64_t> next(std::int64_t pictures, std::int64_t now_ms);
  /// So many it has got by its own word; nothing: it has not said yet.
  [[nodiscard]] const std::optional<std::int64_t>& has() const { return has_; }

 private:
  PicturesToldConfig config_;
  std::optional<std::int64_t> has_;
  std::int64_t next_ = 0;
  std::int64_t arrived_ms_ = 0;  // the latest, or the first under way went out
  std::optional<std::int64_t> told_ms_;
};

}  // namespace homeward::agent
