// SPDX-License-Identifier: Apache-2.0
#include "pipeline/replay_check.hpp"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>
#include <utility>

#include "localisation/localiser.hpp"
#include "map/difference.hpp"
#include "map/lookup.hpp"
#include "mapping/compare_all.hpp"
#include "mapping/parallel.hpp"
#include "pipeline/grow_map.hpp"
#include "pipeline/look_at_tours.hpp"
#include "pipeline/route_check.hpp"
#include "pipeline/whereabouts.hpp"

namespace homeward::pipeline {
namespace {

using map::Place;
using map::TopologicalMap;

constexpr std::uint64_t kSeed = 1;
constexpr double kReplayedShare = 0.7;  // of the time, for the progress bar
constexpr double kLookedAtShare = 0.6;
// Pictures of one spot share 14 % of their features and more, 4 m apart 8 % (docs/experiments/hand_held_tours.md).
constexpr float kLeastMatchShare = 0.06F;
constexpr double kOnePlace_m = 5.0;  // pictures of one place are nearer, with what odometry drifts between two passes
constexpr double kSeenWay_m = 3.0;   // prototypes so near may see little of each other and be joined all the same
constexpr double kLongestWay_m = 8.0;
constexpr double kWorseShare = 0.25;  // of a place's pictures that must fare worse to be told
constexpr int kWorseLeast = 2;

/// What one map makes of the pictures.
struct Replayed {
  std::vector<PlaceId> believed;  // empty: lost
  std::vector<char> right;
};

class Places {
 public:
  explicit Places(const TopologicalMap& map) {
    for (const Place& place : map.places) {
      for (const ImageId& image : place.members) of_image_.emplace(image, place.id);
    }
    for (const map::Edge& edge : map.edges) beside_.emplace(edge.from, edge.to);
  }
  /// Empty: no place holds it.
  [[nodiscard]] PlaceId of(const ImageId& image) const {
    const auto found = of_image_.find(image);
    return found == of_image_.end() ? PlaceId() : found->second;
  }
  [[nodiscard]] bool at_or_beside(const PlaceId& believed, const PlaceId& truth) const {
    return believed == truth || beside_.contains({believed, truth}) || beside_.contains({truth, believed});
  }

 private:
  std::unordered_map<ImageId, PlaceId> of_image_;
  std::set<std::pair<PlaceId, PlaceId>> beside_;
};

/// A picture that no place holds any more counts for the next one of its tour that one does.
std::vector<PlaceId> truths(const Places& places, const std::vector<KeptPicture>& pictures) {
  std::vector<PlaceId> truth;
  truth.reserve(pictures.size());
  for (const KeptPicture& picture : pictures) truth.push_back(places.of(picture.image));
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    if (!truth[i].empty()) continue;
    for (std::size_t away = 1; away < pictures.size() && truth[i].empty(); ++away) {
      for (const std::size_t near : {i - away, i + away}) {
        const bool same_tour = near < pictures.size() && pictures[near].tour == pictures[i].tour;
        if (same_tour && truth[i].empty()) truth[i] = places.of(pictures[near].image);
      }
    }
  }
  return truth;
}

/// A picture is right at or beside its place, or beside where it was before: that a way was taken away moves nothing.
std::optional<Replayed> replay(const TopologicalMap& map, const Places& places, const Places& before,
                               const std::vector<KeptPicture>& pictures, const std::function<void()>& done,
                               const std::stop_token& stop) {
  // The map outlives the localiser.
  localisation::Localiser localiser(std::shared_ptr<const TopologicalMap>(std::shared_ptr<void>(), &map), {});
  const std::vector<PlaceId> truth = truths(places, pictures);
  const std::vector<PlaceId> was = truths(before, pictures);
  Replayed replayed;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    if (stop.stop_requested()) return std::nullopt;
    if (i > 0 && pictures[i].tour != pictures[i - 1].tour) localiser.restart();
    const localisation::Belief belief = localiser.update(pictures[i].seen);
    const bool sure = !belief.lost && !belief.top.empty();
    const PlaceId believed = sure ? belief.top.front().place : PlaceId();
    const bool right = sure && (places.at_or_beside(believed, truth[i]) || before.at_or_beside(believed, was[i]));
    replayed.believed.push_back(believed);
    replayed.right.push_back(right ? 1 : 0);
    done();
  }
  return replayed;
}

/// The places of which some pictures were recognised and are no more, by the place that holds them before.
/// `by_drive`: of what drives saw, else of tours.
void compare_beliefs(const Places& before, const std::vector<KeptPicture>& pictures, const Replayed& old,
                     const Replayed& now, bool by_drive, ReplayCheck& check) {
  std::map<PlaceId, WorseSpot> spots;
  std::map<PlaceId, std::map<PlaceId, int>> taken_for;
  const std::vector<PlaceId> taken_at = truths(before, pictures);
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const PlaceId& place = taken_at[i];
    if (place.empty() || pictures[i].by_drive != by_drive) continue;
    WorseSpot& spot = spots[place];
    spot.kind = by_drive ? Worsening::kDrives : Worsening::kLocalisation;
    spot.place = place;
    ++spot.of;
    if (!old.right[i] || now.right[i]) continue;
    ++spot.times;
    if (!by_drive || spot.images.empty()) spot.images.push_back(pictures[i].image);
    if (!now.believed[i].empty()) ++taken_for[place][now.believed[i]];
  }
  for (auto& [place, spot] : spots) {
    if (spot.times < kWorseLeast || spot.times < kWorseShare * spot.of) continue;
    int most = 0;
    for (const auto& [other, times] : taken_for[place]) {
      if (times <= most) continue;
      most = times;
      spot.other = other;
    }
    check.worse.push_back(std::move(spot));
  }
}

std::vector<mapping::TourSweep> sweeps_of(const std::vector<KeptPicture>& pictures) {
  std::vector<mapping::TourSweep> sweeps;
  for (const KeptPicture& picture : pictures) {
    if (picture.sweep) sweeps.push_back({picture.image, *picture.sweep});
  }
  return sweeps;
}

double median(std::vector<double> values) {
  std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2));
  return values[values.size() / 2];
}

/// Whether what came to places from others belongs there.
class GainedPictures {
 public:
  GainedPictures(const TopologicalMap& before, const std::vector<KeptPicture>& pictures, const Whereabouts& whereabouts)
      : before_(before), whereabouts_(whereabouts) {
    for (const KeptPicture& picture : pictures) {
      if (!picture.by_drive) seen_.emplace(picture.image, &picture.seen);
    }
  }

  /// False once `stop` is asked for.
  bool check(const map::MapDifference& difference, ReplayCheck& check, const std::stop_token& stop) const {
    for (const map::PlaceDifference& one : difference.places) {
      if (stop.stop_requested()) return false;
      if (!one.before || !one.after || one.gained.empty()) continue;
      check_looks(one, check);
      check_spots(one, check);
    }
    return true;
  }

 private:
  void check_looks(const map::PlaceDifference& one, ReplayCheck& check) const {
    const Place& place = *map::find_place(before_, one.id);
    WorseSpot unlike{Worsening::kPictures, one.id, {}, {}, 0, 0, 0.0};
    for (const ImageId& image : one.gained) {
      if (!seen_.contains(image)) continue;
      ++unlike.of;
      if (!shows(place, image)) unlike.images.push_back(image);
    }
    if (2 * unlike.images.size() > static_cast<std::size_t>(unlike.of)) check.worse.push_back(unlike);
  }

  void check_spots(const map::PlaceDifference& one, ReplayCheck& check) const {
    const Place& place = *map::find_place(before_, one.id);
    WorseSpot far{Worsening::kPlaces, one.id, {}, one.gained, static_cast<int>(one.gained.size()), 0, 0.0};
    std::vector<double> apart_m;
    std::size_t parted = 0;
    for (const ImageId& image : one.gained) {
      if (const auto distance_m = whereabouts_.apart_m(image, place.prototype)) apart_m.push_back(*distance_m);
      const auto from = [&](const ImageId& member) { return whereabouts_.parted(image, member); };
      if (std::ranges::all_of(place.members, from)) ++parted;
    }
    if (apart_m.empty()) return;
    far.distance_m = median(std::move(apart_m));
    if (far.distance_m > kOnePlace_m || 2 * parted > one.gained.size()) check.worse.push_back(std::move(far));
  }

  /// Against all that the place was known by, and its own pictures of the tour.
  [[nodiscard]] bool shows(const Place& place, const ImageId& image) const {
    const auto known = [&](const map::AppearanceList::Entry& entry) {
      return shows(entry.image, *entry.appearance, image);
    };
    if (std::ranges::any_of(place.appearances.entries(), known)) return true;
    return std::ranges::any_of(place.members, [&](const ImageId& member) {
      const auto found = seen_.find(member);
      return found != seen_.end() && shows(member, *found->second, image);
    });
  }

  [[nodiscard]] bool shows(const ImageId& known, const features::Appearance& looks, const ImageId& image) const {
    const features::Appearance& looked = *seen_.at(image);
    const auto ahead = mapping::relate(looks, looked, {}, kSeed);
    if (ahead.match_share >= kLeastMatchShare) {
      return whereabouts_.may_be(known, image, static_cast<double>(ahead.direction_rad),
                                 static_cast<double>(ahead.turn_rad));
    }
    const auto back = mapping::relate(looked, looks, {}, kSeed + 1);
    return back.match_share >= kLeastMatchShare &&
           whereabouts_.may_be(image, known, static_cast<double>(back.direction_rad),
                               static_cast<double>(back.turn_rad));
  }

  const TopologicalMap& before_;
  const Whereabouts& whereabouts_;
  std::unordered_map<ImageId, const features::Appearance*> seen_;
};

/// What is wrong with a new way, and how long it is; nothing where it can be there.
std::optional<std::pair<Worsening, double>> fault_of(const map::Edge& way, const ImageId& from, const ImageId& to,
                                                     const Whereabouts& whereabouts) {
  const auto apart_m = whereabouts.apart_m(from, to);
  const double distance_m = apart_m.value_or(0.0);
  if (whereabouts.parted(from, to)) return std::pair(Worsening::kWay, distance_m);
  const bool seen =
      !way.weak && way.bearing_rad && way.turn_rad && whereabouts.may_be(from, to, *way.bearing_rad, *way.turn_rad);
  const bool near = apart_m && distance_m <= kSeenWay_m && way.weak;
  if (!seen && !near && !whereabouts.free_between(from, to)) return std::pair(Worsening::kWay, distance_m);
  if (distance_m > kLongestWay_m) return std::pair(Worsening::kFarWay, distance_m);
  return std::nullopt;
}

/// Whether new ways can be there. Between places that merged or parted the pictures were there before.
void check_ways(const TopologicalMap& after, const map::MapDifference& difference, const Whereabouts& whereabouts,
                ReplayCheck& check) {
  std::set<std::pair<PlaceId, PlaceId>> told;
  for (const map::EdgeDifference& one : difference.edges) {
    if (one.before || one.after->by != map::Decider::kPerson || one.after->shortcut) continue;
    if (!told.insert(std::minmax(one.from, one.to)).second) continue;
    const ImageId& from = map::find_place(after, one.from)->prototype;
    const ImageId& to = map::find_place(after, one.to)->prototype;
    if (const auto fault = fault_of(*one.after, from, to, whereabouts)) {
      check.worse.push_back({fault->first, one.from, one.to, {from, to}, 2, 0, fault->second});
    }
  }
}

/// Destinations whose place goes. One that a person takes off its place is none.
void check_destinations(const TopologicalMap& before, const Places& old, const Places& after, ReplayCheck& check) {
  for (const map::Destination& one : before.destinations) {
    if (old.of(one.image).empty() || !after.of(one.image).empty()) continue;
    check.worse.push_back({Worsening::kDestination, one.place, {}, {one.image}, 1, 1, 0.0});
  }
}

/// Sights at places that the map has, after `pictures`.
void add_drives(const TopologicalMap& map, const std::vector<std::vector<DriveSight>>& drives,
                std::vector<KeptPicture>& pictures) {
  int number = pictures.empty() ? 0 : pictures.back().tour;
  for (const std::vector<DriveSight>& drive : drives) {
    ++number;
    for (const DriveSight& sight : drive) {
      const Place* place = sight.place.empty() ? nullptr : map::find_place(map, sight.place);
      if (place != nullptr) pictures.push_back({place->prototype, number, sight.seen, std::nullopt, true});
    }
  }
}

}  // namespace

Result<ReplayCheck> check_by_replay(const TopologicalMap& before, const TopologicalMap& after,
                                    const std::vector<KeptPicture>& pictures, int threads,
                                    const std::function<void(double)>& progress, const std::stop_token& stop) {
  const Places old_places(before);
  const Places new_places(after);
  std::optional<Replayed> old;
  std::optional<Replayed> now;
  std::atomic<int> looked = 0;
  const auto done = [&] { ++looked; };
  const auto tell = [&](double) {
    if (progress)
      progress(kReplayedShare * looked / (2.0 * static_cast<double>(std::max<std::size_t>(1, pictures.size()))));
  };
  // Each replay goes picture by picture; the two go side by side.
  const auto one = [&](std::size_t which) {
    which == 0 ? old = replay(before, old_places, old_places, pictures, done, stop)
               : now = replay(after, new_places, old_places, pictures, done, stop);
  };
  if (!mapping::parallel_for(2, threads, one, tell, stop) || !old || !now) {
    return fail(ErrorCode::kCancelled, "The check was cancelled.");
  }
  ReplayCheck check;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    if (pictures[i].by_drive) {
      ++check.sights;
      continue;
    }
    ++check.pictures;
    check.right_before += old->right[i];
    check.right_after += now->right[i];
    check.lost_before += old->believed[i].empty() ? 1 : 0;
    check.lost_after += now->believed[i].empty() ? 1 : 0;
  }
  for (const bool by_drive : {false, true}) compare_beliefs(old_places, pictures, *old, *now, by_drive, check);
  const map::MapDifference difference = map::difference(before, after);
  const Whereabouts whereabouts(before, sweeps_of(pictures));
  if (!GainedPictures(before, pictures, whereabouts).check(difference, check, stop)) {
    return fail(ErrorCode::kCancelled, "The check was cancelled.");
  }
  check_ways(after, difference, whereabouts, check);
  check_routes(before, after, check);
  check_destinations(before, old_places, new_places, check);
  for (WorseSpot& spot : check.worse) {
    if (spot.times == 0) spot.times = static_cast<int>(spot.images.size());
  }
  std::ranges::stable_sort(check.worse, {}, &WorseSpot::kind);
  if (progress) progress(1.0);
  return check;
}

Result<ReplayCheck> check_by_replay(const TopologicalMap& before, const TopologicalMap& after,
                                    const std::vector<const TourSource*>& tours,
                                    const std::vector<std::vector<DriveSight>>& drives, int threads,
                                    const ProgressSink& progress, const std::stop_token& stop) {
  const auto eye = eye_for(before, std::nullopt);
  if (!eye) return pass_on(eye);
  const auto stage = [&](const char* name, double begin, double share) {
    return [&progress, name, begin, share](double done) {
      if (progress) progress({name, begin + share * done});
    };
  };
  auto seen = look_at_tours(tours, *eye, threads, stage("features", 0.0, kLookedAtShare), stop);
  if (!seen) return pass_on(seen);
  std::unordered_map<ImageId, RangeSweep> sweeps;
  for (const TourSource* tour : tours) {
    for (const TourImage& image : tour->images()) {
      if (image.sweep) sweeps.emplace(image.id, *image.sweep);
    }
  }
  std::vector<KeptPicture> pictures;
  for (std::size_t i = 0; i < seen->tours.images.size(); ++i) {
    const ImageId& id = seen->tours.images[i].id;
    const auto sweep = sweeps.find(id);
    pictures.push_back({id, seen->tours.tour_of[i], std::move(seen->tours.appearances[i]),
                        sweep == sweeps.end() ? std::nullopt : std::optional(sweep->second)});
  }
  add_drives(before, drives, pictures);
  return check_by_replay(before, after, pictures, threads, stage("localise", kLookedAtShare, 1.0 - kLookedAtShare),
                         stop);
}

}  // namespace homeward::pipeline
