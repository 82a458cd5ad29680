// SPDX-License-Identifier: Apache-2.0
#include "mapping/sights.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/angles.hpp"
#include "mapping/compare_all.hpp"

namespace homeward::mapping {
namespace {

constexpr std::uint64_t kSeed = 1;
// Two bearings that are right within 15 degrees differ by no more than that.
constexpr double kSameBearing_rad = radians(30.0);
constexpr double kSameTurn_rad = radians(10.0);

Sight sight(const PairRelation& relation) {
  return {static_cast<double>(relation.direction_rad), static_cast<double>(relation.turn_rad),
          static_cast<double>(relation.confidence), relation.inliers};
}

/// The first picture seen from the second, given the second seen from the first.
Sight inverse(const Sight& seen) {
  Sight back = seen;
  back.bearing_rad = wrap_angle(seen.bearing_rad + kPi - seen.turn_rad);
  back.turn_rad = wrap_angle(-seen.turn_rad);
  return back;
}

bool same_motion(const Sight& a, const Sight& b) {
  return std::abs(wrap_angle(a.bearing_rad - b.bearing_rad)) <= kSameBearing_rad &&
         std::abs(wrap_angle(a.turn_rad - b.turn_rad)) <= kSameTurn_rad;
}

}  // namespace

MutualSight join_sights(const PairRelation& ahead, const PairRelation& back) {
  MutualSight joined;
  if (ahead.verified()) joined.ahead = sight(ahead);
  if (back.verified()) joined.back = sight(back);
  if (!joined.ahead && joined.back) joined.ahead = inverse(*joined.back);
  if (!joined.back && joined.ahead) joined.back = inverse(*joined.ahead);
  if (!joined.ahead || same_motion(*joined.ahead, inverse(*joined.back))) return joined;
  joined.disagreed = true;
  const double other = std::min(joined.ahead->confidence, joined.back->confidence);
  if (joined.ahead->confidence < joined.back->confidence) {
    joined.ahead = inverse(*joined.back);
  } else {
    joined.back = inverse(*joined.ahead);
  }
  const double own = joined.ahead->confidence;
  const double left = own * (1.0 - other) / std::max(1e-9, 1.0 - own * other);
  joined.ahead->confidence = left;
  joined.back->confidence = left;
  return joined;
}

const MutualSight& Sights::between(int low, int high) {
  const auto [place, is_new] = known_.try_emplace({low, high});
  if (is_new) {
    const auto& first = input_.appearances[static_cast<std::size_t>(low)];
    const auto& second = input_.appearances[static_cast<std::size_t>(high)];
    // Prototypes of different drives along an edge may never have been compared.
    PairRelation ahead = input_.pairs->relation(low, high);
    if (!ahead.verified()) ahead = relate(first, second, {}, kSeed);
    place->second = join_sights(ahead, relate(second, first, {}, kSeed + 1));
  }
  return place->second;
}

std::optional<Sight> Sights::seen(int from, int to) {
  return from < to ? between(from, to).ahead : between(to, from).back;
}

double Sights::confidence(int a, int b) {
  const MutualSight& sight = between(std::min(a, b), std::max(a, b));
  return sight.ahead ? std::min(sight.ahead->confidence, sight.back->confidence) : 0.0;
}

}  // namespace homeward::mapping
