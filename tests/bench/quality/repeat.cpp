// SPDX-License-Identifier: Apache-2.0
// homeward_bench_repeat TEACH REPEAT [--width W] [--n N] [--reach R] [--cover FROM COUNT SHARE] [--begin ARC]
// [--out FILE]: teaches a path from one folder of pictures with camera.json and poses.csv (the truth), repeats it with
// another one, and writes a line of JSON for each picture to FILE. The last line of the output is a row of a table.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <numeric>
#include <opencv2/core.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "camera/camera.hpp"
#include "core/angles.hpp"
#include "core/index.hpp"
#include "perspective_tour.hpp"
#include "repeat/repeater.hpp"
#include "repeat/teach.hpp"

namespace homeward::bench {
namespace {

struct Options {
  std::string teach, repeat, out;
  int width_px = 320;
  int begin = 0;
  int from = 0;
  int cover_from = -1;
  int cover_count = 0;
  double cover_share = 0.0;
  bool verbose = false;
  repeat::TeachConfig teaching;
  repeat::RepeatConfig repeating;
};

Options options_of(int argc, char** argv) {
  Options options;
  options.teach = argv[1];
  options.repeat = argv[2];
  for (int i = 3; i < argc; ++i) {
    const std::string name = argv[i];
    const auto next = [&] { return std::string(i + 1 < argc ? argv[++i] : throw std::invalid_argument(name)); };
    if (name == "--width")
      options.width_px = std::stoi(next());
    else if (name == "--n")
      options.teaching.least_features = std::stoi(next());
    else if (name == "--most")
      options.teaching.most_features = std::stoi(next());
    else if (name == "--share")
      options.teaching.least_share = std::stod(next());
    else if (name == "--strength")
      options.teaching.corners.least_strength = std::stod(next());
    else if (name == "--spacing")
      options.teaching.corners.spacing_px = std::stod(next());
    else if (name == "--sens")
      options.teaching.corners.sensitivity = std::stod(next());
    else if (name == "--texture")
      options.teaching.tracker.least_texture = options.repeating.tracker.least_texture = std::stod(next());
    else if (name == "--R")
      options.teaching.tracker.most_residual = options.repeating.tracker.most_residual = std::stod(next());
    else if (name == "--reach")
      options.repeating.reach = std::stoi(next());
    else if (name == "--begin")
      options.begin = std::stoi(next());
    else if (name == "--from")
      options.from = std::stoi(next());
    else if (name == "--dense") {
      options.teaching = repeat::dense_teaching();
      options.repeating.tracker = options.teaching.tracker;
    } else if (name == "--out")
      options.out = next();
    else if (name == "--verbose")
      options.verbose = true;
    else if (name == "--cover") {
      options.cover_from = std::stoi(next());
      options.cover_count = std::stoi(next());
      options.cover_share = std::stod(next());
    } else
      throw std::invalid_argument(name);
  }
  return options;
}

Eigen::Vector3d in_robot(const Pose2& pose, const Eigen::Vector3d& in_world) {
  return Eigen::AngleAxisd(-pose.theta_rad, Eigen::Vector3d::UnitZ()) *
         (in_world - Eigen::Vector3d(pose.x_m, pose.y_m, 0.0));
}

/// How many pixels what is seen in one picture lies from the epipolar line, or rather its part that is ahead, of where
/// it is in another one, by the true poses.
double epipolar_off_px(const Pose2& here, const geometry::SeenPoint& seen, const Pose2& there,
                       const geometry::SeenPoint& then) {
  const Eigen::Vector3d baseline = in_robot(here, {there.x_m, there.y_m, 0.0});
  const Eigen::Vector3d turned =
      Eigen::AngleAxisd(there.theta_rad - here.theta_rad, Eigen::Vector3d::UnitZ()) * then.bearing;
  double best = 1e9;
  // Over distances from 0.2 m to the sky.
  for (int k = 0; k <= 400; ++k) {
    const double nearness = 5.0 * (k / 400.0) * (k / 400.0);
    best = std::min(best, geometry::offset_px(seen, turned + nearness * baseline).norm());
  }
  return best;
}

struct Figures {
  std::vector<double> ms, off_px;
  int frames = 0, lost = 0, right = 0, enough = 0, predicted = 0, forwards = 0, backwards = 0, doubted = 0,
      wrong_far = 0, seen = 0, false_features = 0;
  double lateral_off = 0.0;
};

/// The picture of the taught drive that a pose is beside, by its heading, too, from the one before on: paths lead
/// through a place more than once.
int beside(const std::vector<Pose2>& taught, const Pose2& here, int before) {
  constexpr int kBack = 12;
  constexpr int kOn = 25;
  constexpr double kMetresARadian = 0.3;
  int best = before;
  double least = 1e9;
  for (int i = std::max(0, before - kBack); i < std::min(static_cast<int>(taught.size()), before + kOn); ++i) {
    const Pose2& there = taught[at(i)];
    const double off = std::hypot(there.x_m - here.x_m, there.y_m - here.y_m) +
                       kMetresARadian * std::abs(wrap_angle(there.theta_rad - here.theta_rad));
    if (off >= least) continue;
    least = off;
    best = i;
  }
  return best;
}

void cover(Image& grey, double share) {
  const int from = static_cast<int>(grey.width_px * (0.5 - 0.5 * share));
  const int to = static_cast<int>(grey.width_px * (0.5 + 0.5 * share));
  for (int v = 0; v < grey.height_px; ++v) {
    for (int u = from; u < to; ++u) *grey.at(u, v) = static_cast<std::uint8_t>(60 + ((u / 8 + v / 8) % 2) * 90);
  }
}

int run(const Options& options) {
  const PerspectiveTour teach = read_perspective_tour(options.teach, options.width_px);
  PerspectiveTour drive = read_perspective_tour(options.repeat, options.width_px);
  const auto camera = camera::Camera::create(teach.camera).value();
  auto teacher = repeat::Teacher::create(options.teaching, camera).value();
  for (const Image& grey : teach.grey) (void)teacher.add(tracking::ImagePyramid::build(grey).value()).value();
  const auto path = std::make_shared<const repeat::TaughtPath>(teacher.path().value());
  std::vector<std::shared_ptr<const tracking::ImagePyramid>> keys;
  for (const auto& key : path->key_images) {
    keys.push_back(std::make_shared<const tracking::ImagePyramid>(
        tracking::ImagePyramid::build(teach.grey[at(key.picture)]).value()));
  }
  auto repeater = repeat::Repeater::create(
                      options.repeating, path, [&](int key) { return keys[at(key)]; }, camera)
                      .value();
  if (const auto begun = options.begin < 0 ? Status{} : repeater.begin(options.begin); !begun)
    throw std::runtime_error(begun.error().message);
  Figures figures;
  int truth = options.from;
  std::ofstream out(options.out);
  for (auto i = static_cast<std::size_t>(options.from); i < drive.grey.size(); ++i) {
    const int number = static_cast<int>(i);
    const bool covered = number >= options.cover_from && number < options.cover_from + options.cover_count;
    if (covered) cover(drive.grey[i], options.cover_share);
    const double before_ms = cpu_ms();
    auto pyramid = std::make_shared<const tracking::ImagePyramid>(tracking::ImagePyramid::build(drive.grey[i]).value());
    const repeat::Repeated said = repeater.step(pyramid).value();
    const double ms = cpu_ms() - before_ms;
    figures.ms.push_back(ms);
    ++figures.frames;
    const int from = path->key_images[at(said.from_key)].picture;
    const int to = path->key_images[at(said.to_key)].picture;
    truth = beside(teach.poses, drive.poses[i], truth);
    int arc_truth = 0;
    for (std::size_t a = 0; a < path->arcs.size(); ++a) {
      if (path->key_images[at(path->arcs[a].from)].picture <= truth) arc_truth = static_cast<int>(a);
    }
    int wrong = 0;
    int seen = 0;
    if (!said.is_lost()) {
      for (const auto& one : repeater.landmarks()) {
        if (!one.is_tracked) continue;
        // Where the landmark is in a key image of the arc, by its number.
        double off_px = -1.0;
        for (int key = std::max(0, said.from_key - 2); key <= said.to_key + 2 && key < static_cast<int>(keys.size());
             ++key) {
          const auto& features = path->key_images[at(key)].features;
          const auto found = std::ranges::find(features, one.landmark.feature, &repeat::KeyFeature::feature);
          if (found == features.end()) continue;
          const auto bearing = camera->bearing(found->pixel_px);
          geometry::SeenPoint then;
          then.bearing = *bearing;
          off_px = std::max(off_px, epipolar_off_px(drive.poses[i], one.seen,
                                                    teach.poses[at(path->key_images[at(key)].picture)], then));
        }
        ++seen;
        if (off_px > 0.02 * options.width_px) ++wrong;
        figures.off_px.push_back(off_px);
      }
    }
    figures.seen += seen;
    figures.false_features += wrong;
    figures.lost += said.is_lost() ? 1 : 0;
    figures.right += !said.is_lost() && truth >= from - (to - from) && truth <= to + (to - from) ? 1 : 0;
    figures.enough += said.tracked >= 50 ? 1 : 0;
    figures.forwards += std::max(0, said.transitions);
    figures.backwards += std::max(0, -said.transitions);
    figures.doubted += !said.structure_agrees;
    figures.wrong_far += !said.is_lost() && std::abs(said.arc - arc_truth) > 1 ? 1 : 0;
    char line[512];
    std::snprintf(
        line, sizeof line,
        "{\"image\": \"%05d.jpg\", \"arc\": %d, \"from\": \"%05d.jpg\", \"to\": \"%05d.jpg\", \"tracked\": %d, "
        "\"predicted\": %d, \"recovered\": %d, \"progress\": %.3f, \"lateral_over_arc\": %.4f, \"steering_rad\": %.4f, "
        "\"error_px\": %.3f, "
        "\"lost\": %s, \"ms\": %.3f}\n",
        number, said.arc, from, to, said.tracked, said.predicted, said.recovered, said.progress, said.lateral,
        said.steering_rad, said.error_px, said.is_lost() ? "true" : "false", ms);
    out << line;
    if (options.verbose) {
      std::printf(
          "%3d truth %3d arc %2d (%2d) %d-%d lost %d tracked %3d/%3d predicted %3d progress %5.2f lateral %5.2f steer "
          "%5.2f err %.2f conf %.2f agrees %d wrong %d ms %.1f%s\n",
          number, truth, said.arc, arc_truth, from, to, static_cast<int>(said.lost), said.tracked, said.expected,
          said.predicted, said.progress, said.lateral, said.steering_rad, said.error_px, said.confidence,
          said.structure_agrees, wrong, ms, covered ? " covered" : "");
    }
  }
  std::printf(
      "| arcs | right | tracked 50 | lost | arcs off by 2 | forwards, back | doubted | wrong features | off px median, "
      "99 %% | ms median, 90 %%, worst |\n");
  const double n = figures.frames;
  std::printf("| %zu | %.3f | %.3f | %d | %d | %d, %d | %d | %.4f | %.2f, %.2f | %.1f, %.1f, %.1f |\n",
              path->arcs.size(), figures.right / n, figures.enough / n, figures.lost, figures.wrong_far,
              figures.forwards, figures.backwards, figures.doubted,
              figures.false_features / std::max(1.0, static_cast<double>(figures.seen)), at_share(figures.off_px, 0.5),
              at_share(figures.off_px, 0.99), at_share(figures.ms, 0.5), at_share(figures.ms, 0.9),
              at_share(figures.ms, 1.0));
  std::printf("pictures a second: %.0f\n", 1e3 * n / std::accumulate(figures.ms.begin(), figures.ms.end(), 0.0));
  return 0;
}

}  // namespace
}  // namespace homeward::bench

int main(int argc, char** argv) try {
  using namespace homeward;
  if (argc < 3) {
    std::fprintf(stderr, "usage: homeward_bench_repeat TEACH REPEAT [options]\n");
    return 2;
  }
  cv::setNumThreads(1);
  return bench::run(bench::options_of(argc, argv));
} catch (const tl::bad_expected_access<homeward::Error>& stopped) {
  std::fprintf(stderr, "%s\n", stopped.error().message.c_str());
  return 1;
} catch (const std::exception& stopped) {
  std::fprintf(stderr, "%s\n", stopped.what());
  return 1;
}
