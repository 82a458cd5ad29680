// SPDX-License-Identifier: Apache-2.0
#include "driving/continuity.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "core/angles.hpp"
#include "matching/verify.hpp"

namespace homeward::driving {
namespace {

constexpr std::size_t kSectors = 12;

std::size_t sector_of(const features::FeatureSet& features, int feature, double turned_rad = 0.0) {
  const double azimuth_rad =
      wrap_angle(std::atan2(features.bearings(feature, 1), features.bearings(feature, 0)) - turned_rad);
  return std::min(kSectors - 1, static_cast<std::size_t>((azimuth_rad + kPi) / (2.0 * kPi) * kSectors));
}

bool in_a_row(const RecognisedPicture& before, const RecognisedPicture& now) {
  constexpr std::int64_t kLongest_ms = 1000;
  constexpr double kFarthest_m = 0.5;
  const Pose2 moved = inverse(before.odometry) * now.odometry;
  return before.appearance && now.taken_ms - before.taken_ms <= kLongest_ms &&
         std::hypot(moved.x_m, moved.y_m) <= kFarthest_m;
}

}  // namespace

std::optional<double> continued_share(const features::Appearance& before, const features::Appearance& now,
                                      double turned_rad, std::uint64_t seed) {
  constexpr int kFewest = 8;  // features of a sector
  std::array<int, kSectors> all{};
  std::array<int, kSectors> all_before{};
  std::array<int, kSectors> again{};
  for (int feature = 0; feature < now.sift.size(); ++feature) ++all[sector_of(now.sift, feature)];
  for (int feature = 0; feature < before.sift.size(); ++feature)
    ++all_before[sector_of(before.sift, feature, turned_rad)];
  if (const auto verified = matching::verify(now, before, {}, seed)) {
    for (const int inlier : verified->pose.inliers) {
      const matching::Match& match = verified->matches[static_cast<std::size_t>(inlier)];
      if (match.kind == matching::FeatureKind::kSift) ++again[sector_of(now.sift, match.current)];
    }
  }
  std::vector<double> shares;
  for (std::size_t sector = 0; sector < kSectors; ++sector) {
    if (all[sector] >= kFewest && all_before[sector] >= kFewest)
      shares.push_back(static_cast<double>(again[sector]) / all[sector]);
  }
  if (shares.size() < kSectors / 2) return std::nullopt;
  const auto median = shares.begin() + static_cast<std::ptrdiff_t>(shares.size() / 2);
  std::ranges::nth_element(shares, median);
  return *median;
}

bool breaks_off(Continuity& continuity, const RecognisedPicture& now, std::uint64_t seed) {
  // Lifted to a place that looks alike, 0.3 to 0.6 of the usual share went on, and all in the next picture. Three
  // people who walked about left 0.62 at the least, and hid some in the picture before or after as well.
  constexpr double kLeast = 0.5;
  constexpr double kDip = 0.65;
  constexpr double kNoDip = 0.85;
  constexpr double kForgets = 0.1;
  constexpr int kFewestCounted = 3;
  const RecognisedPicture before = std::exchange(continuity.latest, now);
  continuity.share.reset();
  if (!in_a_row(before, now)) return false;
  const double turned_rad = wrap_angle(now.odometry.theta_rad - before.odometry.theta_rad);
  continuity.share = continued_share(*before.appearance, *now.appearance, turned_rad, seed);
  if (!continuity.share) return false;
  const double of_usual = *continuity.share / std::max(1e-6, continuity.usual);
  const bool knows_usual = continuity.counted >= kFewestCounted;
  const bool broken = knows_usual && (of_usual < kLeast || (continuity.dips && of_usual > kNoDip));
  continuity.dips = knows_usual && !continuity.hidden && of_usual < kDip;
  continuity.hidden = of_usual < kNoDip;
  if (broken) {
    continuity = {};
    continuity.latest = now;
    return true;
  }
  ++continuity.counted;
  continuity.usual += std::max(kForgets, 1.0 / continuity.counted) * (*continuity.share - continuity.usual);
  return false;
}

}  // namespace homeward::driving
