// SPDX-License-Identifier: Apache-2.0
#include "repeat/arc_surroundings.hpp"

#include <algorithm>
#include <map>
#include <set>

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

/// Arcs around one, in the order of the way, without a gap: indices in the path.
struct Range {
  std::vector<int> arcs;
  int here = 0;  // which of them is the actual one
  [[nodiscard]] int count() const { return static_cast<int>(arcs.size()); }
  [[nodiscard]] const Arc& arc(const TaughtPath& path, int j) const { return path.arcs[at(arcs[at(j)])]; }
};

Range range_around(const TaughtPath& path, int arc, int reach) {
  Range range{{arc}, 0};
  std::set<int> keys{path.arcs[at(arc)].from, path.to_key(path.arcs[at(arc)])};
  for (int i = 0; i < reach; ++i) {
    const auto before = path.arc_before(range.arcs.front());
    if (!before || !keys.insert(path.arcs[at(*before)].from).second) break;
    range.arcs.insert(range.arcs.begin(), *before);
    ++range.here;
  }
  for (int i = 0; i < reach; ++i) {
    const auto after = path.arc_after(range.arcs.back());
    if (!after || !keys.insert(path.to_key(path.arcs[at(*after)])).second) break;
    range.arcs.push_back(*after);
  }
  return range;
}

/// Whether an arc lies beyond where the path is closed, as seen from the actual one. End and beginning of a path need
/// not agree in length and direction, so that their landmarks explain no picture together.
bool is_past_closing(const TaughtPath& path, const Range& range, int j) {
  for (int i = std::min(j, range.here); i < std::max(j, range.here); ++i) {
    if (path.is_closing(range.arc(path, i))) return true;
  }
  return false;
}

/// The scale of the node between an arc and the one after it.
const std::optional<NodeScale>& scale_between(const TaughtPath& path, const Arc& before, const Arc& after) {
  return path.is_closing(before) ? path.closing->scale : path.key_images[at(after.from)].scale;
}

/// How much longer one arc of the range is than one before it; all arcs between them are turns on the spot.
std::optional<double> longer_by(const TaughtPath& path, const Range& range, int before, int after, int fewest_scaled) {
  const Arc& first = range.arc(path, before);
  const Arc& second = range.arc(path, after);
  const auto scale =
      after == before + 1 ? scale_between(path, first, second) : node_scale(first, second, fewest_scaled);
  if (scale) return scale->ratio;
  return std::nullopt;
}

/// Which arc of the range is as long as the unit.
std::optional<int> unit_in(const TaughtPath& path, const Range& range) {
  for (int j = range.here; j >= 0; --j) {
    if (range.arc(path, j).has_baseline) return j;
  }
  for (int j = range.here + 1; j < range.count(); ++j) {
    if (range.arc(path, j).has_baseline) return j;
  }
  return std::nullopt;
}

/// Length of each arc of the range in units of one of them; none where that is not known.
std::vector<std::optional<double>> lengths(const TaughtPath& path, const Range& range, int unit, int fewest_scaled) {
  std::vector<std::optional<double>> found(range.arcs.size());
  found[at(unit)] = 1.0;
  const auto walk = [&](int step) {
    int from = unit;
    for (int j = unit + step; j >= 0 && j < range.count(); j += step) {
      if (!range.arc(path, j).has_baseline) continue;
      const auto ratio = longer_by(path, range, std::min(from, j), std::max(from, j), fewest_scaled);
      if (!ratio) return;
      const double known = *found[at(from)];
      found[at(j)] = step > 0 ? known * *ratio : known / *ratio;
      from = j;
    }
  };
  walk(1);
  walk(-1);
  return found;
}

std::vector<KeyPose> key_poses(const TaughtPath& path, const ArcSurroundings& around, const Range& range) {
  std::vector<KeyPose> keys(around.units.size() + 1);
  const int here = range.here;
  for (int j = 0; j < range.count(); ++j) keys[at(j)].key = range.arc(path, j).from;
  keys.back().key = path.to_key(range.arc(path, range.count() - 1));
  const auto place = [&](int known, int next) {
    const int j = std::min(known, next);
    const Arc& arc = range.arc(path, j);
    const KeyPose& a = keys[at(known)];
    KeyPose& b = keys[at(next)];
    const bool forwards = next > known;
    const Eigen::Matrix3d& turn = arc.motion.current_from_target;
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
  for (int j = 0; j < range.count(); ++j) {
    const Arc& arc = range.arc(path, j);
    if (arc.has_baseline) keys[at(j)].ahead = keys[at(j)].local_from_key * arc.motion.target_in_current;
  }
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

bool is_doubtful(const Arc& arc) {
  return arc.direction_spread_rad > kDoubtfulSpread_rad || arc.lead < kDoubtfulLead ||
         arc.matches.size() < kDoubtfulFeatures;
}

std::optional<int> ArcSurroundings::position_of(int key) const {
  const auto found = std::ranges::find(keys, key, &KeyPose::key);
  if (found == keys.end()) return std::nullopt;
  return static_cast<int>(found - keys.begin());
}

const KeyPose* ArcSurroundings::next_key(int number) const {
  const auto position = position_of(number);
  if (!position || at(*position) + 1 >= keys.size()) return nullptr;
  return &keys[at(*position) + 1];
}

ArcSurroundings surroundings_of(const TaughtPath& path, int arc, int reach, int fewest_scaled) {
  const Range range = range_around(path, arc, reach);
  ArcSurroundings around;
  around.arc = arc;
  around.arcs = range.arcs;
  around.units.resize(range.arcs.size());
  const auto unit = unit_in(path, range);
  if (unit) {
    around.unit_arc = range.arcs[at(*unit)];
    around.units = lengths(path, range, *unit, fewest_scaled);
  }
  around.keys = key_poses(path, around, range);
  std::map<int, Landmark> landmarks;
  for (int j = 0; j < range.count(); ++j) {
    if (is_past_closing(path, range, j)) continue;
    const Arc& one = range.arc(path, j);
    const double least_log_spread = is_doubtful(one) ? kDoubtfulLogSpread : kLeastLogSpread;
    for (const ArcMatch& match : one.matches) {
      Landmark landmark = landmark_of(match, around.keys[at(j)], around.units[at(j)], least_log_spread);
      landmark.in_arc = j == range.here;
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
