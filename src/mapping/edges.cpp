// SPDX-License-Identifier: Apache-2.0
#include "mapping/edges.hpp"

#include <algorithm>
#include <map>
#include <unordered_map>
#include <utility>

#include "mapping/compare_all.hpp"

namespace homeward::mapping {
namespace {

std::size_t at(int index) { return static_cast<std::size_t>(index); }

/// A stretch of a tour inside one place.
struct Run {
  int place = 0;
  int first = 0;  // image indices
  int last = 0;
};

std::vector<Run> runs(const MappingInput& input, std::span<const int> place_of_image) {
  std::vector<Run> result;
  for (int i = 0; i < static_cast<int>(place_of_image.size()); ++i) {
    const bool continues = !result.empty() && result.back().place == place_of_image[at(i)] &&
                           input.tour_of[at(i)] == input.tour_of[at(i - 1)];
    if (continues) {
      result.back().last = i;
    } else {
      result.push_back({place_of_image[at(i)], i, i});
    }
  }
  return result;
}

/// How far two prototypes are apart: by the way reckoned where it can be trusted, else by the middle of the runs.
double edge_length(const TourPath& path, const TourTrack& track, const Run& from, const Run& to, int from_prototype,
                   int to_prototype) {
  const double unit = path.metric() ? 1.0 : path.step();
  const double least = path.metric() ? 0.05 : 0.5;
  const TrackPrediction reckoned = track.predict(from_prototype, to_prototype);
  constexpr double kTrusted = 0.3;  // standard deviation, as a share of the way between them
  const double from_middle = path.length(from.first, from.last) / 2.0 + path.length(from.last, to.first);
  const double by_runs = (from_middle + path.length(to.first, to.last) / 2.0) / unit;
  if (reckoned.known && reckoned.distance_sigma < kTrusted * by_runs) return std::max(reckoned.distance, least);
  return std::max(by_runs, least);
}

map::Edge make_edge(const MappingInput& input, const MappingConfig& config, int from_prototype, int to_prototype) {
  map::Edge edge;
  PairRelation relation = input.pairs->relation(from_prototype, to_prototype);
  // Prototypes of different drives along an edge may never have been compared.
  constexpr std::uint64_t kSeed = 1;
  if (!relation.verified()) {
    relation = relate(input.appearances[at(from_prototype)], input.appearances[at(to_prototype)], {}, kSeed);
  }
  if (relation.verified()) {
    edge.bearing_rad = static_cast<double>(relation.direction_rad);
    edge.turn_rad = static_cast<double>(relation.turn_rad);
    edge.confidence = static_cast<double>(relation.confidence);
  }
  edge.weak = !relation.verified() || edge.confidence < config.weak_below_confidence;
  return edge;
}

}  // namespace

std::vector<map::Edge> form_edges(const MappingInput& input, const TourPath& path, const TourTrack& track,
                                  const MappingConfig& config, std::span<const map::Place> places,
                                  std::span<const int> place_of_image) {
  std::unordered_map<ImageId, int> index;
  for (std::size_t i = 0; i < input.images.size(); ++i) index.emplace(input.images[i].id, static_cast<int>(i));
  const auto prototype = [&](int place) { return index.at(places[at(place)].prototype); };
  std::map<std::pair<int, int>, map::Edge> edges;
  const std::vector<Run> stretches = runs(input, place_of_image);
  for (std::size_t r = 1; r < stretches.size(); ++r) {
    const Run& before = stretches[r - 1];
    const Run& after = stretches[r];
    if (before.place == after.place || input.tour_of[at(before.last)] != input.tour_of[at(after.first)]) continue;
    const double length_m = edge_length(path, track, before, after, prototype(before.place), prototype(after.place));
    for (const auto& [from, to] : {std::pair(before.place, after.place), std::pair(after.place, before.place)}) {
      const auto [known, is_new] = edges.try_emplace({from, to});
      map::Edge& edge = known->second;
      if (is_new) {
        edge = make_edge(input, config, prototype(from), prototype(to));
        edge.from = places[at(from)].id;
        edge.to = places[at(to)].id;
        edge.length_m = length_m;
      }
      edge.length_m = std::min(edge.length_m, length_m);
    }
  }
  std::vector<map::Edge> result;
  result.reserve(edges.size());
  for (auto& [ends, edge] : edges) result.push_back(std::move(edge));
  return result;
}

}  // namespace homeward::mapping
