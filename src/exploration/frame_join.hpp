// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
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
  int every = 5;                    // once joined, so many pictures lie between two agreements
  double looks_within_m = 1.5;      // and only pictures so near are compared
  double directed_from_m = 0.5;     // Of pictures from so far on,
  double directed_to_m = 2.5;       // and up to here, the direction in which they lie is compared,
  double same_direction_rad = 0.5;  // and is the same if it is no more off
  double in_view_m = 6.0;           // nearer than that, a robot in plain view of the other is seen,
  double body_m = 0.6;              // not farther from where it should be than this
  int passed_over = 2;              // so often it may be missed, and as often as it was seen
  std::size_t most_told = 32;       // of another's agreements so many are taken in,
  double told_within_m = 10.0;      // whose views lie no farther from each other
};

/// A key view of each robot, by its number, and how they lie to each other: it moves with them.
struct JoinAgreement {
  std::size_t first = 0;
  std::size_t second = 0;
  Pose2 first_from_second;
  bool first_looked = false;
};

/// How the floors of two explorations lie to each other: found by the sweep and the picture of one robot, held against
/// key views of the other (stand_about: sweeps agree, and pictures agree on the turn; and pictures farther off lie in
/// the direction where they should, which tells places along a corridor apart). Nothing until two agreements that are
/// independent, taken some way apart, say the same, and more do so than say anything else: where a building looks
/// alike, one alone may be wrong. What would have put a robot into the plain view of the other, which did not see it
/// there, is wrong. A building that is the same from two sides may still be taken for the wrong one. Ours.
class FrameJoin {
 public:
  explicit FrameJoin(const FrameJoinConfig& config = {}) : config_(config) {}

  /// The first robot has taken its newest picture, and holds it against those of the second, which stands at
  /// `second_from_robot` of its own floor; nothing: nobody knows where it stood then.
  void first_looks(const Explorer& first, const Explorer& second, const std::optional<Pose2>& second_from_robot);
  /// The other way about.
  void second_looks(const Explorer& first, const Explorer& second, const std::optional<Pose2>& first_from_robot);
  /// What another has found about the same two, in place of what it told before: it counts beside what was found here
  /// and by the same rules. Passed over: what lies nowhere or too far away, and the first ones of more than are taken
  /// in; as long as their views are not here, those that name such; and what was found here as well.
  void set_told(std::span<const JoinAgreement> told);
  /// What was found here, oldest first: none that was told.
  [[nodiscard]] const std::vector<JoinAgreement>& found() const { return found_; }
  /// How the second one's floor lies in the first one's by all that has been seen; nothing: not known.
  [[nodiscard]] std::optional<Pose2> first_from_second(const Explorer& first, const Explorer& second) const;
  /// So many agreements have been found here, right or wrong.
  [[nodiscard]] std::size_t agreements() const { return found_.size(); }

 private:
  /// A key view of one robot, and where the other was then, by the newest of its own.
  struct Moment {
    bool first_looks = false;
    std::size_t seeing = 0;
    std::size_t other = 0;
    Pose2 view_from_other;
  };
  [[nodiscard]] bool may_be(const Pose2& first_from_second, const Explorer& first, const Explorer& second) const;
  /// What was told and found, each once, whose views are here.
  [[nodiscard]] std::vector<JoinAgreement> counted(const Explorer& first, const Explorer& second) const;
  [[nodiscard]] bool is_due(std::size_t pictures_since, const std::optional<Pose2>& joined) const;

  FrameJoinConfig config_;
  std::vector<JoinAgreement> found_;
  std::vector<JoinAgreement> told_;
  std::vector<Moment> moments_;
  std::size_t first_pictures_ = 0;  // where the latest agreement was found
  std::size_t second_pictures_ = 0;
};

}  // namespace homeward::exploration
