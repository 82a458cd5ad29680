// SPDX-License-Identifier: Apache-2.0
#include "mapping/two_ways.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "core/angles.hpp"
#include "core/pose2.hpp"

namespace homeward::mapping {
namespace {

constexpr double kSureSigmas = 3.0;
constexpr double kFarExtents = 2.0;          // pairs nearer than so many places cannot tell look-alikes apart
constexpr double kSameSpotExtents = 1.0;     // meetings of one spot miss each other by no more, were ways known exactly
constexpr double kSeenTurnSigma_rad = 0.02;  // of a turn between two pictures that are not neighbours
constexpr double kTurnMargin_rad = 0.17;

enum class Say { kNothing, kAgree, kContradict };

/// Where a new image's old one lies in its frame.
Pose2 over(const Meeting& meeting) {
  const double direction_rad = static_cast<double>(meeting.seen.direction_rad);
  return {meeting.apart * std::cos(direction_rad), meeting.apart * std::sin(direction_rad),
          static_cast<double>(meeting.seen.turn_rad)};
}

Say compare(const Meeting& a, const Meeting& b, const WayBetween& new_way, const WayBetween& old_way, double extent_m) {
  if (!a.seen.verified() || !b.seen.verified()) return Say::kNothing;
  const TrackPrediction now = new_way(a.image, b.image);
  const TrackPrediction then = old_way(a.old_image, b.old_image);
  if (!now.known || !then.known) return Say::kNothing;
  if (std::max(now.distance, then.distance) < kFarExtents * extent_m) return Say::kNothing;
  // From a to b by the new way, and over to the old image of b; or over at a, and by the old way.
  const Pose2 one = Pose2{now.x, now.y, now.turn_rad} * over(b);
  const Pose2 other = over(a) * Pose2{then.x, then.y, then.turn_rad};
  const double sigma_m = std::hypot(now.distance_sigma, then.distance_sigma, kSeenTurnSigma_rad * then.distance);
  const double miss_m = std::hypot(one.x_m - other.x_m, one.y_m - other.y_m);
  if (miss_m > kSameSpotExtents * extent_m + kSureSigmas * sigma_m) return Say::kContradict;
  const double turn_sigma_rad = std::hypot(now.turn_sigma_rad, then.turn_sigma_rad);
  const double turn_miss_rad = std::abs(wrap_angle(one.theta_rad - other.theta_rad));
  if (turn_miss_rad > kTurnMargin_rad + kSureSigmas * turn_sigma_rad) return Say::kContradict;
  return sigma_m <= extent_m && miss_m <= extent_m + sigma_m ? Say::kAgree : Say::kNothing;
}

}  // namespace

std::vector<MeetingTrust> meeting_trust(std::span<const Meeting> meetings, const WayBetween& new_way,
                                        const WayBetween& old_way, double place_extent_m, int reach) {
  std::vector<std::size_t> by_image(meetings.size());
  std::iota(by_image.begin(), by_image.end(), std::size_t{0});
  std::ranges::stable_sort(by_image, {}, [&](std::size_t i) { return meetings[i].image; });
  struct Pair {
    std::size_t a = 0;
    std::size_t b = 0;
    bool agree = false;
  };
  std::vector<Pair> pairs;
  for (std::size_t x = 0; x < by_image.size(); ++x) {
    const Meeting& a = meetings[by_image[x]];
    for (std::size_t y = x + 1; y < by_image.size(); ++y) {
      const Meeting& b = meetings[by_image[y]];
      if (b.image - a.image > reach) break;
      if (a.old_image < 0 || b.old_image < 0) continue;
      const Say say = compare(a, b, new_way, old_way, place_extent_m);
      if (say != Say::kNothing) pairs.push_back({by_image[x], by_image[y], say == Say::kAgree});
    }
  }
  constexpr int kRounds = 10;
  constexpr double kAlone = 0.1;  // what goes with nothing hardly speaks once something speaks against it
  std::vector<double> weight(meetings.size(), 1.0);
  std::vector<MeetingTrust> trust;
  for (int round = 0; round < kRounds; ++round) {
    trust.assign(meetings.size(), {});
    for (const Pair& pair : pairs) {
      double MeetingTrust::*const count = pair.agree ? &MeetingTrust::agreed : &MeetingTrust::contradicted;
      trust[pair.a].*count += weight[pair.b];
      trust[pair.b].*count += weight[pair.a];
    }
    for (std::size_t i = 0; i < meetings.size(); ++i) {
      weight[i] = (kAlone + trust[i].agreed) / (kAlone + trust[i].agreed + trust[i].contradicted);
    }
  }
  return trust;
}

}  // namespace homeward::mapping
