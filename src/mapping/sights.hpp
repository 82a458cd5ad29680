// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <utility>

#include "mapping/mapping_input.hpp"

namespace homeward::mapping {

/// What one picture knows of where another was taken.
struct Sight {
  double bearing_rad = 0.0;  // of the other viewpoint, in this picture's robot frame
  double turn_rad = 0.0;     // heading of the other minus that of this one
  double confidence = 0.0;   // that the bearing is right within 15 degrees
  int inliers = 0;
};

/// Two pictures, each looked for in the other.
struct MutualSight {
  std::optional<Sight> ahead;  // the second seen from the first; nothing: no motion explains what both see
  std::optional<Sight> back;
  bool disagreed = false;
};

/// Joins a comparison of the second picture with the first and one of the first with the second, made independently.
/// Where they tell the same motion, each way keeps its own. Where only one found any, the other way is its inverse.
/// Where they disagree at most one is right: both ways take the surer one, at the probability that is left to it:
/// c1 (1 - c2) / (1 - c1 c2), Bayes' rule for two statements that exclude each other.
/// That both ways are compared is ours, because matching is not symmetric.
MutualSight join_sights(const PairRelation& ahead, const PairRelation& back);

/// Sights between images of a tour, each pair compared once, when it is first asked for. Deterministic.
class Sights {
 public:
  explicit Sights(const MappingInput& input) : input_(input) {}

  /// `to` seen from `from`. Precondition: from != to.
  std::optional<Sight> seen(int from, int to);
  /// The smaller confidence of the two ways; 0 where there is no sight.
  double confidence(int a, int b);

 private:
  const MutualSight& between(int low, int high);

  MappingInput input_;
  std::map<std::pair<int, int>, MutualSight> known_;
};

}  // namespace homeward::mapping
