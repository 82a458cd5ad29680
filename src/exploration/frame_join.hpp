// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "core/pose2.hpp"
#include "exploration/explorer.hpp"
#include "exploration/stand_again.hpp"

namespace homeward::exploration {

struct FrameJoinConfig {
  int looked_at = 8;        // so many of the other's pictures, those whose colours are the likest, are compared,
  int worked_out = 2;       // and the sweeps of so many, those that agree with it best
  StandAgainConfig stands;  // how
  double apart_m = 2.0;     // two agreements nearer to each other are not independent
  double same_m = 0.5;      // so far, and turned by so much, two of them say the same
  double same_rad = 0.1;
  int every = 5;                // once joined, so many pictures lie between two agreements
  double looks_within_m = 1.5;  // and only pictures so near are compared
};

/// How the floors of two explorations lie to each other: found by the sweep and the picture of one robot, held against
/// key views of the other (stand_about: sweeps agree, and pictures agree on the turn). Nothing until two agreements
/// that are independent, taken some way apart, say the same, and more do so than say anything else: where a building
/// looks alike, one alone may be wrong. Ours.
class FrameJoin {
 public:
  explicit FrameJoin(const FrameJoinConfig& config = {}) : config_(config) {}

  /// The first robot has taken its newest picture, and holds it against those of the second.
  void first_looks(const Explorer& first, const Explorer& second);
  /// The other way about.
  void second_looks(const Explorer& first, const Explorer& second);
  /// How the second one's floor lies in the first one's by all that has been seen; nothing: not known.
  [[nodiscard]] std::optional<Pose2> first_from_second(const Explorer& first, const Explorer& second) const;
  /// So many agreements have been found, right or wrong.
  [[nodiscard]] std::size_t agreements() const { return seen_.size(); }

 private:
  /// A key view of each, and how they lie to each other: it moves with them.
  struct Seen {
    std::size_t first = 0;
    std::size_t second = 0;
    Pose2 first_from_second;
  };
  [[nodiscard]] bool is_due(std::size_t pictures_since, const std::optional<Pose2>& joined) const;

  FrameJoinConfig config_;
  std::vector<Seen> seen_;
  std::size_t first_pictures_ = 0;  // where the latest agreement was found
  std::size_t second_pictures_ = 0;
};

}  // namespace homeward::exploration
