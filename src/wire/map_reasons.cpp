// SPDX-License-Identifier: Apache-2.0
#include "wire/map_reasons.hpp"

#include "map/lookup.hpp"

namespace homeward::wire {
namespace {

/// "p3 (kitchen)", or "p3" where it has no name.
std::string place_with_label(const map::TopologicalMap& map, const PlaceId& id) {
  const map::Place* place = map::find_place(map, id);
  if (place == nullptr || place->label.empty()) return id.str();
  return id.str() + " (" + place->label + ")";
}

ReasonCode code_of(const map::Obstacle& obstacle, const map::TopologicalMap& map) {
  switch (obstacle.kind) {
    case map::ObstacleKind::kBlocked: {
      const map::Edge* back = map::find_edge(map, obstacle.to, obstacle.from);
      const bool open_back = back != nullptr && !back->blocked;
      return open_back ? ReasonCode::kObstacleBlockedOneWay : ReasonCode::kObstacleBlocked;
    }
    case map::ObstacleKind::kOneWay:
      return ReasonCode::kObstacleOneWay;
    case map::ObstacleKind::kClosed:
      return ReasonCode::kObstacleClosed;
    case map::ObstacleKind::kAvoided:
      break;
  }
  return ReasonCode::kObstacleAvoided;
}

Reason reason_of(const map::Obstacle& obstacle, const map::TopologicalMap& map) {
  const std::string to = place_with_label(map, obstacle.to);
  if (obstacle.kind == map::ObstacleKind::kAvoided) return {ReasonCode::kObstacleAvoided, {{"place", to}}};
  return {code_of(obstacle, map), {{"from", place_with_label(map, obstacle.from)}, {"to", to}}};
}

}  // namespace

Reason reason_of(const map::NoRoute& why, const map::TopologicalMap& map) {
  Reason reason{ReasonCode::kPartsNotConnected,
                {{"from", place_with_label(map, why.from)}, {"to", place_with_label(map, why.to)}}};
  if (!why.connected) return reason;
  constexpr std::size_t kMostNamed = 5;
  std::vector<Reason> obstacles;
  for (const map::Obstacle& obstacle : why.obstacles) {
    if (obstacles.size() == kMostNamed) {
      const auto more = static_cast<std::int64_t>(why.obstacles.size() - kMostNamed);
      obstacles.push_back({ReasonCode::kObstaclesMore, {{"obstacles", more}}});
      break;
    }
    obstacles.push_back(reason_of(obstacle, map));
  }
  reason.code = ReasonCode::kNoWay;
  reason.parameters["obstacles"] = std::move(obstacles);
  return reason;
}

Reason reason_of(const map::TourWarning& warning) {
  if (warning.kind == map::TourWarning::Kind::kPictureOlder) return {ReasonCode::kPictureOlder};
  std::vector<Reason> pictures;
  for (const map::TourJump& jump : warning.first)
    pictures.push_back({ReasonCode::kJump, {{"from", jump.from}, {"to", jump.to}}});
  if (warning.jumps > warning.first.size()) pictures.push_back({ReasonCode::kAndMore});
  return {warning.against_times ? ReasonCode::kTourJumpsAgainstTimes : ReasonCode::kTourJumps,
          {{"jumps", static_cast<std::int64_t>(warning.jumps)},
           {"steps", static_cast<std::int64_t>(warning.steps)},
           {"pictures", std::move(pictures)}}};
}

}  // namespace homeward::wire
