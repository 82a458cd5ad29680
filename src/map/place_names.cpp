// SPDX-License-Identifier: Apache-2.0
#include "map/place_names.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <deque>
#include <string_view>
#include <unordered_map>

namespace homeward::map {
namespace {

using Neighbours = std::vector<std::vector<std::size_t>>;

/// Ways in either direction, blocked ones too: a name should not change when a door is closed.
Neighbours neighbours_of(const TopologicalMap& map) {
  std::unordered_map<PlaceId, std::size_t> index;
  for (std::size_t i = 0; i < map.places.size(); ++i) index.emplace(map.places[i].id, i);
  Neighbours neighbours(map.places.size());
  for (const Edge& edge : map.edges) {
    const auto from = index.find(edge.from);
    const auto to = index.find(edge.to);
    if (from == index.end() || to == index.end()) continue;
    neighbours[from->second].push_back(to->second);
    neighbours[to->second].push_back(from->second);
  }
  for (auto& list : neighbours) {
    std::ranges::sort(list);
    list.erase(std::ranges::unique(list).begin(), list.end());
  }
  return neighbours;
}

std::vector<std::string> labels_of(const TopologicalMap& map) {
  std::unordered_map<PlaceId, std::string> of_destination;
  for (const Destination& destination : map.destinations) {
    if (!destination.label.empty()) of_destination.emplace(destination.place, destination.label);
  }
  std::vector<std::string> labels;
  for (const Place& place : map.places) {
    const auto found = of_destination.find(place.id);
    labels.push_back(place.label.empty() && found != of_destination.end() ? found->second : place.label);
  }
  return labels;
}

struct Landmark {
  std::size_t place = 0;
  int hops = 0;
};

/// Of each place without a label the two nearest with one that ways lead to without passing others; of equally near
/// ones the first by its label. Two of one label count as one. Breadth first from all of them at once.
std::vector<std::vector<Landmark>> landmarks_of(const Neighbours& neighbours, const std::vector<std::string>& labels) {
  struct Wave {
    std::size_t at = 0;
    Landmark from;
  };
  std::vector<std::size_t> named;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (!labels[i].empty()) named.push_back(i);
  }
  std::ranges::stable_sort(named, {}, [&](std::size_t place) { return labels[place]; });
  std::deque<Wave> open;
  for (const std::size_t place : named) open.push_back({place, {place, 0}});
  std::vector<std::vector<Landmark>> found(labels.size());
  while (!open.empty()) {
    const Wave wave = open.front();
    open.pop_front();
    for (const std::size_t next : neighbours[wave.at]) {
      std::vector<Landmark>& known = found[next];
      const auto alike = [&](const Landmark& other) { return labels[other.place] == labels[wave.from.place]; };
      if (!labels[next].empty() || known.size() == 2 || std::ranges::any_of(known, alike)) continue;
      known.push_back({wave.from.place, wave.from.hops + 1});
      open.push_back({next, known.back()});
    }
  }
  return found;
}

/// "the hall", but "Anna's room": what begins with a capital is a name of its own.
std::string in_a_sentence(const std::string& label) {
  const bool common = std::islower(static_cast<unsigned char>(label.front())) != 0;
  return common && !label.starts_with("the ") ? "the " + label : label;
}

std::string ordinal(int number) {
  constexpr std::array<std::string_view, 11> kWords = {"",      "first",   "second", "third", "fourth", "fifth",
                                                       "sixth", "seventh", "eighth", "ninth", "tenth"};
  if (number < static_cast<int>(kWords.size())) return std::string(kWords.at(static_cast<std::size_t>(number)));
  const int tens = number % 100;
  const int ones = number % 10;
  const bool teen = tens >= 11 && tens <= 13;
  const char* end = !teen && ones == 1 ? "st" : (!teen && ones == 2 ? "nd" : (!teen && ones == 3 ? "rd" : "th"));
  return std::to_string(number) + end;
}

}  // namespace

std::vector<std::string> place_names(const TopologicalMap& map) {
  const Neighbours neighbours = neighbours_of(map);
  const std::vector<std::string> labels = labels_of(map);
  const std::vector<std::vector<Landmark>> landmarks = landmarks_of(neighbours, labels);
  std::vector<std::string> names = labels;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!names[i].empty()) continue;
    if (landmarks[i].empty()) {
      names[i] = map.places[i].id.str();
      continue;
    }
    const std::string near = in_a_sentence(labels[landmarks[i].front().place]);
    names[i] = ordinal(landmarks[i].front().hops);
    if (landmarks[i].size() == 2) {
      names[i] += " from " + near + " towards " + in_a_sentence(labels[landmarks[i].back().place]);
    } else {
      names[i] += " past " + near;
    }
  }
  std::unordered_map<std::string, int> times;
  for (const std::string& name : names) ++times[name];
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (times[names[i]] > 1) names[i] += " (" + map.places[i].id.str() + ")";
  }
  return names;
}

}  // namespace homeward::map
