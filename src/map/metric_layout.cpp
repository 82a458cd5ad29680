// SPDX-License-Identifier: Apache-2.0
#include "map/metric_layout.hpp"

#include <ceres/ceres.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <set>
#include <vector>

#include "map/lookup.hpp"

namespace homeward::map {
namespace {

constexpr double kMetresPerImage = 0.4;  // where a tour counts but pictures
constexpr double kUnknownLength_m = 1.0;

/// The pose of `b` in the frame of `a`, with standard deviations.
struct Link {
  int a = 0;
  int b = 0;
  Pose2 a_from_b;
  double along_m = 0.1;    // along the line from a to b
  double across_m = 0.1;   // and across it
  double turn_rad = 0.05;  // of the heading; not above kNoTurn where the heading is known
  bool robust = false;     // may be wrong altogether
  bool measured = false;   // by odometry
};
constexpr double kNoTurn = 10.0;

struct Graph {
  std::vector<ImageId> images;
  std::vector<Link> links;
};

/// What a link says against two poses, in standard deviations.
struct LinkCost {
  Link link;
  Eigen::Vector2d along;  // unit, frame of a

  template <typename T>
  bool operator()(const T* a, const T* b, T* residual) const {
    using std::cos;
    using std::sin;
    const T c = cos(a[2]);
    const T s = sin(a[2]);
    const T dx = b[0] - a[0];
    const T dy = b[1] - a[1];
    const T x = c * dx + s * dy - T(link.a_from_b.x_m);
    const T y = -s * dx + c * dy - T(link.a_from_b.y_m);
    residual[0] = (T(along.x()) * x + T(along.y()) * y) / T(link.along_m);
    residual[1] = (T(-along.y()) * x + T(along.x()) * y) / T(link.across_m);
    // The sine keeps whole turns apart from nothing, and near zero it is the angle.
    residual[2] = T(2.0) * sin((b[2] - a[2] - T(link.a_from_b.theta_rad)) / T(2.0)) / T(link.turn_rad);
    return true;
  }
};

class Numbers {
 public:
  int of(const ImageId& image) {
    const auto [at, is_new] = numbers_.try_emplace(image, static_cast<int>(images_.size()));
    if (is_new) images_.push_back(image);
    return at->second;
  }
  [[nodiscard]] std::optional<int> known(const ImageId& image) const {
    const auto at = numbers_.find(image);
    return at == numbers_.end() ? std::nullopt : std::optional(at->second);
  }
  [[nodiscard]] const std::vector<ImageId>& images() const { return images_; }

 private:
  std::unordered_map<ImageId, int> numbers_;
  std::vector<ImageId> images_;
};

Link link_of(int a, int b, const Pose2& a_from_b) {
  Link link;
  link.a = a;
  link.b = b;
  link.a_from_b = a_from_b;
  return link;
}

/// Pictures that follow each other in a tour with odometry.
void add_odometry(const TopologicalMap& map, Numbers& numbers, std::vector<Link>& links) {
  for (std::size_t i = 1; i < map.images.size(); ++i) {
    const MapImage& before = map.images[i - 1];
    const MapImage& after = map.images[i];
    if (!before.odometry || !after.odometry || tour_name(before.id) != tour_name(after.id)) continue;
    Link link = link_of(numbers.of(before.id), numbers.of(after.id), inverse(*before.odometry) * *after.odometry);
    const double length_m = std::hypot(link.a_from_b.x_m, link.a_from_b.y_m);
    link.along_m = 0.01 + 0.03 * length_m;
    link.across_m = 0.01 + 0.03 * length_m;
    link.turn_rad = 0.005 + 0.02 * length_m + 0.02 * std::abs(link.a_from_b.theta_rad);
    link.measured = true;
    links.push_back(link);
  }
}

/// What the prototypes of neighbouring places say of each other.
void add_edges(const TopologicalMap& map, Numbers& numbers, std::vector<Link>& links) {
  const auto places = place_indices(map);
  // Of a way whose direction nobody knows one edge counts: out and back, each taken to lead ahead, would pull each
  // other short.
  std::set<std::pair<PlaceId, PlaceId>> counted;
  for (const Edge& edge : map.edges) {
    if (edge.bearing_rad) counted.insert(std::minmax(edge.from, edge.to));
  }
  for (const Edge& edge : map.edges) {
    if (edge.shortcut) continue;  // what it says, it has from a layout
    if (!edge.bearing_rad && !counted.insert(std::minmax(edge.from, edge.to)).second) continue;
    const auto ends = ends_of(edge, places);
    if (!ends || ends->from == ends->to) continue;
    double length_m = edge.length_m;
    if (edge.length_from == LengthSource::kTourImages) length_m *= kMetresPerImage;
    if (edge.length_from == LengthSource::kUnknown) length_m = kUnknownLength_m;
    const bool metric = edge.length_from == LengthSource::kOdometry;
    const bool seen = edge.bearing_rad && edge.turn_rad && !edge.weak;
    const double bearing_rad = edge.bearing_rad.value_or(0.0);
    Link link =
        link_of(numbers.of(map.places[static_cast<std::size_t>(ends->from)].prototype),
                numbers.of(map.places[static_cast<std::size_t>(ends->to)].prototype),
                {length_m * std::cos(bearing_rad), length_m * std::sin(bearing_rad), edge.turn_rad.value_or(0.0)});
    // The length of an edge is that of the way, along which prototypes lie somewhere in their places.
    link.along_m = metric ? 0.3 * length_m + 0.1 : 0.5 * length_m + 0.2;
    link.across_m = seen ? 0.1 * length_m + 0.05 : length_m + 0.2;
    link.turn_rad = seen ? 0.06 : kNoTurn;
    link.robust = true;
    links.push_back(link);
  }
}

Link near(int prototype, int other) {
  constexpr double kNear_m = 0.5;
  Link link = link_of(prototype, other, {});
  link.along_m = link.across_m = kNear_m;
  link.turn_rad = kNoTurn;
  link.robust = true;
  return link;
}

/// Pictures of one place were taken near to each other; a place without edges lies somewhere, too.
void add_members(const TopologicalMap& map, Numbers& numbers, std::vector<Link>& links) {
  for (const Place& place : map.places) {
    const int prototype = numbers.of(place.prototype);
    for (const ImageId& member : place.members) {
      const auto at = numbers.known(member);
      if (at && *at != prototype) links.push_back(near(prototype, *at));
    }
  }
}

/// A destination's picture without odometry is at least known to be of its place.
void add_destinations(const TopologicalMap& map, Numbers& numbers, std::vector<Link>& links) {
  for (const Destination& destination : map.destinations) {
    const Place* place = find_place(map, destination.place);
    if (place == nullptr || numbers.known(destination.image)) continue;
    const int prototype = numbers.of(place->prototype);
    links.push_back(near(prototype, numbers.of(destination.image)));
  }
}

using Poses = std::vector<std::array<double, 3>>;

/// First poses along the surest links (Prim's tree), and which component each image is of.
std::vector<int> place_along_tree(std::size_t images, const std::vector<Link>& links, Poses& poses) {
  struct Reach {
    double doubt = 0.0;
    std::size_t link = 0;
    bool forward = true;
  };
  const auto surer = [](const Reach& a, const Reach& b) {
    return a.doubt != b.doubt ? a.doubt > b.doubt : a.link > b.link;
  };
  std::vector<std::vector<std::size_t>> at(images);
  for (std::size_t i = 0; i < links.size(); ++i) {
    at[static_cast<std::size_t>(links[i].a)].push_back(i);
    at[static_cast<std::size_t>(links[i].b)].push_back(i);
  }
  std::vector<int> component(images, -1);
  int count = 0;
  for (std::size_t root = 0; root < images; ++root) {
    if (component[root] >= 0) continue;
    std::priority_queue<Reach, std::vector<Reach>, decltype(surer)> open(surer);
    const auto settle = [&](std::size_t image) {
      component[image] = count;
      for (const std::size_t i : at[image]) {
        const Link& link = links[i];
        open.push({link.across_m + link.along_m + link.turn_rad, i, static_cast<std::size_t>(link.a) == image});
      }
    };
    settle(root);
    while (!open.empty()) {
      const Reach reach = open.top();
      open.pop();
      const Link& link = links[reach.link];
      const auto from = static_cast<std::size_t>(reach.forward ? link.a : link.b);
      const auto to = static_cast<std::size_t>(reach.forward ? link.b : link.a);
      if (component[to] >= 0) continue;
      const Pose2 step = reach.forward ? link.a_from_b : inverse(link.a_from_b);
      const Pose2 pose = Pose2{poses[from][0], poses[from][1], poses[from][2]} * step;
      poses[to] = {pose.x_m, pose.y_m, pose.theta_rad};
      settle(to);
    }
    ++count;
  }
  return component;
}

void refine(const std::vector<Link>& links, const std::vector<int>& component, Poses& poses) {
  constexpr int kMostIterations = 60;
  ceres::Problem problem;
  std::vector<char> held(poses.size(), 0);
  for (const Link& link : links) {
    const Eigen::Vector2d way(link.a_from_b.x_m, link.a_from_b.y_m);
    const Eigen::Vector2d along = way.norm() > 1e-6 ? Eigen::Vector2d(way.normalized()) : Eigen::Vector2d(1.0, 0.0);
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<LinkCost, 3, 3, 3>(new LinkCost{link, along}),
                             link.robust ? new ceres::CauchyLoss(1.0) : nullptr,
                             poses[static_cast<std::size_t>(link.a)].data(),
                             poses[static_cast<std::size_t>(link.b)].data());
  }
  for (std::size_t i = 0; i < poses.size(); ++i) {
    auto& first_of = held[static_cast<std::size_t>(component[i])];
    if (first_of != 0) continue;
    first_of = 1;
    if (problem.HasParameterBlock(poses[i].data())) problem.SetParameterBlockConstant(poses[i].data());
  }
  ceres::Solver::Options options;
  options.max_num_iterations = kMostIterations;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
}

}  // namespace

MetricLayout metric_layout(const TopologicalMap& map) {
  Numbers numbers;
  std::vector<Link> links;
  add_odometry(map, numbers, links);
  add_edges(map, numbers, links);
  add_members(map, numbers, links);
  add_destinations(map, numbers, links);
  const std::vector<ImageId>& images = numbers.images();
  Poses poses(images.size(), {0.0, 0.0, 0.0});
  const std::vector<int> component = place_along_tree(images.size(), links, poses);
  if (!links.empty()) refine(links, component, poses);
  std::set<int> measured;
  for (const Link& link : links) {
    if (!link.measured) continue;
    measured.insert(link.a);
    measured.insert(link.b);
  }
  MetricLayout laid_out;
  for (std::size_t i = 0; i < images.size(); ++i) {
    const Pose2 pose{poses[i][0], poses[i][1], wrap_angle(poses[i][2])};
    laid_out.emplace(images[i], LaidOutImage{pose, component[i], measured.contains(static_cast<int>(i))});
  }
  return laid_out;
}

}  // namespace homeward::map
