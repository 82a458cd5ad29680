// SPDX-License-Identifier: Apache-2.0
// homeward_bench_teach TOUR [N [SIGMA [R [WIDTH [SEED [dense] [free] [cut] [known W]]]]]]: teaches a path from a folder
// of pictures with camera.json and poses.csv (the truth) and says how good its arcs are. N: features below which an arc
// ends; SIGMA: reprojection error above which it does; R: residual of a tracked feature; WIDTH: the pictures shrunk to
// it; dense: with dense_teaching(); free: nothing is known of driving; cut: gaps are not bridged, and the path is not
// closed; known: the weight of what the arc before knows (0: nothing). Lines that begin with `key` say where the key
// images are by their arcs alone, and in truth; the last line is a row of a table of all that.
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <opencv2/core.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "camera/camera.hpp"
#include "core/angles.hpp"
#include "core/index.hpp"
#include "perspective_tour.hpp"
#include "repeat/closing.hpp"
#include "repeat/teach.hpp"

namespace homeward::bench {
namespace {

using repeat::Arc;
using repeat::KeyImage;
using repeat::TaughtPath;

constexpr double kLeastWay_m = 0.02;  // of an arc: a direction that can be right or wrong

const char* name_of(repeat::ArcEnd end) {
  constexpr std::array<const char*, 5> kNames{"features", "error", "common", "geometry", "end"};
  return kNames[static_cast<std::size_t>(end)];
}

const char* name_of(repeat::CutReason why) {
  constexpr std::array<const char*, 3> kNames{"too few features", "no geometry", "error too large"};
  return kNames[static_cast<std::size_t>(why)];
}

/// How an arc is in truth, and how far what was found is from that.
struct TrueArc {
  double way_m = 0.0;
  double turn_rad = 0.0;
  double turn_off_deg = 0.0;
  double direction_off_deg = std::nan("");
};

TrueArc true_arc(const PerspectiveTour& tour, const TaughtPath& path, const Arc& arc) {
  const Pose2& a = tour.poses[at(path.key_images[at(arc.from)].picture)];
  const Pose2& b = tour.poses[at(path.key_images[at(path.to_key(arc))].picture)];
  TrueArc truth;
  const Eigen::Vector3d moved(b.x_m - a.x_m, b.y_m - a.y_m, 0.0);
  truth.way_m = moved.norm();
  truth.turn_rad = wrap_angle(b.theta_rad - a.theta_rad);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(truth.turn_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const Eigen::Matrix3d turn_off = turn.transpose() * arc.motion.current_from_target;
  truth.turn_off_deg = degrees(Eigen::AngleAxisd(turn_off).angle());
  if (!arc.has_baseline || truth.way_m < kLeastWay_m) return truth;
  const Eigen::Vector3d direction = Eigen::AngleAxisd(-a.theta_rad, Eigen::Vector3d::UnitZ()) * moved.normalized();
  truth.direction_off_deg = degrees(
      std::atan2(direction.cross(arc.motion.target_in_current).norm(), direction.dot(arc.motion.target_in_current)));
  return truth;
}

struct Figures {
  std::vector<double> features, errors_px, ways_m, turns_off_deg, directions_off_deg, scales_off;
  int turns = 0;     // arcs without a baseline
  int unscaled = 0;  // nodes inside a piece without a scale

  void print(const char* name, const std::vector<double>& values, const char* format) const {
    std::printf("%s: median ", name);
    std::printf(format, at_share(values, 0.5));
    std::printf(", 90 %% ");
    std::printf(format, at_share(values, 0.9));
    std::printf(", worst ");
    std::printf(format, at_share(values, 1.0));
    std::printf("\n");
  }
};

Figures figures_of(const PerspectiveTour& tour, const TaughtPath& path) {
  Figures figures;
  std::printf(
      "| arc | pictures | ended by | features | common | error px | parallax px | way m | turn deg | turn off deg | "
      "direction off deg | its spread | lead | scale | off |\n");
  double before_m = 0.0;
  for (std::size_t i = 0; i < path.arcs.size(); ++i) {
    const Arc& arc = path.arcs[i];
    const KeyImage& from = path.key_images[at(arc.from)];
    const TrueArc truth = true_arc(tour, path, arc);
    const bool inside = i > 0 && path.to_key(path.arcs[i - 1]) == arc.from;
    double scale_off = std::nan("");
    if (from.scale && before_m > kLeastWay_m && truth.way_m > kLeastWay_m) {
      scale_off = std::abs(std::log(from.scale->ratio * before_m / truth.way_m));
      figures.scales_off.push_back(scale_off);
    } else if (inside) {
      ++figures.unscaled;
    }
    figures.turns += arc.has_baseline ? 0 : 1;
    figures.features.push_back(static_cast<double>(arc.matches.size()));
    figures.errors_px.push_back(arc.error_px);
    figures.ways_m.push_back(truth.way_m);
    figures.turns_off_deg.push_back(truth.turn_off_deg);
    if (!std::isnan(truth.direction_off_deg)) figures.directions_off_deg.push_back(truth.direction_off_deg);
    std::printf(
        "| %zu | %d-%d | %s | %zu | %d | %.2f | %.1f | %.2f | %.0f | %.2f | %.1f | %.1f | %.1f | %.2f | %.3f |\n", i,
        from.picture, path.key_images[at(path.to_key(arc))].picture, name_of(arc.ended_by), arc.matches.size(),
        from.common, arc.error_px, arc.parallax_px, truth.way_m, degrees(truth.turn_rad), truth.turn_off_deg,
        truth.direction_off_deg, degrees(arc.direction_spread_rad), arc.lead, from.scale ? from.scale->ratio : 0.0,
        scale_off);
    before_m = truth.way_m;
  }
  return figures;
}

/// Where the key images are by their arcs alone, one after another from where the path truly begins, and in truth. A
/// unit of length is taken from the truth where a piece begins and where the path says of no scale: `new`.
void print_keys(const PerspectiveTour& tour, const TaughtPath& path) {
  Eigen::Vector3d place_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3d turned = Eigen::Matrix3d::Identity();
  double unit_m = 0.0;
  int next = -1;  // key image that the arc before leads to
  const auto print = [&](int key, const char* unit) {
    const Pose2& truth = tour.poses[at(path.key_images[at(key)].picture)];
    std::printf("key | %d | %d | %.3f | %.3f | %.3f | %.3f | %s |\n", key, path.key_images[at(key)].picture,
                place_m.x(), place_m.y(), truth.x_m, truth.y_m, unit);
  };
  for (const Arc& arc : path.arcs) {
    const KeyImage& from = path.key_images[at(arc.from)];
    const bool begins = next != arc.from;
    if (begins) {
      const Pose2& truth = tour.poses[at(from.picture)];
      place_m = {truth.x_m, truth.y_m, 0.0};
      turned = Eigen::AngleAxisd(truth.theta_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
      print(arc.from, "begin");
    }
    const bool is_scaled = !begins && from.scale.has_value();
    unit_m = is_scaled ? unit_m * from.scale->ratio : true_arc(tour, path, arc).way_m;
    if (arc.has_baseline) place_m += unit_m * (turned * arc.motion.target_in_current);
    turned = turned * arc.motion.current_from_target;
    next = path.to_key(arc);
    print(next, is_scaled ? "kept" : "new");
  }
}

/// How right the arcs are that lead across a gap, and the one that closes the path.
void print_bridges(const PerspectiveTour& tour, const TaughtPath& path) {
  const auto print = [&](const Arc& arc) {
    const TrueArc truth = true_arc(tour, path, arc);
    std::printf("%zu features, way %.2f m, turn %.0f deg, turn off %.2f deg, direction off %.1f deg\n",
                arc.matches.size(), truth.way_m, degrees(truth.turn_rad), truth.turn_off_deg, truth.direction_off_deg);
  };
  for (const repeat::PathBridge& bridge : path.bridges) {
    std::printf("bridged from picture %d to %d: %d matched, ", bridge.last_picture, bridge.next_picture,
                bridge.matched);
    for (const Arc& arc : path.arcs) {
      if (path.key_images[at(arc.from)].picture == bridge.last_picture) print(arc);
    }
  }
  if (!path.closing) return;
  const KeyImage& there = path.key_images[at(path.closing->key_image)];
  std::printf("closed at picture %d (key image %d): common %d before, %d after, ", there.picture,
              path.closing->key_image, path.key_images.back().common, path.closing->common);
  print(path.arcs.back());
}

void print_all(const PerspectiveTour& tour, const TaughtPath& path, const repeat::TeachConfig& config, double ms) {
  const Figures figures = figures_of(tour, path);
  for (const repeat::PathCut& cut : path.cuts) {
    std::printf("cut after picture %d, on from %d: %s\n", cut.last_picture, cut.next_picture.value_or(-1),
                name_of(cut.why));
  }
  for (const int picture : path.skipped_pictures) std::printf("skipped picture %d\n", picture);
  print_bridges(tour, path);
  print_keys(tour, path);
  std::printf("%zu pictures, %zu key images, %zu arcs, %d of them turns, %zu cuts, %d nodes without scale\n",
              tour.grey.size(), path.key_images.size(), path.arcs.size(), figures.turns, path.cuts.size(),
              figures.unscaled);
  const double fewest = -at_share(
      [&] {
        std::vector<double> negative;
        for (const double count : figures.features) negative.push_back(-count);
        return negative;
      }(),
      1.0);
  figures.print("features", figures.features, "%.0f");
  figures.print("error, px", figures.errors_px, "%.2f");
  figures.print("way, m", figures.ways_m, "%.2f");
  figures.print("turn off, deg", figures.turns_off_deg, "%.2f");
  figures.print("direction off, deg", figures.directions_off_deg, "%.1f");
  figures.print("scale off, ln", figures.scales_off, "%.3f");
  const double per_second = 1e3 * static_cast<double>(tour.grey.size()) / ms;
  std::printf(
      "row | %d | %.2f | %.1f | %d | %zu | %d | %zu | %.0f, %.0f | %.2f, %.2f | %.2f | %.2f, %.2f, %.2f | %.1f, "
      "%.1f, %.1f | %.3f, %.3f, %.3f | %d | %.0f |\n",
      config.least_features, config.most_error_px, config.tracker.most_residual, tour.camera.width_px, path.arcs.size(),
      figures.turns, path.cuts.size(), at_share(figures.features, 0.5), fewest, at_share(figures.errors_px, 0.5),
      at_share(figures.errors_px, 1.0), at_share(figures.ways_m, 0.5), at_share(figures.turns_off_deg, 0.5),
      at_share(figures.turns_off_deg, 0.9), at_share(figures.turns_off_deg, 1.0),
      at_share(figures.directions_off_deg, 0.5), at_share(figures.directions_off_deg, 0.9),
      at_share(figures.directions_off_deg, 1.0), at_share(figures.scales_off, 0.5), at_share(figures.scales_off, 0.9),
      at_share(figures.scales_off, 1.0), figures.unscaled, per_second);
}

}  // namespace
}  // namespace homeward::bench

int main(int argc, char** argv) try {
  using namespace homeward;
  if (argc < 2) {
    std::fprintf(stderr,
                 "usage: homeward_bench_teach TOUR [N [SIGMA [R [WIDTH [SEED [dense] [free] [cut] [known W]]]]]]\n");
    return 2;
  }
  cv::setNumThreads(1);
  repeat::TeachConfig config;
  if (argc > 2) config.least_features = std::stoi(argv[2]);
  if (argc > 3) config.most_error_px = std::stod(argv[3]);
  if (argc > 4) config.tracker.most_residual = std::stod(argv[4]);
  const int width_px = argc > 5 ? std::stoi(argv[5]) : 320;
  if (argc > 6) config.seed = std::stoull(argv[6]);
  for (int i = 7; i < argc; ++i) {
    if (std::string(argv[i]) == "free") config.geometry.driving.reset();
    if (std::string(argv[i]) == "cut") config.bridging.reset();
    if (std::string(argv[i]) == "dense") config = repeat::dense_teaching();
    if (std::string(argv[i]) == "known") config.known_weight = std::stod(argv[++i]);
  }
  config.fewest_features = std::min(config.fewest_features, config.least_features);
  const bench::PerspectiveTour tour = bench::read_perspective_tour(argv[1], width_px);
  const std::shared_ptr<const camera::Camera> camera = camera::Camera::create(tour.camera).value();
  auto teacher = repeat::Teacher::create(config, camera).value();
  const double before_ms = bench::cpu_ms();
  for (const Image& grey : tour.grey) (void)teacher.add(tracking::ImagePyramid::build(grey).value()).value();
  auto path = teacher.path().value();
  const auto picture_of = [&](int key) {
    return std::make_shared<const tracking::ImagePyramid>(
        tracking::ImagePyramid::build(tour.grey[at(path.key_images[at(key)].picture)]).value());
  };
  repeat::close_path(path, picture_of, camera, config);
  bench::print_all(tour, path, config, bench::cpu_ms() - before_ms);
  return 0;
} catch (const tl::bad_expected_access<homeward::Error>& stopped) {
  const std::string& where = stopped.error().where;
  std::fprintf(stderr, "%s%s%s\n", where.c_str(), where.empty() ? "" : ": ", stopped.error().message.c_str());
  return 1;
} catch (const std::logic_error&) {  // of std::stoi and its like
  std::fprintf(stderr, "N, SIGMA, R, WIDTH and SEED are numbers. Without further words this tells the usage.\n");
  return 2;
} catch (const std::exception& stopped) {
  std::fprintf(stderr, "%s\n", stopped.what());
  return 1;
}
