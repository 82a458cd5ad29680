// SPDX-License-Identifier: Apache-2.0
#include "mapping/doubt_scene.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>

#include "core/index.hpp"
#include "map/lookup.hpp"

namespace homeward::mapping {
namespace {

constexpr double kMetresPerPicture = 0.4;  // where a tour counts but pictures

double metres(const map::Edge& edge) {
  return edge.length_from == map::LengthSource::kTourImages ? edge.length_m * kMetresPerPicture : edge.length_m;
}

}  // namespace

DoubtScene::DoubtScene(const map::TopologicalMap& map)
    : map_(map),
      number_(map::image_indices(map)),
      place_of_(map.images.size(), -1),
      visits_(map.places.size()),
      beside_(map.places.size()),
      within_(map.places.size()) {
  for (std::size_t p = 0; p < map.places.size(); ++p) {
    for (const ImageId& member : map.places[p].members) {
      const int image = number_of(member);
      if (image >= 0) place_of_[at(image)] = static_cast<int>(p);
    }
  }
  find_visits();
  find_ways();
  find_hypotheses();
  read_edits();
  layout_ = map::metric_layout(map);
}

int DoubtScene::number_of(const ImageId& image) const {
  const auto found = number_.find(image);
  return found == number_.end() ? -1 : found->second;
}

int DoubtScene::place_of(const ImageId& image) const {
  const int number = number_of(image);
  return number < 0 ? -1 : place_of_[at(number)];
}

const WayFacts* DoubtScene::way(int a, int b) const {
  const auto found = ways_.find(std::minmax(a, b));
  return found == ways_.end() ? nullptr : &found->second;
}

void DoubtScene::find_visits() {
  const int count = static_cast<int>(map_.images.size());
  const auto tour = [&](int image) { return map::tour_name(map_.images[at(image)].id); };
  for (int i = 0; i < count;) {
    int last = i;
    while (last + 1 < count && place_of_[at(last + 1)] == place_of_[at(i)] && tour(last + 1) == tour(i)) ++last;
    PlaceVisit visit{i, last, -1, -1};
    if (i > 0 && tour(i - 1) == tour(i)) visit.before = place_of_[at(i - 1)];
    if (last + 1 < count && tour(last + 1) == tour(i)) visit.after = place_of_[at(last + 1)];
    if (place_of_[at(i)] >= 0) visits_[at(place_of_[at(i)])].push_back(visit);
    i = last + 1;
  }
}

void DoubtScene::find_ways() {
  const auto places = map::place_indices(map_);
  for (std::size_t e = 0; e < map_.edges.size(); ++e) {
    const map::Edge& edge = map_.edges[e];
    const auto ends = map::ends_of(edge, places);
    if (!ends || ends->from == ends->to) continue;
    const auto [found, is_new] = ways_.try_emplace(std::minmax(ends->from, ends->to));
    WayFacts& way = found->second;
    way.edges.push_back(static_cast<int>(e));
    way.length_m = is_new ? metres(edge) : std::min(way.length_m, metres(edge));
    way.confidence = std::max(way.confidence, edge.confidence);
    way.inliers = std::max(way.inliers, edge.inliers);
    if (!is_new) continue;
    beside_[at(ends->from)].push_back(ends->to);
    beside_[at(ends->to)].push_back(ends->from);
  }
  for (int p = 0; p < static_cast<int>(visits_.size()); ++p) {
    for (const PlaceVisit& visit : visits_[at(p)]) {
      const auto found = ways_.find(std::minmax(p, visit.after));
      if (visit.after >= 0 && found != ways_.end()) found->second.driven = true;
    }
  }
}

void DoubtScene::find_hypotheses() {
  for (std::size_t h = 0; h < map_.hypotheses.size(); ++h) {
    const int a = place_of(map_.hypotheses[h].prototype_a);
    if (a >= 0 && a == place_of(map_.hypotheses[h].prototype_b)) within_[at(a)].push_back(h);
  }
}

void DoubtScene::read_edits() {
  for (const map::Edit& edit : map_.edits) {
    if (edit.undone || !edit.lost.empty()) continue;
    const int a = place_of(edit.image_a);
    const int b = place_of(edit.image_b);
    if (edit.kind == map::EditKind::kMerge) joined_.emplace_back(edit.image_a, edit.image_b);
    if (edit.kind == map::EditKind::kSplit) {
      for (const ImageId& image : edit.images) {
        const int left = place_of(image);
        if (a >= 0 && left >= 0 && left != a) parted_.insert(std::minmax(a, left));
      }
    }
    if (edit.kind == map::EditKind::kDecide && edit.text == "accept") joined_.emplace_back(edit.image_a, edit.image_b);
    if (edit.kind == map::EditKind::kDecide && edit.text == "reject" && a >= 0 && b >= 0 && a != b) {
      parted_.insert(std::minmax(a, b));
    }
    const bool of_way = edit.kind == map::EditKind::kBlockEdge || edit.kind == map::EditKind::kAddEdge;
    if (of_way && a >= 0 && b >= 0) said_ways_.insert(std::minmax(a, b));
    if (edit.kind != map::EditKind::kSetAside || a < 0 || b < 0) continue;
    if (const auto kind = map::kDoubtKindNames.find(edit.text)) set_aside_[{*kind, std::minmax(a, b)}] = edit.by;
  }
}

std::string DoubtScene::set_aside_by(map::DoubtKind kind, int a, int b) const {
  const auto found = set_aside_.find({kind, std::minmax(a, b)});
  return found == set_aside_.end() ? std::string() : found->second;
}

bool DoubtScene::joined_by_a_person(const std::vector<ImageId>& pictures) const {
  const auto among = [&](const ImageId& image) { return std::ranges::find(pictures, image) != pictures.end(); };
  return std::ranges::any_of(joined_, [&](const auto& pair) {
    const bool one_place = place_of(pair.first) == place_of(pair.second);
    return one_place && among(pair.first) != among(pair.second);
  });
}

std::optional<double> DoubtScene::apart_m(const ImageId& a, const ImageId& b) const {
  const auto one = layout_.find(a);
  const auto other = layout_.find(b);
  if (one == layout_.end() || other == layout_.end()) return std::nullopt;
  const bool joined = one->second.component == other->second.component && one->second.metric && other->second.metric;
  if (!joined) return std::nullopt;
  return (position_m(one->second.map_from_robot) - position_m(other->second.map_from_robot)).norm();
}

double DoubtScene::way_m(std::span<const int> from, std::span<const int> to, int without,
                         std::optional<PlaceIndices> closed, double most_m) const {
  std::unordered_map<int, double> away;
  using Reached = std::pair<double, int>;
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> open;
  for (const int place : from) {
    away[place] = 0.0;
    open.emplace(0.0, place);
  }
  while (!open.empty()) {
    const auto [length, here] = open.top();
    open.pop();
    if (length > away[here]) continue;
    if (std::ranges::find(to, here) != to.end()) return length;
    for (const int next : beside_[at(here)]) {
      const PlaceIndices ends = std::minmax(here, next);
      if (next == without || (closed && *closed == ends)) continue;
      const double reached = length + ways_.at(ends).length_m;
      const auto known = away.find(next);
      if (reached >= most_m || (known != away.end() && known->second <= reached)) continue;
      away[next] = reached;
      open.emplace(reached, next);
    }
  }
  return most_m;
}

}  // namespace homeward::mapping
