// SPDX-License-Identifier: Apache-2.0
// homeward_bench_bridge TOUR [WIDTH [PAIRS]]: how gaps are bridged, on a folder of pictures with camera.json and
// poses.csv (the truth). Pictures are left out at every so many places, 1, 3, 5, 8 and 12 in a row, and the pictures
// around are taught; then PAIRS pairs of pictures from anywhere are bridged if they can be, most of which show nothing
// in common: a bridge whose turn or direction is far off is a wrong one.
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "camera/camera.hpp"
#include "core/angles.hpp"
#include "core/index.hpp"
#include "perspective_tour.hpp"
#include "repeat/bridge.hpp"
#include "repeat/teach.hpp"

namespace homeward::bench {
namespace {

struct Off {
  double turn_deg = 0.0;
  double direction_deg = std::nan("");
};

Off off(const geometry::ViewMotion& motion, bool has_baseline, const Pose2& from, const Pose2& to) {
  constexpr double kLeastWay_m = 0.02;
  Off found;
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(to.theta_rad - from.theta_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  found.turn_deg = degrees(Eigen::AngleAxisd(Eigen::Matrix3d(turn.transpose() * motion.current_from_target)).angle());
  const Eigen::Vector3d moved(to.x_m - from.x_m, to.y_m - from.y_m, 0.0);
  if (!has_baseline || moved.norm() < kLeastWay_m) return found;
  const Eigen::Vector3d way = Eigen::AngleAxisd(-from.theta_rad, Eigen::Vector3d::UnitZ()) * moved.normalized();
  found.direction_deg =
      degrees(std::atan2(way.cross(motion.target_in_current).norm(), way.dot(motion.target_in_current)));
  return found;
}

struct Figures {
  int tracked = 0;
  int cut = 0;
  int wrong = 0;  // by 5 degrees of turn and more
  std::vector<double> turns_off_deg, directions_off_deg;

  void add(const Off& one) {
    constexpr double kWrong_deg = 5.0;
    wrong += one.turn_deg > kWrong_deg ? 1 : 0;
    turns_off_deg.push_back(one.turn_deg);
    if (!std::isnan(one.direction_deg)) directions_off_deg.push_back(one.direction_deg);
  }
  void print(int left_out) const {
    std::printf("| %d | %d | %zu | %d | %d | %.2f, %.2f, %.2f | %.1f, %.1f, %.1f |\n", left_out, tracked,
                turns_off_deg.size(), cut, wrong, at_share(turns_off_deg, 0.5), at_share(turns_off_deg, 0.9),
                at_share(turns_off_deg, 1.0), at_share(directions_off_deg, 0.5), at_share(directions_off_deg, 0.9),
                at_share(directions_off_deg, 1.0));
  }
};

struct Bench {
  PerspectiveTour tour;
  std::shared_ptr<const camera::Camera> camera;
  repeat::TeachConfig config;

  [[nodiscard]] tracking::ImagePyramid picture(int number) const {
    return tracking::ImagePyramid::build(tour.grey[at(number)]).value();
  }
  /// Teaches the pictures before a gap and those after it; the arc across it is judged.
  void teach_around(int last, int left_out, Figures& figures) const {
    constexpr int kBefore = 6;
    constexpr int kAfter = 3;
    auto teacher = repeat::Teacher::create(config, camera).value();
    std::vector<int> shown;
    for (int i = last - kBefore; i <= last; ++i) shown.push_back(i);
    for (int i = 1; i <= kAfter; ++i) shown.push_back(last + left_out + i);
    for (const int number : shown) (void)teacher.add(picture(number)).value();
    const auto path = teacher.path();
    if (!path) return;
    if (!path->cuts.empty()) {
      ++figures.cut;
      return;
    }
    if (path->bridges.empty()) {
      ++figures.tracked;
      return;
    }
    for (const repeat::PathBridge& bridge : path->bridges) {
      for (const repeat::Arc& arc : path->arcs) {
        const int from = path->key_images[at(arc.from)].picture;
        if (from != bridge.last_picture) continue;
        const int to = path->key_images[at(path->to_key(arc))].picture;
        const Off found =
            off(arc.motion, arc.has_baseline, tour.poses[at(shown[at(from)])], tour.poses[at(shown[at(to)])]);
        figures.add(found);
        if (found.turn_deg > 3.0 || found.direction_deg > 30.0) {
          std::printf("  after %d, %d left out: turn off %.1f, direction off %.1f, %zu features, %d matched\n", last,
                      left_out, found.turn_deg, found.direction_deg, arc.matches.size(), bridge.matched);
        }
      }
    }
  }
  /// Pairs from anywhere, half of them near each other in the tour, which are bridged if they can be.
  void bridge_anywhere(int pairs) const {
    constexpr int kNear = 50;
    const int count = static_cast<int>(tour.grey.size());
    std::vector<repeat::DescribedPicture> described;
    for (int i = 0; i < count; ++i) described.push_back(describe(picture(i), *camera, config.bridging->matching));
    std::mt19937 random(1);
    std::uniform_int_distribution<int> any(0, count - 1);
    std::array<Figures, 2> figures;  // from anywhere, near each other
    for (int i = 0; i < pairs; ++i) {
      const int a = any(random);
      const bool near = i % 10 == 0;
      const int b = near ? std::clamp(a + any(random) % (2 * kNear + 1) - kNear, 0, count - 1) : any(random);
      if (a == b) continue;
      Figures& of = figures[near ? 1 : 0];
      const bool alike = wide_match(described[at(a)], described[at(b)], *camera, config.bridging->matching,
                                    config.geometry, config.seed + static_cast<std::uint64_t>(b))
                             .has_value();
      const auto bridge = alike ? bridge_from(a, b) : std::nullopt;
      if (bridge) {
        judge(*bridge, a, b, of);
      } else {
        ++of.cut;
      }
    }
    std::printf("pairs from anywhere, then pairs near each other; the same columns\n");
    for (const Figures& of : figures) of.print(of.cut + static_cast<int>(of.turns_off_deg.size()));
  }
  [[nodiscard]] std::optional<repeat::Bridge> bridge_from(int a, int b) const {
    const auto from = repeat::Subrange::begin({a, picture(a)}, {}, 0, camera, config).value();
    return repeat::bridge_to({b, picture(b)}, from, *camera, config);
  }
  void judge(const repeat::Bridge& bridge, int a, int b, Figures& figures) const {
    const geometry::TwoViewEstimate& geometry = *bridge.view.geometry;
    const Off found = off(geometry.motion, geometry.has_baseline, tour.poses[at(a)], tour.poses[at(b)]);
    figures.add(found);
    if (found.turn_deg <= 3.0 && !(found.direction_deg > 20.0)) return;
    std::printf(
        "  from %d to %d: turn off %.1f, direction off %.1f, %d agree of %d tracked of %d, %d of %d matched, lead "
        "%.1f, "
        "spread %.1f deg\n",
        a, b, found.turn_deg, found.direction_deg, bridge.view.agreeing(), bridge.view.tracked, bridge.looked_for,
        bridge.matched, bridge.compared, geometry.lead, degrees(geometry.direction_spread_rad));
  }
};

int run(const std::string& folder, int width_px, int pairs) {
  constexpr int kPlaces = 60;
  Bench bench{read_perspective_tour(folder, width_px), nullptr, repeat::dense_teaching()};
  bench.camera = camera::Camera::create(bench.tour.camera).value();
  std::printf("| left out | tracked | bridged | cut | wrong | turn off, deg | direction off, deg |\n");
  const int count = static_cast<int>(bench.tour.grey.size());
  for (const int left_out : {0, 1, 3, 5, 8, 12}) {
    Figures figures;
    for (int i = 0; i < kPlaces; ++i) bench.teach_around(10 + i * (count - 40) / kPlaces, left_out, figures);
    figures.print(left_out);
  }
  if (pairs > 0) bench.bridge_anywhere(pairs);
  return 0;
}

}  // namespace
}  // namespace homeward::bench

int main(int argc, char** argv) try {
  if (argc < 2) {
    std::fprintf(stderr, "usage: homeward_bench_bridge TOUR [WIDTH [PAIRS]]\n");
    return 2;
  }
  cv::setNumThreads(1);
  return homeward::bench::run(argv[1], argc > 2 ? std::stoi(argv[2]) : 320, argc > 3 ? std::stoi(argv[3]) : 1000);
} catch (const tl::bad_expected_access<homeward::Error>& stopped) {
  std::fprintf(stderr, "%s\n", stopped.error().message.c_str());
  return 1;
} catch (const std::exception& stopped) {
  std::fprintf(stderr, "%s\n", stopped.what());
  return 1;
}
