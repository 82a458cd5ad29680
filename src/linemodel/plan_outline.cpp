// SPDX-License-Identifier: Apache-2.0
#include "linemodel/plan_outline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <unordered_set>

namespace homeward::linemodel {
namespace {

constexpr float kAlike_m = 0.01F;  // corners nearer than this are one

using Cells = std::array<std::int64_t, 4>;

struct CellsHash {
  std::size_t operator()(const Cells& cells) const noexcept {
    std::size_t hash = 0;
    for (const std::int64_t cell : cells) hash = hash * 1'000'003 + std::hash<std::int64_t>()(cell);
    return hash;
  }
};

/// Both ends in whole centimetres, the lesser one first.
Cells cells_of(const FlatSegment& segment) {
  const auto cell = [](float value_m) { return static_cast<std::int64_t>(std::llround(value_m / kAlike_m)); };
  const std::array from = {cell(segment.from_m.x()), cell(segment.from_m.y())};
  const std::array to = {cell(segment.to_m.x()), cell(segment.to_m.y())};
  const auto& first = std::min(from, to);
  const auto& last = std::max(from, to);
  return {first[0], first[1], last[0], last[1]};
}

bool within(const PlanLine& line, const HeightRange& heights) {
  const auto [low_m, high_m] = std::minmax(line.from_m.z(), line.to_m.z());
  return high_m >= heights.from_m && low_m <= heights.to_m;
}

/// The longest of them, in their order.
std::vector<FlatSegment> longest(const std::vector<FlatSegment>& segments, std::size_t most) {
  std::vector<std::size_t> order(segments.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto length_m = [&](std::size_t i) { return (segments[i].to_m - segments[i].from_m).squaredNorm(); };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return length_m(a) > length_m(b); });
  order.resize(most);
  std::sort(order.begin(), order.end());
  std::vector<FlatSegment> kept;
  kept.reserve(most);
  for (const std::size_t i : order) kept.push_back(segments[i]);
  return kept;
}

}  // namespace

PlanOutline outline(const std::vector<PlanLine>& lines, const HeightRange& heights, std::size_t most) {
  PlanOutline seen;
  std::unordered_set<Cells, CellsHash> known;
  for (const PlanLine& line : lines) {
    if (!within(line, heights)) continue;
    const FlatSegment segment{line.from_m.head<2>(), line.to_m.head<2>()};
    const Cells cells = cells_of(segment);
    const bool upright = cells[0] == cells[2] && cells[1] == cells[3];
    if (!upright && known.insert(cells).second) seen.segments.push_back(segment);
  }
  seen.total = seen.segments.size();
  if (seen.total > most) seen.segments = longest(seen.segments, most);
  return seen;
}

}  // namespace homeward::linemodel
