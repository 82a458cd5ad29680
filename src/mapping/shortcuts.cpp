// SPDX-License-Identifier: Apache-2.0
#include "mapping/shortcuts.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <queue>
#include <set>
#include <utility>

#include "core/angles.hpp"
#include "core/index.hpp"
#include "map/lookup.hpp"
#include "map/metric_layout.hpp"
#include "mapping/compare_all.hpp"
#include "mapping/sights.hpp"

namespace homeward::mapping {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The places of a map where the layout has their prototypes, joined by its edges.
class Ways {
 public:
  Ways(const map::TopologicalMap& map, const map::MetricLayout& layout) : arcs_(map.places.size()) {
    for (const map::Place& place : map.places) {
      const auto found = layout.find(place.prototype);
      const bool known = found != layout.end() && found->second.metric;
      poses_.push_back(known ? std::optional(found->second) : std::nullopt);
    }
    const auto index = map::place_indices(map);
    for (const map::Edge& edge : map.edges) join(index.at(edge.from), index.at(edge.to));
  }

  [[nodiscard]] int places() const { return static_cast<int>(poses_.size()); }
  [[nodiscard]] const std::optional<map::LaidOutImage>& pose(int place) const { return poses_[at(place)]; }
  [[nodiscard]] Eigen::Vector2d position(int place) const {
    return {poses_[at(place)]->map_from_robot.x_m, poses_[at(place)]->map_from_robot.y_m};
  }
  [[nodiscard]] bool comparable(int a, int b) const {
    return poses_[at(a)] && poses_[at(b)] && poses_[at(a)]->component == poses_[at(b)]->component;
  }
  [[nodiscard]] bool joined(int a, int b) const { return arcs_[at(a)].contains(b); }
  void join(int a, int b) {
    if (a == b || !comparable(a, b)) return;
    arcs_[at(a)].insert(b);
    arcs_[at(b)].insert(a);
  }
  void part(int a, int b) {
    arcs_[at(a)].erase(b);
    arcs_[at(b)].erase(a);
  }

  /// The lengths of the shortest ways from a place (Dijkstra), those of `bound_m` and more as infinity.
  [[nodiscard]] std::vector<double> from(int start, double bound_m = kInfinity) const {
    std::vector<double> way_m(poses_.size(), kInfinity);
    if (!poses_[at(start)]) return way_m;
    using Reached = std::pair<double, int>;
    std::priority_queue<Reached, std::vector<Reached>, std::greater<>> open;
    way_m[at(start)] = 0.0;
    open.emplace(0.0, start);
    while (!open.empty()) {
      const auto [length_m, place] = open.top();
      open.pop();
      if (length_m > way_m[at(place)]) continue;
      for (const int next : arcs_[at(place)]) {
        const double longer_m = length_m + (position(next) - position(place)).norm();
        if (longer_m >= std::min(bound_m, way_m[at(next)])) continue;
        way_m[at(next)] = longer_m;
        open.emplace(longer_m, next);
      }
    }
    return way_m;
  }

 private:
  std::vector<std::optional<map::LaidOutImage>> poses_;
  std::vector<std::set<int>> arcs_;
};

struct Candidate {
  int a = 0;
  int b = 0;
  double length_m = 0.0;
  double way_m = 0.0;
};

/// How long the way over edges has to be for a straight one to be worth it.
double worth_m(double length_m, const ShortcutConfig& config) {
  return std::max(config.stretch * length_m, length_m + config.saves_m);
}

/// Pairs of places by how far they are apart, nearest first.
std::vector<Candidate> candidates(const map::TopologicalMap& map, const Ways& ways, const ShortcutConfig& config) {
  std::set<std::pair<ImageId, ImageId>> decided;
  for (const map::Shortcut& shortcut : map.shortcuts) {
    const map::Place* a = map::find_place_of(map, shortcut.image_a);
    const map::Place* b = map::find_place_of(map, shortcut.image_b);
    if (a != nullptr && b != nullptr) decided.insert(std::minmax(a->prototype, b->prototype));
  }
  std::vector<Candidate> found;
  for (int a = 0; a < ways.places(); ++a) {
    if (!ways.pose(a)) continue;
    std::vector<double> way_m;
    for (int b = a + 1; b < ways.places(); ++b) {
      if (!ways.comparable(a, b) || ways.joined(a, b)) continue;
      const double length_m = (ways.position(b) - ways.position(a)).norm();
      if (length_m < config.least_m || length_m > config.most_m) continue;
      if (decided.contains(std::minmax(map.places[at(a)].prototype, map.places[at(b)].prototype))) continue;
      if (way_m.empty()) way_m = ways.from(a);
      const bool there_is_one = std::isfinite(way_m[at(b)]);
      if (there_is_one && way_m[at(b)] > worth_m(length_m, config)) found.push_back({a, b, length_m, way_m[at(b)]});
    }
  }
  std::ranges::stable_sort(found, {}, &Candidate::length_m);
  return found;
}

double bearing_of(const Pose2& from, const Pose2& to) {
  const Pose2 seen = inverse(from) * to;
  return std::atan2(seen.y_m, seen.x_m);
}

/// What a pair of places is as a shortcut; nothing where not everything speaks for it.
class Judge {
 public:
  Judge(const map::TopologicalMap& map, const Ways& ways, const SeenFloor& floor, const ShortcutConfig& config)
      : map_(map), ways_(ways), floor_(floor), config_(config) {}

  [[nodiscard]] std::optional<map::Shortcut> shortcut(const Candidate& pair) const {
    const map::Place& a = map_.places[at(pair.a)];
    const map::Place& b = map_.places[at(pair.b)];
    const SeenStrip strip = floor_.strip(ways_.pose(pair.a)->component, ways_.position(pair.a), ways_.position(pair.b),
                                         config_.half_body_m + config_.margin_m, config_.sweeps_within_m);
    if (!strip.free || !sweeps_agree(a, b)) return std::nullopt;
    constexpr std::uint64_t kSeed = 1;
    const MutualSight seen = join_sights(relate(a.appearances.front(), b.appearances.front(), {}, kSeed),
                                         relate(b.appearances.front(), a.appearances.front(), {}, kSeed + 1));
    if (!seen.ahead || seen.disagreed || !as_laid_out(pair, *seen.ahead, *seen.back)) return std::nullopt;
    map::Shortcut found;
    found.image_a = a.prototype;
    found.image_b = b.prototype;
    found.bearing_rad = seen.ahead->bearing_rad;
    found.turn_rad = seen.ahead->turn_rad;
    found.back_bearing_rad = seen.back->bearing_rad;
    found.length_m = pair.length_m;
    found.way_m = pair.way_m;
    found.clear_m = strip.clear_m;
    found.confidence = std::min(seen.ahead->confidence, seen.back->confidence);
    found.inliers = std::min(seen.ahead->inliers, seen.back->inliers);
    return found;
  }

 private:
  [[nodiscard]] bool sweeps_agree(const map::Place& a, const map::Place& b) const {
    const auto ahead = floor_.agreement(a.prototype, b.prototype, config_.least_hits);
    const auto back = floor_.agreement(b.prototype, a.prototype, config_.least_hits);
    return ahead && back && std::min(*ahead, *back) >= config_.agreement;
  }

  [[nodiscard]] bool as_laid_out(const Candidate& pair, const Sight& ahead, const Sight& back) const {
    if (std::min(ahead.confidence, back.confidence) < config_.confidence) return false;
    const Pose2& a = ways_.pose(pair.a)->map_from_robot;
    const Pose2& b = ways_.pose(pair.b)->map_from_robot;
    const double off_rad = config_.bearing_rad + std::atan2(config_.layout_m, pair.length_m);
    return std::abs(wrap_angle(ahead.bearing_rad - bearing_of(a, b))) <= off_rad &&
           std::abs(wrap_angle(back.bearing_rad - bearing_of(b, a))) <= off_rad &&
           std::abs(wrap_angle(ahead.turn_rad - (b.theta_rad - a.theta_rad))) <= config_.turn_rad;
  }

  const map::TopologicalMap& map_;
  const Ways& ways_;
  const SeenFloor& floor_;
  const ShortcutConfig& config_;
};

}  // namespace

std::vector<map::Shortcut> propose_shortcuts(const map::TopologicalMap& map, std::span<const TourSweep> sweeps,
                                             const ShortcutConfig& config) {
  const map::MetricLayout layout = map::metric_layout(map);
  const SeenFloor floor(sweeps, layout);
  Ways ways(map, layout);
  const Judge judge(map, ways, floor, config);
  std::vector<std::pair<Candidate, map::Shortcut>> taken;
  const auto needed = [&](const Candidate& pair) {
    const double bound_m = worth_m(pair.length_m, config);
    return ways.from(pair.a, bound_m)[at(pair.b)] >= bound_m;
  };
  for (const Candidate& pair : candidates(map, ways, config)) {
    if (!needed(pair)) continue;
    auto found = judge.shortcut(pair);
    if (!found) continue;
    ways.join(pair.a, pair.b);
    taken.emplace_back(pair, std::move(*found));
  }
  std::ranges::stable_sort(taken, {}, [](const auto& one) { return one.second.way_m - one.second.length_m; });
  std::vector<map::Shortcut> kept;
  for (auto& [pair, shortcut] : taken) {
    ways.part(pair.a, pair.b);
    if (!needed(pair)) continue;
    ways.join(pair.a, pair.b);
    kept.push_back(std::move(shortcut));
  }
  std::ranges::reverse(kept);
  return kept;
}

}  // namespace homeward::mapping
