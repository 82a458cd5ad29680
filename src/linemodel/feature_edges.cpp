// SPDX-License-Identifier: Apache-2.0
#include "linemodel/feature_edges.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <numeric>
#include <utility>

#include "linemodel/crossing_edges.hpp"
#include "linemodel/rim_edges.hpp"
#include "linemodel/solids.hpp"
#include "linemodel/welded_mesh.hpp"

namespace homeward::linemodel {
namespace {

constexpr float kPi_f = std::numbers::pi_v<float>;

/// Edges one behind the other on a straight line.
struct Chain {
  Eigen::Vector3f from_m;
  Eigen::Vector3f axis;
  struct Link {
    float from_along_m = 0.0F;
    float to_along_m = 0.0F;
    std::size_t edge = 0;
  };
  std::vector<Link> links;  // in order along the axis

  [[nodiscard]] float length_m() const { return links.back().to_along_m - links.front().from_along_m; }
};

class Chains {
 public:
  Chains(const std::vector<Eigen::Vector3f>& points_m, const std::vector<RimEdge>& edges)
      : points_m_(points_m), edges_(edges), edges_at_(points_m.size()), taken_(edges.size(), false) {
    for (std::size_t i = 0; i < edges.size(); ++i) {
      edges_at_[static_cast<std::size_t>(edges[i].from)].push_back(i);
      edges_at_[static_cast<std::size_t>(edges[i].to)].push_back(i);
    }
  }

  /// The longest edges first: they know best which way a line goes.
  std::vector<Chain> take() {
    std::vector<std::size_t> order(edges_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return length_m(a) > length_m(b); });
    std::vector<Chain> chains;
    for (const std::size_t seed : order) {
      if (taken_[seed]) continue;
      taken_[seed] = true;
      const Eigen::Vector3f from_m = point(edges_[seed].from);
      const Eigen::Vector3f axis = (point(edges_[seed].to) - from_m).normalized();
      Chain chain{from_m, axis, {{0.0F, length_m(seed), seed}}};
      extend(chain, edges_[seed].to, 1.0F);
      extend(chain, edges_[seed].from, -1.0F);
      std::ranges::sort(chain.links, {}, &Chain::Link::from_along_m);
      chains.push_back(std::move(chain));
    }
    return chains;
  }

 private:
  [[nodiscard]] const Eigen::Vector3f& point(int index) const { return points_m_[static_cast<std::size_t>(index)]; }
  [[nodiscard]] float length_m(std::size_t edge) const {
    return (point(edges_[edge].to) - point(edges_[edge].from)).norm();
  }

  void extend(Chain& chain, int end, float sign) {
    constexpr float kOff_m = 0.004F;
    constexpr float kStraight = 0.9994F;  // cosine of 2 degrees
    for (bool longer = true; longer;) {
      longer = false;
      for (const std::size_t edge : edges_at_[static_cast<std::size_t>(end)]) {
        if (taken_[edge]) continue;
        const int next = edges_[edge].from == end ? edges_[edge].to : edges_[edge].from;
        const Eigen::Vector3f step_m = point(next) - point(end);
        const Eigen::Vector3f off_m = point(next) - chain.from_m;
        const float along_m = chain.axis.dot(off_m);
        if (sign * step_m.normalized().dot(chain.axis) < kStraight) continue;
        if ((off_m - along_m * chain.axis).norm() > kOff_m) continue;
        taken_[edge] = true;
        const float before_m = along_m - chain.axis.dot(step_m);
        chain.links.push_back({std::min(before_m, along_m), std::max(before_m, along_m), edge});
        end = next;
        longer = true;
        break;
      }
    }
  }

  const std::vector<Eigen::Vector3f>& points_m_;
  const std::vector<RimEdge>& edges_;
  std::vector<std::vector<std::size_t>> edges_at_;
  std::vector<bool> taken_;
};

/// Whether somebody who looks at an edge sees a surface end or bend there.
class Judge {
 public:
  Judge(const WeldedMesh& mesh, const FeatureEdgesConfig& config)
      : mesh_(mesh), config_(config), skins_(skins_of_solids(mesh)), scene_(scene_of(mesh)) {}

  [[nodiscard]] bool shows(const Eigen::Vector3f& at_m, const Eigen::Vector3f& axis,
                           const std::vector<Eigen::Vector3f>& faces) const {
    const Eigen::Vector3f& x = faces.front();
    const Eigen::Vector3f y = axis.cross(x);
    std::vector<float> angles_rad;
    for (const Eigen::Vector3f& face : faces) {
      const float angle_rad = std::atan2(y.dot(face), x.dot(face));
      angles_rad.push_back(angle_rad < -1e-3F ? angle_rad + 2.0F * kPi_f : angle_rad);
    }
    std::ranges::sort(angles_rad);
    for (std::size_t i = 0; i < angles_rad.size(); ++i) {
      const bool last = i + 1 == angles_rad.size();
      const float begin_rad = angles_rad[i];
      const float width_rad = (last ? angles_rad.front() + 2.0F * kPi_f : angles_rad[i + 1]) - begin_rad;
      // A surface that goes on straight shows nothing on this side.
      if (std::abs(width_rad - kPi_f) < config_.crease_rad) continue;
      if (is_open(at_m, axis, x, y, begin_rad, width_rad)) return true;
    }
    return false;
  }

 private:
  /// Whether the space between two surfaces can be looked into from `open_m` away: in a seventh of the directions.
  [[nodiscard]] bool is_open(const Eigen::Vector3f& at_m, const Eigen::Vector3f& axis, const Eigen::Vector3f& x,
                             const Eigen::Vector3f& y, float begin_rad, float width_rad) const {
    constexpr int kAround = 8;
    constexpr std::array<float, 4> kSlants_rad = {-0.8F, -0.3F, 0.3F, 0.8F};
    constexpr int kNeeded = 5;  // of 32
    constexpr float kOff_m = 0.004F;
    const auto around = [&](float angle_rad) {
      return Eigen::Vector3f(std::cos(angle_rad) * x + std::sin(angle_rad) * y);
    };
    int open = 0;
    for (int i = 0; i < kAround; ++i) {
      const float share = (static_cast<float>(i) + 0.5F) / static_cast<float>(kAround);
      const Eigen::Vector3f out = around(begin_rad + share * width_rad);
      for (const float slant_rad : kSlants_rad) {
        const Eigen::Vector3f direction = std::cos(slant_rad) * out + std::sin(slant_rad) * axis;
        // From this side of what the edge may lie on.
        const Eigen::Vector3f eye_m = at_m + kOff_m * out;
        if (is_free(eye_m, direction) && ++open == kNeeded) return true;
      }
    }
    return false;
  }

  /// Whether one can look that way, and is not inside of a solid.
  [[nodiscard]] bool is_free(const Eigen::Vector3f& eye_m, const Eigen::Vector3f& direction) const {
    constexpr float kLargestSolid_m = 30.0F;
    const auto hit = scene_.first_hit(eye_m, direction, kLargestSolid_m);
    if (!hit) return true;
    if (hit->distance_m < config_.open_m) return false;
    if (!skins_[hit->triangle]) return true;
    const auto& corners = mesh_.triangles[hit->triangle];
    const auto point = [&](std::size_t k) { return mesh_.points_m[static_cast<std::size_t>(corners[k])]; };
    return (point(1) - point(0)).cross(point(2) - point(0)).dot(direction) < 0.0F;
  }

  static raycast::RayScene scene_of(const WeldedMesh& mesh) {
    raycast::Vertices vertices_m(static_cast<Eigen::Index>(mesh.points_m.size()), 3);
    for (std::size_t i = 0; i < mesh.points_m.size(); ++i)
      vertices_m.row(static_cast<Eigen::Index>(i)) = mesh.points_m[i].transpose();
    raycast::Triangles triangles(static_cast<Eigen::Index>(mesh.triangles.size()), 3);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      const auto& [a, b, c] = mesh.triangles[i];
      triangles.row(static_cast<Eigen::Index>(i)) << a, b, c;
    }
    return {vertices_m, triangles};
  }

  const WeldedMesh& mesh_;
  const FeatureEdgesConfig& config_;
  std::vector<bool> skins_;
  raycast::RayScene scene_;
};

/// The stretches of a chain that show, as lines.
void add_lines(std::vector<PlanLine>& lines, const Chain& chain, const std::vector<RimEdge>& edges, const Judge& judge,
               const FeatureEdgesConfig& config) {
  constexpr float kStep_m = 0.2F;
  constexpr float kGap_m = 0.01F;
  float begin_m = 0.0F;
  float end_m = -1e9F;  // no stretch yet
  const auto finish = [&] {
    if (end_m - begin_m >= config.min_length_m)
      lines.push_back({chain.from_m + begin_m * chain.axis, chain.from_m + end_m * chain.axis});
  };
  for (const Chain::Link& link : chain.links) {
    const float length_m = link.to_along_m - link.from_along_m;
    const int steps = std::max(1, static_cast<int>(std::ceil(length_m / kStep_m)));
    for (int step = 0; step < steps; ++step) {
      const float from_m = link.from_along_m + length_m * static_cast<float>(step) / static_cast<float>(steps);
      const float to_m = link.from_along_m + length_m * static_cast<float>(step + 1) / static_cast<float>(steps);
      const Eigen::Vector3f middle_m = chain.from_m + 0.5F * (from_m + to_m) * chain.axis;
      if (!judge.shows(middle_m, chain.axis, edges[link.edge].faces)) continue;
      if (from_m > end_m + kGap_m) {
        finish();
        begin_m = from_m;
      }
      end_m = std::max(end_m, to_m);
    }
  }
  finish();
}

float away_m(const PlanLine& line, const Eigen::Vector3f& point_m) {
  const Eigen::Vector3f way_m = line.to_m - line.from_m;
  const float share = std::clamp((point_m - line.from_m).dot(way_m) / way_m.squaredNorm(), 0.0F, 1.0F);
  return (line.from_m + share * way_m - point_m).norm();
}

/// Leaves out lines that run along a longer one.
std::vector<PlanLine> without_doubles(std::vector<PlanLine> lines, float within_m) {
  std::ranges::stable_sort(lines, [](const PlanLine& a, const PlanLine& b) {
    return (a.to_m - a.from_m).norm() > (b.to_m - b.from_m).norm();
  });
  // Points along the lines that are kept, to find them by.
  constexpr float kCell_m = 0.5F;
  PointGrid grid(kCell_m);
  std::vector<PlanLine> kept;
  for (const PlanLine& line : lines) {
    bool doubled = false;
    grid.visit_near(line.from_m, [&](int index) {
      const PlanLine& other = kept[static_cast<std::size_t>(index)];
      doubled = doubled || (away_m(other, line.from_m) < within_m && away_m(other, line.to_m) < within_m);
    });
    if (doubled) continue;
    const Eigen::Vector3f way_m = line.to_m - line.from_m;
    const int steps = std::max(1, static_cast<int>(std::ceil(way_m.norm() / kCell_m)));
    for (int step = 0; step <= steps; ++step) {
      grid.add(line.from_m + way_m * (static_cast<float>(step) / static_cast<float>(steps)),
               static_cast<int>(kept.size()));
    }
    kept.push_back(line);
  }
  return kept;
}

}  // namespace

std::vector<PlanLine> feature_edges(const raycast::Vertices& vertices_m, const raycast::Triangles& triangles,
                                    const FeatureEdgesConfig& config) {
  if (triangles.rows() == 0) return {};
  WeldedMesh mesh = weld(vertices_m, triangles, config.weld_m);
  std::vector<RimEdge> edges = rim_edges(mesh, config.crease_rad);
  std::ranges::move(crossing_edges(mesh, config.crease_rad), std::back_inserter(edges));
  const Judge judge(mesh, config);
  std::vector<PlanLine> lines;
  for (const Chain& chain : Chains(mesh.points_m, edges).take()) {
    if (chain.length_m() >= config.min_length_m) add_lines(lines, chain, edges, judge, config);
  }
  return without_doubles(std::move(lines), config.same_line_m);
}

Plan plan_of_mesh(raycast::Vertices vertices_m, raycast::Triangles triangles, const FeatureEdgesConfig& config) {
  Plan plan;
  plan.lines = feature_edges(vertices_m, triangles, config);
  plan.vertices_m = std::move(vertices_m);
  plan.triangles = std::move(triangles);
  return plan;
}

}  // namespace homeward::linemodel
