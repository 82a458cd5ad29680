// SPDX-License-Identifier: Apache-2.0
#include "repeat/arc_surroundings.hpp"

#include <algorithm>
#include <map>

#include "core/index.hpp"
#include "core/median.hpp"
#include "repeat/node_scale.hpp"

namespace homeward::repeat {
namespace {

constexpr double kSkySpread = 0.003;  // nearness in arcs of what shows no parallax: a pixel or so
constexpr double kLeastLogSpread = 0.01;
constexpr double kWorstLogSpread = 1.0;  // of a distance: more says no more

// What warns of an arc that is far off (docs/experiments/teaching_a_path.md), and what its distances are worth then.
constexpr double kDoubtfulSpread_rad = 0.052;
constexpr double kDoubtfulLead = 10.0;
constexpr std::size_t kDoubtfulFeatures = 30;
constexpr double kDoubtfulLogSpread = 0.3;

bool is_doubtful(const Arc& arc) {
  return arc.direction_spread_rad > kDoubtfulSpread_rad || arc.lead < kDoubtfulLead ||
         arc.matches.size() < kDoubtfulFeatures;
}

/// Arcs around one, in one piece of the path.
struct Range {
  int first = 0;
  int last = 0;
};

Range range_around(const TaughtPath& path, int arc, int reach) {
  Range range{arc, arc};
  const int count = static_cast<int>(path.arcs.size());
  const auto joined = [&](int before) { return path.arcs[at(before)].from + 1 == path.arcs[at(before + 1)].from; };
  while (range.first > 0 && arc - range.first < reach && joined(range.first - 1)) --range.first;
  while (range.last + 1 < count && range.last - arc < reach && joined(range.last)) ++range.last;
  return range;
}

/// How much longer `after` is than `before`; all arcs between them are turns on the spot.
std::optional<double> longer_by(const TaughtPath& path, int before, int after, int fewest_scaled) {
  if (after == before + 1) {
    const auto& scale = path.key_images[at(path.arcs[at(after)].from)].scale;
    if (scale) return scale->ratio;
    return std::nullopt;
  }
  const auto scale = node_scale(path.arcs[at(before)], path.arcs[at(after)], fewest_scaled);
  if (scale) return scale->ratio;
  return std::nullopt;
}

std::optional<int> unit_arc_in(const TaughtPath& path, const Range& range, int arc) {
  for (int j = arc; j >= range.first; --j) {
    if (path.arcs[at(j)].has_baseline) return j;
  }
  for (int j = arc + 1; j <= range.last; ++j) {
    if (path.arcs[at(j)].has_baseline) return j;
  }
  return std::nullopt;
}

/// Length of each arc of the range in units of one of them; none where that is not known.
std::vector<std::optional<double>> lengths(const TaughtPath& path, const Range& range, int unit_arc,
                                           int fewest_scaled) {
  std::vector<std::optional<double>> found(at(range.last - range.first + 1));
  found[at(unit_arc - range.first)] = 1.0;
  const auto walk = [&](int step) {
    int from = unit_arc;
    for (int j = unit_arc + step; j >= range.first && j <= range.last; j += step) {
      if (!path.arcs[at(j)].has_baseline) continue;
      const auto ratio = longer_by(path, std::min(from, j), std::max(from, j), fewest_scaled);
      if (!ratio) return;
      const double known = *found[at(from - range.first)];
      found[at(j - range.first)] = step > 0 ? known * *ratio : known / *ratio;
      from = j;
    }
  };
  walk(1);
  walk(-1);
  return found;
}

std::vector<KeyPose> key_poses(const TaughtPath& path, const ArcSurroundings& around, const Range& range) {
  std::vector<KeyPose> keys(around.units.size() + 1);
  const int here = around.arc - range.first;
  keys[at(here)].key = path.arcs[at(around.arc)].from;
  const auto place = [&](int known, int next) {
    const int j = std::min(known, next);
    const Arc& arc = path.arcs[at(range.first + j)];
    const KeyPose& a = keys[at(known)];
    KeyPose& b = keys[at(next)];
    const bool forwards = next > known;
    const Eigen::Matrix3d& turn = arc.motion.current_from_target;
    b.key = a.key + (forwards ? 1 : -1);
    b.local_from_key = a.local_from_key * (forwards ? turn : Eigen::Matrix3d(turn.transpose()));
    b.position = a.position;
    b.is_placed = a.is_placed;
    if (!arc.has_baseline) return;
    const auto& unit = around.units[at(j)];
    b.is_placed = b.is_placed && unit.has_value();
    if (!unit) return;
    const Eigen::Matrix3d& first = forwards ? a.local_from_key : b.local_from_key;
    const Eigen::Vector3d way = *unit * (first * arc.motion.target_in_current);
    b.position += forwards ? way : Eigen::Vector3d(-way);
  };
  for (int k = here + 1; k < static_cast<int>(keys.size()); ++k) place(k - 1, k);
  for (int k = here - 1; k >= 0; --k) place(k + 1, k);
  return keys;
}

Landmark landmark_of(const ArcMatch& match, const KeyPose& key, const std::optional<double>& unit,
                     double least_log_spread) {
  Landmark landmark;
  landmark.feature = match.feature;
  if (!unit || !key.is_placed) {
    landmark.bearing = key.local_from_key * match.from_bearing;
    return landmark;
  }
  const bool is_near = match.from_nearness > 0.0;
  const double nearness = is_near ? match.from_nearness / *unit : 0.0;
  const double spread =
      is_near ? nearness * std::clamp(match.distance_spread, 0.0, kWorstLogSpread) : kSkySpread / *unit;
  const Eigen::Vector3d point = key.local_from_key * match.from_bearing + nearness * key.position;
  const double farther = point.norm();
  landmark.bearing = point / farther;
  landmark.nearness = nearness / farther;
  landmark.nearness_spread = std::max(spread, least_log_spread * nearness) / farther;
  landmark.has_distance = true;
  return landmark;
}

/// Whether what one arc says of a landmark is to be preferred.
bool is_better(const Landmark& now, const Landmark& before) {
  if (now.has_distance != before.has_distance) return now.has_distance;
  if (now.in_arc != before.in_arc) return now.in_arc;
  return now.nearness_spread < before.nearness_spread;
}

}  // namespace

ArcSurroundings surroundings_of(const TaughtPath& path, int arc, int reach, int fewest_scaled) {
  const Range range = range_around(path, arc, reach);
  ArcSurroundings around;
  around.arc = arc;
  around.unit_arc = unit_arc_in(path, range, arc);
  around.units.resize(at(range.last - range.first + 1));
  if (around.unit_arc) around.units = lengths(path, range, *around.unit_arc, fewest_scaled);
  around.keys = key_poses(path, around, range);
  std::map<int, Landmark> landmarks;
  for (int j = range.first; j <= range.last; ++j) {
    const double least_log_spread = is_doubtful(path.arcs[at(j)]) ? kDoubtfulLogSpread : kLeastLogSpread;
    for (const ArcMatch& match : path.arcs[at(j)].matches) {
      Landmark landmark =
          landmark_of(match, around.keys[at(j - range.first)], around.units[at(j - range.first)], least_log_spread);
      landmark.in_arc = j == arc;
      const auto [known, is_new] = landmarks.emplace(match.feature, landmark);
      if (is_new) continue;
      const bool in_arc = known->second.in_arc || landmark.in_arc;
      if (is_better(landmark, known->second)) known->second = landmark;
      known->second.in_arc = in_arc;
    }
  }
  std::vector<double> nearnesses;
  for (const auto& [feature, landmark] : landmarks) {
    if (landmark.has_distance) nearnesses.push_back(landmark.nearness);
  }
  if (!nearnesses.empty()) around.nearness = median(std::move(nearnesses));
  for (auto& [feature, landmark] : landmarks) {
    if (!landmark.has_distance) landmark.nearness = landmark.nearness_spread = around.nearness;
    around.landmarks.push_back(landmark);
  }
  return around;
}

}  // namespace homeward::repeat
