// SPDX-License-Identifier: Apache-2.0
#include "mapping/place_sides.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "core/index.hpp"
#include "core/pose2.hpp"
#include "geometry/sweep_alignment.hpp"
#include "mapping/doorways.hpp"
#include "mapping/edges.hpp"

namespace homeward::mapping {
namespace {

constexpr double kNear_m = 4.0;  // hits farther off say nothing about doorways in a place

/// The image of `others` that `image` looks most like; of those that nobody has compared with it, the one nearest on
/// the tours. Precondition: `others` is not empty.
int most_like(const MappingInput& input, int image, std::span<const int> others) {
  return *std::ranges::min_element(others, {}, [&](int other) {
    return std::tuple(input.pairs->distance(image, other), input.tour_of[at(image)] != input.tour_of[at(other)],
                      std::abs(image - other));
  });
}

/// Where the images of a place were taken, one beside the other: each sweep is put onto those before.
class PlacePoses {
 public:
  PlacePoses(const MappingInput& input, std::span<const int> images) : input_(input), poses_(images.size()) {
    std::vector<Waiting> waiting;
    for (std::size_t i = 0; i < images.size(); ++i) {
      surfaces_.push_back(input.sweeps[at(images[i])] != nullptr ? geometry::surface_of(*input.sweeps[at(images[i])])
                                                                 : std::vector<geometry::SurfacePoint>());
      if (!surfaces_.back().empty()) waiting.push_back({i, 0});
    }
    if (waiting.empty()) return;
    const std::size_t first = waiting.front().image;
    put(first, {});
    waiting.erase(waiting.begin());
    for (Waiting& one : waiting) one.known = first;
    const auto distance = [&](const Waiting& one) {
      return input.pairs->distance(images[one.image], images[one.known]);
    };
    // The one first that looks most like one that is there.
    while (!waiting.empty()) {
      const auto next = std::ranges::min_element(waiting, {}, distance);
      const Waiting one = *next;
      waiting.erase(next);
      const auto pose = pose_by(images, one.image, one.known);
      if (!pose) continue;
      put(one.image, *pose);
      for (Waiting& other : waiting) {
        if (input.pairs->distance(images[other.image], images[one.image]) < distance(other)) other.known = one.image;
      }
    }
  }

  [[nodiscard]] const std::optional<Pose2>& pose(std::size_t i) const { return poses_[i]; }

  [[nodiscard]] std::vector<Eigen::Vector2d> hits_m() const {
    std::vector<Eigen::Vector2d> hits_m;
    for (std::size_t i = 0; i < poses_.size(); ++i) {
      if (!poses_[i]) continue;
      for (const geometry::SurfacePoint& point : surfaces_[i]) {
        if (point.at_m.norm() < kNear_m)
          hits_m.push_back(position_m(*poses_[i] * Pose2{point.at_m.x(), point.at_m.y(), 0.0}));
      }
    }
    return hits_m;
  }

 private:
  /// An image that has no pose yet, and the one with a pose that it looks most like.
  struct Waiting {
    std::size_t image = 0;
    std::size_t known = 0;
  };

  void put(std::size_t i, const Pose2& pose) {
    constexpr int kReferences = 12;  // sweeps show a place; more of them only take longer
    poses_[i] = pose;
    if (references_++ < kReferences) reference_.add(surfaces_[i], pose);
  }

  [[nodiscard]] std::optional<Pose2> pose_by(std::span<const int> images, std::size_t i, std::size_t known) const {
    constexpr double kLooksNear_m = 0.15;
    constexpr std::size_t kTried = 3;
    constexpr double kLeastAgreement = 0.6;
    std::vector<std::pair<double, Pose2>> starts;
    for (const Pose2& start : starts_from(images[known], images[i])) {
      const Pose2 pose = *poses_[known] * start;
      starts.emplace_back(geometry::agreement(reference_, surfaces_[i], pose, kLooksNear_m), pose);
    }
    std::ranges::stable_sort(starts, std::greater<>(), [](const auto& start) { return start.first; });
    std::optional<geometry::Alignment> best;
    for (std::size_t s = 0; s < std::min(kTried, starts.size()); ++s) {
      const auto aligned = geometry::align(reference_, surfaces_[i], {starts[s].second, 0.3, 0.1});
      if (aligned && (!best || aligned->agreement > best->agreement)) best = aligned;
    }
    if (!best || best->agreement < kLeastAgreement) return std::nullopt;
    return best->reference_from_robot;
  }

  /// Where the second image may have been taken, seen from the first: by odometry on one way, else by what the
  /// pictures say of turn and direction.
  [[nodiscard]] std::vector<Pose2> starts_from(int first, int second) const {
    constexpr int kFarAlong = 10;  // images; odometry over more is no better than pictures
    const auto& from = input_.images[at(first)].odometry;
    const auto& to = input_.images[at(second)].odometry;
    if (from && to && input_.tour_of[at(first)] == input_.tour_of[at(second)] && std::abs(first - second) <= kFarAlong)
      return {inverse(*from) * *to};
    const PairRelation seen = input_.pairs->relation(first, second);
    if (!seen.verified()) return {};
    constexpr double kStep_m = 0.2;
    constexpr int kSteps = 8;
    std::vector<Pose2> starts;
    for (int ahead = -2; ahead <= kSteps; ++ahead) {
      for (int aside = -2; aside <= 2; ++aside) {
        const Pose2 direction{0.0, 0.0, static_cast<double>(seen.direction_rad)};
        const Pose2 moved = direction * Pose2{ahead * kStep_m, aside * kStep_m, 0.0};
        starts.push_back({moved.x_m, moved.y_m, static_cast<double>(seen.turn_rad)});
      }
    }
    return starts;
  }

  const MappingInput& input_;
  std::vector<std::vector<geometry::SurfacePoint>> surfaces_;
  std::vector<std::optional<Pose2>> poses_;
  geometry::ReferenceSurface reference_;
  int references_ = 0;
};

/// On which side of a doorway's wall: -1, 1, or 0 on the threshold.
int side_of(const Doorway& doorway, const Eigen::Vector2d& at_m) {
  constexpr double kThreshold_m = 0.04;  // walls are found to 0.03 m: docs/experiments/doorways.md
  constexpr double kBeside_m = 0.3;
  const double off_m = doorway.normal.dot(at_m - doorway.middle_m);
  const double along_m =
      std::abs(Eigen::Vector2d(-doorway.normal.y(), doorway.normal.x()).dot(at_m - doorway.middle_m));
  if (std::abs(off_m) < kThreshold_m && along_m <= 0.5 * doorway.width_m + kBeside_m) return 0;
  return off_m > 0.0 ? 1 : -1;
}

}  // namespace

std::vector<std::vector<int>> sides_of_doorways(const MappingInput& input, std::span<const int> images,
                                                const DoorwayConfig& config) {
  const std::vector<std::vector<int>> whole = {{images.begin(), images.end()}};
  if (input.sweeps.empty() || images.size() < 2) return whole;
  const PlacePoses poses(input, images);
  std::vector<Eigen::Vector2d> spots_m;
  for (std::size_t i = 0; i < images.size(); ++i) {
    if (poses.pose(i)) spots_m.push_back(position_m(*poses.pose(i)));
  }
  if (spots_m.size() < 2) return whole;
  const std::vector<Doorway> doorways = doorways_between(poses.hits_m(), spots_m, config);
  if (doorways.empty()) return whole;

  // What distinguishes a group: its sides, and of an image on a threshold itself.
  std::map<std::pair<std::vector<int>, int>, std::vector<int>> groups;
  std::vector<int> placed;
  std::vector<int> without;
  std::map<int, std::pair<std::vector<int>, int>> key_of;
  for (std::size_t i = 0; i < images.size(); ++i) {
    if (!poses.pose(i)) {
      without.push_back(images[i]);
      continue;
    }
    std::pair<std::vector<int>, int> key;
    for (const Doorway& doorway : doorways) key.first.push_back(side_of(doorway, position_m(*poses.pose(i))));
    key.second = std::ranges::count(key.first, 0) > 0 ? images[i] : -1;
    groups[key].push_back(images[i]);
    key_of[images[i]] = key;
    placed.push_back(images[i]);
  }
  for (const int image : without) {
    groups[key_of[most_like(input, image, placed)]].push_back(image);
  }
  std::vector<std::vector<int>> sides;
  for (auto& [key, members] : groups) {
    std::ranges::sort(members);
    sides.push_back(std::move(members));
  }
  std::ranges::sort(sides);
  return sides;
}

void reject_across(std::vector<LoopHypothesis>& hypotheses, std::span<const Subcluster> parts,
                   std::span<const int> place_of_image) {
  for (LoopHypothesis& hypothesis : hypotheses) {
    if (hypothesis.decision != map::Decision::kAccepted || hypothesis.by != map::Decider::kMethod) continue;
    const int a = parts[at(hypothesis.a)].prototype;
    const int b = parts[at(hypothesis.b)].prototype;
    if (place_of_image[at(a)] != place_of_image[at(b)]) hypothesis.decision = map::Decision::kRejected;
  }
}

int split_at_doorways(const MappingInput& input, const DoorwayConfig& config, const ImageLabels& labels,
                      const std::vector<char>& stays, int movable, std::vector<map::Place>& places,
                      std::vector<int>& place_of_image) {
  if (input.sweeps.empty()) return 0;
  const std::vector<int> prototype = prototype_images(input, places);
  std::vector<std::vector<int>> images(places.size());
  for (std::size_t i = 0; i < place_of_image.size(); ++i) images[at(place_of_image[i])].push_back(static_cast<int>(i));
  const std::size_t before = places.size();
  for (std::size_t place = 0; place < before; ++place) {
    if (images[place].size() < 2 || (place < stays.size() && stays[place] != 0)) continue;
    for (std::vector<int>& side : sides_of_doorways(input, images[place], config)) {
      if (std::ranges::binary_search(side, prototype[place])) continue;
      std::erase_if(side, [&](int image) { return image >= movable; });
      if (side.empty()) continue;
      for (const int image : side) place_of_image[at(image)] = static_cast<int>(places.size());
      places.push_back(new_place(input, side, labels, places.size()));
    }
  }
  if (places.size() == before) return 0;
  for (map::Place& place : places) place.members.clear();
  for (std::size_t i = 0; i < input.images.size(); ++i)
    places[at(place_of_image[i])].members.push_back(input.images[i].id);
  return static_cast<int>(places.size() - before);
}

}  // namespace homeward::mapping
