// SPDX-License-Identifier: Apache-2.0
#include "map/layout.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>

#include "map/graph.hpp"
#include "map/lookup.hpp"

namespace homeward::map {
namespace {

constexpr int kSweeps = 300;                 // of relaxation; a few hundred places settle in fewer
constexpr double kUnknownWeight = 0.02;      // of an edge that only says how long it is
constexpr double kOdometryReachImages = 60;  // tour images over which odometry still tells directions
constexpr double kSpread = 0.6;              // metres that any two neighbours are drawn apart at least

/// What an edge says: pose of its end in the frame of its start.
struct Constraint {
  int from = 0;
  int to = 0;
  std::optional<Pose2> from_to;  // nothing: only the length is known
  double length_m = 1.0;
};

struct Drawing {
  std::vector<double> headings_rad;
  std::vector<Eigen::Vector2d> positions_m;
};

std::optional<Pose2> pose_by_odometry(const TopologicalMap& map, const std::unordered_map<ImageId, int>& images,
                                      const Place& from, const Place& to) {
  const auto a = images.find(from.prototype);
  const auto b = images.find(to.prototype);
  if (a == images.end() || b == images.end()) return std::nullopt;
  if (std::abs(a->second - b->second) > kOdometryReachImages) return std::nullopt;
  if (tour_name(from.prototype) != tour_name(to.prototype)) return std::nullopt;
  const auto& at_a = map.images[static_cast<std::size_t>(a->second)].odometry;
  const auto& at_b = map.images[static_cast<std::size_t>(b->second)].odometry;
  if (!at_a || !at_b) return std::nullopt;
  return inverse(*at_a) * *at_b;
}

std::vector<Constraint> constraints_of(const TopologicalMap& map) {
  const auto places = place_indices(map);
  const auto images = image_indices(map);
  std::vector<Constraint> constraints;
  for (const Edge& edge : map.edges) {
    const auto ends = ends_of(edge, places);
    if (!ends || ends->from == ends->to) continue;
    Constraint constraint{ends->from, ends->to, std::nullopt, std::clamp(edge.length_m, 0.05, 1e3)};
    constraint.from_to = pose_by_odometry(map, images, map.places[static_cast<std::size_t>(ends->from)],
                                          map.places[static_cast<std::size_t>(ends->to)]);
    if (!constraint.from_to && edge.bearing_rad && edge.turn_rad && !edge.weak) {
      constraint.from_to = Pose2{constraint.length_m * std::cos(*edge.bearing_rad),
                                 constraint.length_m * std::sin(*edge.bearing_rad), *edge.turn_rad};
    }
    constraints.push_back(constraint);
  }
  return constraints;
}

Eigen::Vector2d turned(const Eigen::Vector2d& v, double angle_rad) {
  const double c = std::cos(angle_rad);
  const double s = std::sin(angle_rad);
  return {c * v.x() - s * v.y(), s * v.x() + c * v.y()};
}

/// A first drawing: breadth first along the edges, those with a known direction before the others.
Drawing place_along_tree(int places, const std::vector<Constraint>& constraints) {
  std::vector<std::vector<int>> at(static_cast<std::size_t>(places));
  for (std::size_t i = 0; i < constraints.size(); ++i) {
    at[static_cast<std::size_t>(constraints[i].from)].push_back(static_cast<int>(i));
  }
  Drawing drawing{std::vector<double>(at.size(), 0.0), std::vector<Eigen::Vector2d>(at.size(), {0.0, 0.0})};
  std::vector<char> placed(at.size(), 0);
  for (std::size_t root = 0; root < at.size(); ++root) {
    if (placed[root]) continue;
    placed[root] = 1;
    std::deque<int> queue{static_cast<int>(root)};
    while (!queue.empty()) {
      const auto here = static_cast<std::size_t>(queue.front());
      queue.pop_front();
      int children = 0;
      for (const bool known : {true, false}) {
        for (const int index : at[here]) {
          const Constraint& constraint = constraints[static_cast<std::size_t>(index)];
          const auto to = static_cast<std::size_t>(constraint.to);
          if (placed[to] || constraint.from_to.has_value() != known) continue;
          // Edges of unknown direction fan out: ahead first, then alternately to both sides.
          const auto step_aside = (children + 1) / 2;
          const double fan_rad = (children % 2 == 0 ? 0.5 : -0.5) * static_cast<double>(step_aside);
          const Pose2 step = constraint.from_to.value_or(
              Pose2{constraint.length_m * std::cos(fan_rad), constraint.length_m * std::sin(fan_rad), fan_rad});
          ++children;
          placed[to] = 1;
          drawing.headings_rad[to] = wrap_angle(drawing.headings_rad[here] + step.theta_rad);
          drawing.positions_m[to] =
              drawing.positions_m[here] + turned({step.x_m, step.y_m}, drawing.headings_rad[here]);
          queue.push_back(constraint.to);
        }
      }
    }
  }
  return drawing;
}

/// Gauss-Seidel sweeps over a linear pose graph: headings first, then positions with these headings.
void relax(const std::vector<Constraint>& constraints, Drawing& drawing) {
  const std::size_t places = drawing.positions_m.size();
  std::vector<std::vector<std::pair<int, bool>>> at(places);  // constraint, whether the place is its start
  for (std::size_t i = 0; i < constraints.size(); ++i) {
    at[static_cast<std::size_t>(constraints[i].from)].emplace_back(static_cast<int>(i), true);
    at[static_cast<std::size_t>(constraints[i].to)].emplace_back(static_cast<int>(i), false);
  }
  const auto other_end = [&](const std::pair<int, bool>& end) {
    const Constraint& constraint = constraints[static_cast<std::size_t>(end.first)];
    return static_cast<std::size_t>(end.second ? constraint.to : constraint.from);
  };
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (std::size_t place = 1; place < places; ++place) {
      Eigen::Vector2d sum = turned({0.1, 0.0}, drawing.headings_rad[place]);
      for (const auto& end : at[place]) {
        const Constraint& constraint = constraints[static_cast<std::size_t>(end.first)];
        if (!constraint.from_to) continue;
        const double turn = end.second ? -constraint.from_to->theta_rad : constraint.from_to->theta_rad;
        sum += turned({1.0, 0.0}, drawing.headings_rad[other_end(end)] + turn);
      }
      drawing.headings_rad[place] = std::atan2(sum.y(), sum.x());
    }
  }
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (std::size_t place = 0; place < places; ++place) {
      Eigen::Vector2d sum = Eigen::Vector2d::Zero();
      double weights = 0.0;
      for (const auto& end : at[place]) {
        const Constraint& constraint = constraints[static_cast<std::size_t>(end.first)];
        const std::size_t other = other_end(end);
        const Eigen::Vector2d& position_of_other = drawing.positions_m[other];
        Eigen::Vector2d wanted;
        double weight = 1.0;
        if (constraint.from_to) {
          const std::size_t start = end.second ? place : other;
          const Eigen::Vector2d step =
              turned({constraint.from_to->x_m, constraint.from_to->y_m}, drawing.headings_rad[start]);
          wanted = end.second ? Eigen::Vector2d(position_of_other - step) : Eigen::Vector2d(position_of_other + step);
        } else {
          const Eigen::Vector2d apart = drawing.positions_m[place] - position_of_other;
          const double length = apart.norm();
          wanted = length > 1e-9 ? Eigen::Vector2d(position_of_other + apart * (constraint.length_m / length))
                                 : Eigen::Vector2d(position_of_other + Eigen::Vector2d(constraint.length_m, 0.0));
          weight = kUnknownWeight;
        }
        sum += weight * wanted;
        weights += weight;
      }
      if (weights > 0.0) drawing.positions_m[place] = sum / weights;
    }
  }
}

/// Pushes places apart that would hide each other.
void separate(std::vector<Eigen::Vector2d>& positions_m, const std::vector<int>& component) {
  for (int sweep = 0; sweep < 20; ++sweep) {
    for (std::size_t i = 0; i < positions_m.size(); ++i) {
      for (std::size_t j = i + 1; j < positions_m.size(); ++j) {
        if (component[i] != component[j]) continue;
        const Eigen::Vector2d apart = positions_m[j] - positions_m[i];
        const double distance = apart.norm();
        if (distance >= kSpread) continue;
        const double angle = static_cast<double>((i * 7 + j * 13) % 64) * kPi / 32.0;
        const Eigen::Vector2d direction =
            distance > 1e-6 ? Eigen::Vector2d(apart / distance) : turned({1.0, 0.0}, angle);
        const Eigen::Vector2d push = direction * (0.25 * (kSpread - distance));
        positions_m[i] -= push;
        positions_m[j] += push;
      }
    }
  }
}

/// Puts components side by side, then everything into [0,1] with y downwards.
void fit(std::vector<Eigen::Vector2d>& positions_m, const std::vector<int>& component) {
  const int count = component.empty() ? 0 : *std::ranges::max_element(component) + 1;
  double next_left = 0.0;
  Eigen::Vector2d size(1e-9, 1e-9);
  for (int number = 0; number < count; ++number) {
    Eigen::Array2d low = Eigen::Array2d::Constant(1e300);
    Eigen::Array2d high = Eigen::Array2d::Constant(-1e300);
    for (std::size_t i = 0; i < positions_m.size(); ++i) {
      if (component[i] != number) continue;
      low = low.min(positions_m[i].array());
      high = high.max(positions_m[i].array());
    }
    for (std::size_t i = 0; i < positions_m.size(); ++i) {
      if (component[i] != number) continue;
      positions_m[i] += Eigen::Vector2d(next_left - low.x(), -low.y());
    }
    next_left += high.x() - low.x() + 1.0;
    size.x() = std::max(size.x(), next_left - 1.0);
    size.y() = std::max(size.y(), high.y() - low.y());
  }
  const double scale = 1.0 / std::max({size.x(), size.y(), 1e-6});
  const Eigen::Vector2d margin = (Eigen::Vector2d(1.0, 1.0) - size * scale) / 2.0;
  for (Eigen::Vector2d& position : positions_m) {
    position = position * scale + margin;
    position = {std::clamp(position.x(), 0.0, 1.0), std::clamp(1.0 - position.y(), 0.0, 1.0)};
  }
}

}  // namespace

std::vector<Eigen::Vector2d> layout(const TopologicalMap& map) {
  const int places = static_cast<int>(map.places.size());
  const std::vector<Constraint> constraints = constraints_of(map);
  Drawing drawing = place_along_tree(places, constraints);
  relax(constraints, drawing);
  const std::vector<int> component = components(PlaceGraph(map));
  separate(drawing.positions_m, component);
  fit(drawing.positions_m, component);
  return drawing.positions_m;
}

bool drawn_alike(const TopologicalMap& a, const TopologicalMap& b) {
  const auto same_place = [](const Place& x, const Place& y) { return x.id == y.id && x.prototype == y.prototype; };
  const auto same_edge = [](const Edge& x, const Edge& y) {
    return x.from == y.from && x.to == y.to && x.length_m == y.length_m && x.bearing_rad == y.bearing_rad &&
           x.turn_rad == y.turn_rad && x.weak == y.weak;
  };
  return std::ranges::equal(a.places, b.places, same_place) && std::ranges::equal(a.edges, b.edges, same_edge) &&
         a.images.size() == b.images.size();
}

}  // namespace homeward::map
