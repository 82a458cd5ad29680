// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <tuple>
#include <vector>

#include "map/topological_map.hpp"

namespace homeward::testing {

inline bool same_edge(const map::Edge& a, const map::Edge& b) {
  const auto all = [](const map::Edge& e) {
    return std::tie(e.from, e.to, e.bearing_rad, e.turn_rad, e.length_m, e.length_from, e.confidence, e.inliers, e.weak,
                    e.blocked, e.by, e.shortcut);
  };
  return all(a) == all(b);
}

inline bool same_appearance(const features::Appearance& a, const features::Appearance& b) {
  return a.sift.descriptors == b.sift.descriptors && a.sift.bearings == b.sift.bearings &&
         a.sift.document_frequency == b.sift.document_frequency && a.columns.descriptors == b.columns.descriptors;
}

inline bool same_place(const map::Place& a, const map::Place& b) {
  const auto all = [](const map::Place& p) { return std::tie(p.id, p.label, p.prototype, p.members); };
  return all(a) == all(b) && std::equal(a.appearances.begin(), a.appearances.end(), b.appearances.begin(),
                                        b.appearances.end(), same_appearance);
}

inline bool same_hypothesis(const map::Hypothesis& a, const map::Hypothesis& b) {
  const auto all = [](const map::Hypothesis& h) {
    return std::tie(h.prototype_a, h.prototype_b, h.similarity, h.masses_after.is_true, h.support, h.plausibility,
                    h.decision, h.by);
  };
  return all(a) == all(b);
}

inline bool same_destination(const map::Destination& a, const map::Destination& b) {
  const auto all = [](const map::Destination& d) { return std::tie(d.id, d.place, d.image, d.label, d.pictogram); };
  return all(a) == all(b) && same_appearance(a.appearance, b.appearance);
}

inline bool same_shortcut(const map::Shortcut& a, const map::Shortcut& b) {
  const auto all = [](const map::Shortcut& s) {
    return std::tie(s.image_a, s.image_b, s.bearing_rad, s.length_m, s.confidence, s.state, s.by);
  };
  return all(a) == all(b);
}

inline std::string described(const std::vector<map::Place>& places, int at) {
  if (at >= static_cast<int>(places.size())) return "none";
  const map::Place& place = places[static_cast<std::size_t>(at)];
  std::string text = place.id.str() + " '" + place.label + "' by " + place.prototype.str() + " of";
  for (const ImageId& member : place.members) text += " " + member.str();
  return text + " with " + std::to_string(place.appearances.size()) + " appearances";
}

/// Whether two maps are the same in all that edits change, to the last bit; says in what they differ.
inline ::testing::AssertionResult same_state(const map::TopologicalMap& a, const map::TopologicalMap& b) {
  const auto differs = [](const char* in, std::size_t at) {
    return ::testing::AssertionFailure() << in << " differ, at " << at;
  };
  const auto compare = [](const auto& x, const auto& y, const auto& same) {
    const auto [first, second] = std::mismatch(x.begin(), x.end(), y.begin(), y.end(), same);
    return first == x.end() && second == y.end() ? -1 : static_cast<int>(first - x.begin());
  };
  if (const int at = compare(a.places, b.places, same_place); at >= 0) {
    return differs("places", at) << ": " << described(a.places, at) << " and " << described(b.places, at);
  }
  if (const int at = compare(a.edges, b.edges, same_edge); at >= 0) return differs("edges", at);
  if (const int at = compare(a.hypotheses, b.hypotheses, same_hypothesis); at >= 0) return differs("hypotheses", at);
  if (const int at = compare(a.shortcuts, b.shortcuts, same_shortcut); at >= 0) return differs("shortcuts", at);
  if (const int at = compare(a.destinations, b.destinations, same_destination); at >= 0) {
    return differs("destinations", at);
  }
  return ::testing::AssertionSuccess();
}

}  // namespace homeward::testing
