// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <map>

#include "core/index.hpp"
#include "core/markup.hpp"
#include "map/layout.hpp"
#include "map/lookup.hpp"
#include "pipeline/report/drawings.hpp"
#include "pipeline/report/html.hpp"

namespace homeward::pipeline {
namespace {

constexpr double kWidth = 1000.0;
constexpr double kMargin = 40.0;
constexpr double kMostHeight = 760.0;
constexpr std::size_t kMostIds = 160;  // beyond, the ids of places would cover each other

/// Places on the drawing: the layout, turned so that its longer side lies across, fills the width.
struct Sheet {
  std::vector<Eigen::Vector2d> points;
  double height = 0.0;
};

Sheet lay_out(const map::TopologicalMap& map) {
  Sheet sheet{map::layout(map), 0.0};
  Eigen::Array2d low = Eigen::Array2d::Constant(1.0);
  Eigen::Array2d high = Eigen::Array2d::Constant(0.0);
  const auto measure = [&] {
    low = Eigen::Array2d::Constant(1.0);
    high = Eigen::Array2d::Constant(0.0);
    for (const Eigen::Vector2d& point : sheet.points) {
      low = low.min(point.array());
      high = high.max(point.array());
    }
  };
  measure();
  if (high.y() - low.y() > high.x() - low.x()) {  // by a quarter: a page is read across
    for (Eigen::Vector2d& point : sheet.points) point = Eigen::Vector2d(1.0 - point.y(), point.x());
    measure();
  }
  const Eigen::Array2d size = (high - low).max(1e-3);
  const double scale = std::min((kWidth - 2.0 * kMargin) / size.x(), (kMostHeight - 2.0 * kMargin) / size.y());
  const double left = (kWidth - scale * size.x()) / 2.0;
  for (Eigen::Vector2d& point : sheet.points) {
    point = Eigen::Vector2d(left + scale * (point.x() - low.x()), kMargin + scale * (point.y() - low.y()));
  }
  sheet.height = scale * size.y() + 2.0 * kMargin;
  return sheet;
}

std::string line(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const map::Edge& edge) {
  const char* kind = edge.blocked ? "edge blocked" : (edge.weak ? "edge weak" : "edge");
  return "<line class=\"" + std::string(kind) + "\" x1=\"" + number(a.x(), 1) + "\" y1=\"" + number(a.y(), 1) +
         "\" x2=\"" + number(b.x(), 1) + "\" y2=\"" + number(b.y(), 1) + "\"/>";
}

std::string words(const Eigen::Vector2d& where, const char* kind, const char* anchor, const std::string& escaped) {
  return "<text class=\"" + std::string(kind) + "\" text-anchor=\"" + anchor + "\" x=\"" + number(where.x(), 1) +
         "\" y=\"" + number(where.y(), 1) + "\">" + escaped + "</text>";
}

}  // namespace

std::string draw_graph(const map::TopologicalMap& map, const ReportFacts& facts) {
  const Sheet sheet = lay_out(map);
  const double radius = std::clamp(62.0 / std::sqrt(static_cast<double>(map.places.size())), 3.0, 9.0);
  std::string svg =
      "<svg class=\"wide\" viewBox=\"0 0 1000 " + number(sheet.height, 0) +
      "\" role=\"img\" aria-label=\"The graph of the map: " + counted(map.places.size(), "place", "places") + " and " +
      counted(at(facts.edges), "way", "ways") + " between them, " + std::to_string(facts.weak_edges) +
      " of them weak\" xmlns=\"http://www.w3.org/2000/svg\">\n";
  const auto indices = map::place_indices(map);
  std::map<std::pair<int, int>, map::Edge> drawn;
  for (const map::Edge& edge : map.edges) {
    const auto ends = map::ends_of(edge, indices);
    if (!ends) continue;
    map::Edge& kept = drawn.try_emplace(std::minmax(ends->from, ends->to), edge).first->second;
    kept.weak = kept.weak || edge.weak;
    kept.blocked = kept.blocked || edge.blocked;
  }
  for (const auto& [ends, edge] : drawn) svg += line(sheet.points[at(ends.first)], sheet.points[at(ends.second)], edge);
  svg += "\n";
  for (std::size_t p = 0; p < map.places.size(); ++p) {
    const int visits = facts.visits_of[p];
    const char* kind = visits >= 3 ? "place often" : (visits == 2 ? "place twice" : "place");
    svg += "<circle class=\"" + std::string(kind) + "\" cx=\"" + number(sheet.points[p].x(), 1) + "\" cy=\"" +
           number(sheet.points[p].y(), 1) + "\" r=\"" + number(radius, 1) + "\"><title>" + place_name(map.places[p]) +
           ", " + counted(map.places[p].members.size(), "picture", "pictures") + ", " +
           counted(at(visits), "visit", "visits") + "</title></circle>";
  }
  svg += "\n";
  for (std::size_t p = 0; p < map.places.size(); ++p) {
    const map::Place& place = map.places[p];
    const Eigen::Vector2d above = sheet.points[p] - Eigen::Vector2d(0.0, radius + 4.0);
    if (!place.label.empty()) {
      // Names near the sides are kept on the sheet.
      const char* anchor = above.x() < 90.0 ? "start" : (above.x() > kWidth - 90.0 ? "end" : "middle");
      svg += words(above, "name", anchor, escape_html(place.label));
    } else if (map.places.size() <= kMostIds) {
      svg += words(above, "id", "middle", escape_html(place.id.str()));
    }
  }
  return svg + "</svg>\n";
}

}  // namespace homeward::pipeline
