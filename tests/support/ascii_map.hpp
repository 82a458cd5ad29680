// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cctype>
#include <string>
#include <string_view>
#include <vector>

#include "map/topological_map.hpp"

namespace homeward::testing {

/// A topological map from a drawing. A letter is a place (id and label: the letter; one image "t/<letter>"); runs of
/// one character join the nearest letters to the right or below, as many units long as characters are drawn:
///   - |   an edge both ways          > v   an edge in this direction alone
///   ~ !   a weak edge both ways      # x   a blocked edge both ways
/// For example
///   A-B--C
///     |
///     D
inline map::TopologicalMap ascii_map(std::string_view drawing) {
  std::vector<std::string> rows(1);
  for (const char c : drawing) {
    if (c == '\n') {
      rows.emplace_back();
    } else {
      rows.back().push_back(c);
    }
  }
  const auto at = [&](std::size_t row, std::size_t column) {
    return row < rows.size() && column < rows[row].size() ? rows[row][column] : ' ';
  };
  const auto is_place = [](char c) { return std::isupper(static_cast<unsigned char>(c)) != 0; };

  map::TopologicalMap map;
  map.name = "drawing";
  for (std::size_t row = 0; row < rows.size(); ++row) {
    for (std::size_t column = 0; column < rows[row].size(); ++column) {
      const char c = rows[row][column];
      if (!is_place(c)) continue;
      map::Place place;
      place.id = PlaceId(std::string(1, c));
      place.label = std::string(1, c);
      place.prototype = ImageId("t/" + std::string(1, c));
      place.members = {place.prototype};
      place.appearances.resize(1);
      map.images.push_back({place.prototype, std::nullopt, std::nullopt});
      map.places.push_back(place);
    }
  }
  const auto join = [&](char a, char b, char kind, double length_m) {
    map::Edge edge;
    edge.from = PlaceId(std::string(1, a));
    edge.to = PlaceId(std::string(1, b));
    edge.length_m = length_m;
    edge.weak = kind == '~' || kind == '!';
    edge.blocked = kind == '#' || kind == 'x';
    map.edges.push_back(edge);
    if (kind == '>' || kind == 'v') return;
    std::swap(edge.from, edge.to);
    map.edges.push_back(edge);
  };
  for (std::size_t row = 0; row < rows.size(); ++row) {
    for (std::size_t column = 0; column < rows[row].size(); ++column) {
      const char c = rows[row][column];
      if (!is_place(c)) continue;
      const char right = at(row, column + 1);
      std::size_t run = 0;
      while (right != ' ' && at(row, column + 1 + run) == right) ++run;
      if (std::string_view("->~#").find(right) != std::string_view::npos && is_place(at(row, column + 1 + run))) {
        join(c, at(row, column + 1 + run), right, static_cast<double>(run));
      }
      const char down = at(row + 1, column);
      run = 0;
      while (down != ' ' && at(row + 1 + run, column) == down) ++run;
      if (std::string_view("|v!x").find(down) != std::string_view::npos && is_place(at(row + 1 + run, column))) {
        join(c, at(row + 1 + run, column), down, static_cast<double>(run));
      }
    }
  }
  return map;
}

/// "A B C" for places A, B, C.
inline std::string spelled(const std::vector<PlaceId>& places) {
  std::string text;
  for (const PlaceId& place : places) text += (text.empty() ? "" : " ") + place.str();
  return text;
}

/// The places of a drawing with these letters, in their order.
inline std::vector<PlaceId> places(const std::string& letters) {
  std::vector<PlaceId> ids;
  for (const char letter : letters) ids.emplace_back(std::string(1, letter));
  return ids;
}

}  // namespace homeward::testing
