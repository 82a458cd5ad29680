// SPDX-License-Identifier: Apache-2.0
#include "exploration/frame_join.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "core/angles.hpp"
#include "matching/verify.hpp"

namespace homeward::exploration {
namespace {

struct JoinCandidate {
  double order = 0.0;  // least first
  std::size_t view = 0;
};

double colours_apart(const features::Appearance& a, const features::Appearance& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.colour_moments.size(); ++i) {
    const double apart = static_cast<double>(a.colour_moments[i]) - static_cast<double>(b.colour_moments[i]);
    sum += apart * apart;
  }
  return sum;
}

void keep_first(std::vector<JoinCandidate>& candidates, int count) {
  std::ranges::stable_sort(candidates, {}, &JoinCandidate::order);
  candidates.resize(std::min(candidates.size(), static_cast<std::size_t>(count)));
}

/// Which pictures of the other may show the place of our newest one: by where it lies, or else by their colours.
std::vector<JoinCandidate> candidates_among(const Explorer& ours, const Explorer& theirs,
                                            const std::optional<Pose2>& theirs_from_ours,
                                            const FrameJoinConfig& config) {
  std::vector<JoinCandidate> candidates;
  const features::Appearance& newest = *ours.views().back().appearance;
  for (std::size_t i = 0; i < theirs.views().size(); ++i) {
    if (!theirs.views()[i].appearance) continue;
    if (!theirs_from_ours) {
      candidates.push_back({colours_apart(newest, *theirs.views()[i].appearance), i});
      continue;
    }
    const Pose2 about = *theirs_from_ours * ours.poses().back();
    const double apart_m = (position_m(theirs.poses()[i]) - position_m(about)).norm();
    if (apart_m <= config.looks_within_m) candidates.push_back({apart_m, i});
  }
  keep_first(candidates, theirs_from_ours ? config.worked_out : config.looked_at);
  return candidates;
}

/// Whether most pictures farther off lie in the direction in which they should from a pose on the other's floor.
bool directions_agree(const Explorer& theirs, const features::Appearance& newest, const Pose2& stands,
                      const FrameJoinConfig& config) {
  std::vector<JoinCandidate> around;
  for (std::size_t i = 0; i < theirs.views().size(); ++i) {
    const double apart_m = (position_m(theirs.poses()[i]) - position_m(stands)).norm();
    if (theirs.views()[i].appearance && apart_m >= config.directed_from_m && apart_m <= config.directed_to_m)
      around.push_back({apart_m, i});
  }
  constexpr int kCompared = 4;
  keep_first(around, kCompared);
  int agree = 0;
  int disagree = 0;
  for (const JoinCandidate& candidate : around) {
    const auto seen = matching::verify(newest, *theirs.views()[candidate.view].appearance, {}, 1);
    if (!seen) continue;
    const Pose2 there = inverse(stands) * theirs.poses()[candidate.view];
    const double off_rad = wrap_angle(seen->pose.motion.direction_rad - std::atan2(there.y_m, there.x_m));
    ++(std::abs(off_rad) <= config.same_direction_rad ? agree : disagree);
  }
  return agree > disagree;
}

enum class InView : std::uint8_t { kSeen, kMissed, kUnknown };

/// Whether a sweep shows something where another robot stands; `at`: in the frame of the robot whose sweep it is.
InView looked_for(const RangeSweep& sweep, const Pose2& at, const FrameJoinConfig& config) {
  const Pose2 in_scan = inverse(sweep.robot_from_scan) * at;
  const double distance_m = position_m(in_scan).norm();
  if (distance_m > config.in_view_m || sweep.ranges_m.empty() || sweep.angle_step_rad == 0.0) return InView::kUnknown;
  const double whole = 2.0 * kPi / std::abs(sweep.angle_step_rad);
  double ray = (std::atan2(in_scan.y_m, in_scan.x_m) - sweep.angle_min_rad) / sweep.angle_step_rad;
  ray -= whole * std::floor(ray / whole);
  const auto middle = static_cast<std::size_t>(std::lround(ray));
  if (middle >= sweep.ranges_m.size()) return InView::kUnknown;
  const auto range_m = static_cast<double>(sweep.ranges_m[middle]);
  if (!std::isfinite(range_m) || range_m >= sweep.range_max_m || range_m < distance_m - config.body_m)
    return InView::kUnknown;
  return range_m > distance_m + config.body_m ? InView::kMissed : InView::kSeen;
}

/// Where our newest key view was taken, on the other's floor, and by which of its views.
std::optional<std::pair<std::size_t, Pose2>> newest_on(const Explorer& ours, const Explorer& theirs,
                                                       const std::optional<Pose2>& theirs_from_ours,
                                                       const FrameJoinConfig& config) {
  if (ours.views().empty() || !ours.views().back().appearance) return std::nullopt;
  const KeyView& newest = ours.views().back();
  std::vector<JoinCandidate> agreeing;
  for (const JoinCandidate& candidate : candidates_among(ours, theirs, theirs_from_ours, config)) {
    const auto seen = matching::verify(*newest.appearance, *theirs.views()[candidate.view].appearance, {}, 1);
    if (seen) agreeing.push_back({-static_cast<double>(seen->pose.inliers.size()), candidate.view});
  }
  keep_first(agreeing, config.worked_out);
  for (const JoinCandidate& candidate : agreeing) {
    const auto stands =
        stand_about(theirs, theirs.poses()[candidate.view], newest.sweep, *newest.appearance, config.stands);
    if (stands && directions_agree(theirs, *newest.appearance, *stands, config))
      return std::pair(candidate.view, *stands);
  }
  return std::nullopt;
}

}  // namespace

bool FrameJoin::is_due(std::size_t pictures_since, const std::optional<Pose2>& joined) const {
  return !joined || pictures_since >= static_cast<std::size_t>(config_.every);
}

/// Whether each robot was seen where it stood in plain view of the other.
bool FrameJoin::may_be(const Pose2& first_from_second, const Explorer& first, const Explorer& second) const {
  int seen = 0;
  int missed = 0;
  for (const Moment& moment : moments_) {
    const Explorer& sees = moment.first_looks ? first : second;
    const Explorer& other = moment.first_looks ? second : first;
    const Pose2 sees_from_other = moment.first_looks ? first_from_second : inverse(first_from_second);
    const Pose2 at =
        inverse(sees.poses()[moment.seeing]) * sees_from_other * other.poses()[moment.other] * moment.view_from_other;
    const InView looked = looked_for(sees.views()[moment.seeing].sweep, at, config_);
    seen += looked == InView::kSeen ? 1 : 0;
    missed += looked == InView::kMissed ? 1 : 0;
  }
  return missed <= config_.passed_over && missed <= seen;
}

void FrameJoin::first_looks(const Explorer& first, const Explorer& second,
                            const std::optional<Pose2>& second_from_robot) {
  if (first.views().empty() || second.views().empty()) return;
  const std::size_t last = second.views().size() - 1;
  if (second_from_robot)
    moments_.push_back({true, first.views().size() - 1, last, inverse(second.poses()[last]) * *second_from_robot});
  const auto joined = first_from_second(first, second);
  if (!is_due(first.views().size() - first_pictures_, joined)) return;
  const auto second_from_first = joined ? std::optional(inverse(*joined)) : std::nullopt;
  const auto stands = newest_on(first, second, second_from_first, config_);
  if (!stands) return;
  first_pictures_ = first.views().size();
  const Pose2 second_from_view = inverse(second.poses()[stands->first]) * stands->second;
  found_.push_back({first.views().size() - 1, stands->first, inverse(second_from_view), true});
}

void FrameJoin::second_looks(const Explorer& first, const Explorer& second,
                             const std::optional<Pose2>& first_from_robot) {
  if (first.views().empty() || second.views().empty()) return;
  const std::size_t last = first.views().size() - 1;
  if (first_from_robot)
    moments_.push_back({false, second.views().size() - 1, last, inverse(first.poses()[last]) * *first_from_robot});
  const auto joined = first_from_second(first, second);
  if (!is_due(second.views().size() - second_pictures_, joined)) return;
  const auto stands = newest_on(second, first, joined, config_);
  if (!stands) return;
  second_pictures_ = second.views().size();
  found_.push_back(
      {stands->first, second.views().size() - 1, inverse(first.poses()[stands->first]) * stands->second, false});
}

void FrameJoin::set_told(std::span<const JoinAgreement> told) {
  told_.clear();
  for (const JoinAgreement& one : told.last(std::min(told.size(), config_.most_told))) {
    const Pose2& apart = one.first_from_second;
    if (!(position_m(apart).norm() <= config_.told_within_m) || !std::isfinite(apart.theta_rad)) continue;
    told_.push_back(one);
    told_.back().first_from_second.theta_rad = wrap_angle(apart.theta_rad);
  }
}

std::vector<JoinAgreement> FrameJoin::counted(const Explorer& first, const Explorer& second) const {
  std::vector<JoinAgreement> all;
  const auto is_there = [&](const JoinAgreement& told) {
    const auto same = [&](const JoinAgreement& one) {
      return one.first == told.first && one.second == told.second && one.first_looked == told.first_looked;
    };
    return std::ranges::any_of(found_, same) || std::ranges::any_of(all, same);
  };
  for (const JoinAgreement& one : told_)
    if (one.first < first.views().size() && one.second < second.views().size() && !is_there(one)) all.push_back(one);
  all.insert(all.end(), found_.begin(), found_.end());
  return all;
}

std::optional<Pose2> FrameJoin::first_from_second(const Explorer& first, const Explorer& second) const {
  const std::vector<JoinAgreement> all = counted(first, second);
  std::vector<Pose2> said;
  for (const JoinAgreement& seen : all)
    said.push_back(first.poses()[seen.first] * seen.first_from_second * inverse(second.poses()[seen.second]));
  const auto same = [&](std::size_t a, std::size_t b) {
    const Pose2& at = second.poses()[all[a].second];
    const Pose2 apart = inverse(said[a] * at) * (said[b] * at);
    return position_m(apart).norm() <= config_.same_m && std::abs(apart.theta_rad) <= config_.same_rad;
  };
  // Where the robot stood that looked.
  const auto looked_from_m = [&](const JoinAgreement& seen) {
    const Pose2& first_view = first.poses()[seen.first];
    return position_m(seen.first_looked ? first_view : first_view * seen.first_from_second);
  };
  const auto independent = [&](std::size_t a, std::size_t b) {
    return (looked_from_m(all[a]) - looked_from_m(all[b])).norm() >= config_.apart_m;
  };
  std::vector<bool> possible;
  for (const Pose2& one : said) possible.push_back(may_be(one, first, second));
  std::vector<int> support(all.size(), 0);
  std::vector<bool> independent_support(all.size(), false);
  for (std::size_t a = 0; a < all.size(); ++a) {
    for (std::size_t b = 0; b < all.size(); ++b) {
      if (!possible[a] || !same(a, b)) continue;
      ++support[a];
      if (independent(a, b)) independent_support[a] = true;
    }
  }
  std::optional<std::size_t> best;  // the newest of those with most
  for (std::size_t i = 0; i < all.size(); ++i)
    if (possible[i] && (!best || support[i] >= support[*best])) best = i;
  if (!best || !independent_support[*best]) return std::nullopt;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (possible[i] && support[i] >= support[*best] && !same(*best, i)) return std::nullopt;
  return said[*best];
}

}  // namespace homeward::exploration
