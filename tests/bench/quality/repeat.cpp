// SPDX-License-Identifier: Apache-2.0
// homeward_bench_repeat TEACH REPEAT [options]: teaches a path from one folder of pictures with camera.json and
// poses.csv (the truth), repeats it with another one, and says how well it was followed: the last line is a row of a
// table.
//   --out FILE      a line of JSON for each picture
//   --verbose       a line for each picture
//   --width W       the pictures shrunk to it; 320
//   --close         the path is closed where it can be
//   --dense         taught with repeat::dense_teaching()
//   --known W       weight of what the arc before knows of an arc's motion, after --dense; 0: nothing
//   --n N, --share S, --spacing PX, --strength S, --texture T, --sens K, --R R, --most M    of the teaching
//   --reach R       arcs on both sides whose features are tracked
//   --begin ARC     -1: anywhere, by recognition; 0
//   --from PICTURE  the first one that is shown; 0
//   --only COUNT    the first pictures of the taught drive alone, and the ones beside them of the other
//   --anywhere N    instead: each Nth picture is begun from nowhere, with as many more as it takes to compare all key
//                   images; how many are found, and on a right arc
//   --contrast C    that features have that are recognised
//   --vouching N    so many that are recognised make up for landmarks (RecognitionConfig)
//   --visible T     what shows less is not expected by little light (RepeatConfig)
//   --growth        also what a picture takes, by tenths of each drive
//   --cover FROM COUNT SHARE   a share of COUNT pictures from FROM on is covered
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <memory>
#include <numeric>
#include <opencv2/core.hpp>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "camera/camera.hpp"
#include "core/angles.hpp"
#include "core/index.hpp"
#include "perspective_tour.hpp"
#include "repeat/closing.hpp"
#include "repeat/repeater.hpp"
#include "repeat/teach.hpp"

namespace homeward::bench {
namespace {

struct Options {
  std::string teach, repeat, out;
  int width_px = 320;
  int begin = 0;
  int from = 0;
  int anywhere = 0;
  int only = -1;
  int cover_from = -1;
  int cover_count = 0;
  double cover_share = 0.0;
  bool verbose = false;
  bool closes = false;
  bool growth = false;
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
    else if (name == "--anywhere")
      options.anywhere = std::stoi(next());
    else if (name == "--contrast")
      options.repeating.recognition->contrast = std::stod(next());
    else if (name == "--vouching")
      options.repeating.recognition->vouching = std::stoi(next());
    else if (name == "--visible")
      options.repeating.least_visible = std::stod(next());
    else if (name == "--from")
      options.from = std::stoi(next());
    else if (name == "--dense") {
      options.teaching = repeat::dense_teaching();
      options.repeating.tracker.least_texture = options.teaching.tracker.least_texture;
    } else if (name == "--known")
      options.teaching.known_weight = std::stod(next());
    else if (name == "--out")
      options.out = next();
    else if (name == "--verbose")
      options.verbose = true;
    else if (name == "--close")
      options.closes = true;
    else if (name == "--growth")
      options.growth = true;
    else if (name == "--only")
      options.only = std::stoi(next());
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
                       const Eigen::Vector3d& then) {
  constexpr int kSteps = 400;
  constexpr double kNearest_m = 0.2;
  const Eigen::Vector3d baseline = in_robot(here, {there.x_m, there.y_m, 0.0});
  const Eigen::Vector3d turned = Eigen::AngleAxisd(there.theta_rad - here.theta_rad, Eigen::Vector3d::UnitZ()) * then;
  double best = 1e9;
  for (int k = 0; k <= kSteps; ++k) {
    const double share = static_cast<double>(k) / kSteps;
    best = std::min(best, geometry::offset_px(seen, turned + share * share / kNearest_m * baseline).norm());
  }
  return best;
}

struct Figures {
  std::vector<double> ms, off_px;
  std::vector<double> lateral_off_m, bearing_off_deg;
  int frames = 0;
  int lost = 0;
  int right = 0;      // between the key images of the arc that was said, or at most its length outside
  int enough = 0;     // 50 features and more are tracked
  int wrong_far = 0;  // arcs off by two and more
  int forwards = 0;
  int backwards = 0;
  int doubted = 0;
  int ends = 0;  // pictures past the end of the path
  int false_features = 0;
};

/// The picture of the taught drive that a pose is beside, by its heading, too, from the one before on: paths lead
/// through a place more than once.
int beside(const std::vector<Pose2>& taught, const repeat::TaughtPath& path, const Pose2& here, int before) {
  constexpr int kBack = 12;
  constexpr int kOn = 25;
  constexpr double kMetresARadian = 0.3;
  const int count = static_cast<int>(taught.size());
  const int round_from = path.closing ? path.key_images[at(path.closing->key_image)].picture : count;
  int best = before;
  double least = 1e9;
  for (int step = before - kBack; step < before + kOn; ++step) {
    int i = step;
    if (i >= count) i += round_from - count;
    if (i < round_from && before >= round_from && path.closing) i += count - round_from;
    if (i < 0 || i >= count) continue;
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

/// A path with the pictures of its key images.
struct Taught {
  std::shared_ptr<const camera::Camera> camera;
  std::vector<Pose2> poses;  // of the pictures that it was taught with
  std::shared_ptr<const repeat::TaughtPath> path;
  std::vector<std::shared_ptr<const tracking::ImagePyramid>> keys;
  std::vector<double> ms;  // that each picture took to teach

  [[nodiscard]] int picture_of(int key) const { return path->key_images[at(key)].picture; }
  [[nodiscard]] int arcs_between(int one, int other) const {
    const int apart = std::abs(one - other);
    if (!path->closing) return apart;
    const int round = static_cast<int>(path->arcs.size()) - *path->arc_from(path->closing->key_image);
    return std::min(apart, std::abs(round - apart));
  }
  /// The arc that a picture lies on.
  [[nodiscard]] int arc_of(int picture) const {
    int found = 0;
    for (std::size_t arc = 0; arc < path->arcs.size(); ++arc) {
      if (picture_of(path->arcs[arc].from) <= picture) found = static_cast<int>(arc);
    }
    return found;
  }
};

void keep_first(PerspectiveTour& tour, int count) {
  tour.grey.resize(std::min(tour.grey.size(), at(count)));
  tour.poses.resize(tour.grey.size());
}

Taught teach(const Options& options) {
  PerspectiveTour tour = read_perspective_tour(options.teach, options.width_px);
  if (options.only >= 0) keep_first(tour, options.only);
  Taught taught;
  taught.camera = camera::Camera::create(tour.camera).value();
  taught.poses = tour.poses;
  auto teacher = repeat::Teacher::create(options.teaching, taught.camera).value();
  for (const Image& grey : tour.grey) {
    const double before_ms = cpu_ms();
    (void)teacher.add(tracking::ImagePyramid::build(grey).value()).value();
    taught.ms.push_back(cpu_ms() - before_ms);
  }
  repeat::TaughtPath path = teacher.path().value();
  for (const auto& key : path.key_images) {
    taught.keys.push_back(std::make_shared<const tracking::ImagePyramid>(
        tracking::ImagePyramid::build(tour.grey[at(key.picture)]).value()));
  }
  const auto picture_of = [&taught](int key) { return taught.keys[at(key)]; };
  if (options.closes) repeat::close_path(path, picture_of, taught.camera, options.teaching);
  taught.path = std::make_shared<const repeat::TaughtPath>(std::move(path));
  return taught;
}

/// How far a tracked landmark lies from where the key images around have it, at worst; below 0 where none has it.
double feature_off_px(const Taught& taught, const repeat::FollowedLandmark& one, int from_key, const Pose2& here) {
  constexpr int kAround = 4;
  double off_px = -1.0;
  const int last = std::min(from_key + 1 + kAround, static_cast<int>(taught.keys.size()) - 1);
  for (int key = std::max(0, from_key - kAround); key <= last; ++key) {
    const auto& features = taught.path->key_images[at(key)].features;
    const auto found = std::ranges::find(features, one.landmark.feature, &repeat::KeyFeature::feature);
    if (found == features.end()) continue;
    const auto bearing = taught.camera->bearing(found->pixel_px);
    if (!bearing) continue;
    off_px = std::max(off_px, epipolar_off_px(here, one.seen, taught.poses[at(taught.picture_of(key))], *bearing));
  }
  return off_px;
}

void write_line(std::ofstream& out, int number, const repeat::Repeated& said, int from, int to, double ms) {
  std::array<char, 512> line{};
  std::snprintf(line.data(), line.size(),
                "{\"image\": \"%05d.jpg\", \"arc\": %d, \"from\": \"%05d.jpg\", \"to\": \"%05d.jpg\", \"tracked\": %d, "
                "\"predicted\": %d, \"recovered\": %d, \"progress\": %.3f, \"lateral_over_arc\": %.4f, "
                "\"steering_rad\": %.4f, \"error_px\": %.3f, \"confidence\": %.3f, \"lost\": %s, \"ms\": %.3f}\n",
                number, said.arc, from, to, said.tracked, said.predicted, said.recovered, said.progress, said.lateral,
                said.steering_rad, said.error_px, said.confidence, said.is_lost() ? "true" : "false", ms);
  out << line.data();
}

/// How far off what was said of the way is: beside the arc, and where the next key image is.
void judge_way(Figures& figures, const Taught& taught, const repeat::Repeated& said, const Pose2& here) {
  constexpr double kLeastArc_m = 0.05;
  constexpr double kLeastWay_m = 0.15;  // nearer, the next key image is no aim any more
  const Pose2& from = taught.poses[at(taught.picture_of(said.from_key))];
  const Pose2& to = taught.poses[at(taught.picture_of(said.to_key))];
  const Eigen::Vector2d arc(to.x_m - from.x_m, to.y_m - from.y_m);
  const Eigen::Vector2d gone(here.x_m - from.x_m, here.y_m - from.y_m);
  if (!said.bearing_to_next_rad || arc.norm() < kLeastArc_m) return;
  const double lateral_m = (arc.x() * gone.y() - arc.y() * gone.x()) / arc.norm();
  figures.lateral_off_m.push_back(std::abs(said.lateral * arc.norm() - lateral_m));
  const Eigen::Vector2d left = arc - gone;
  if (left.norm() < kLeastWay_m) return;
  const double bearing_rad = std::atan2(left.y(), left.x()) - here.theta_rad;
  figures.bearing_off_deg.push_back(degrees(std::abs(wrap_angle(*said.bearing_to_next_rad - bearing_rad))));
}

/// Whether a picture that is beside a taught one is on the arc that is said, or at most its length outside.
bool on_right_arc(const Taught& taught, const repeat::Repeated& said, int truth) {
  const int from = taught.picture_of(said.from_key);
  const int to = taught.picture_of(said.to_key);
  constexpr int kNear = 5;  // pictures before and after where the path is closed
  if (to <= from) return truth >= from - kNear || std::abs(truth - to) <= kNear;
  return truth >= from - (to - from) && truth <= to + (to - from);
}

/// Judges what was said of a picture, which is beside a taught one.
void judge(Figures& figures, const Taught& taught, const repeat::Repeater& repeater, const repeat::Repeated& said,
           int truth, const Pose2& here, const Options& options) {
  constexpr double kWrong = 0.02;  // of the width: epipolar lines are as far off where a feature is another one
  ++figures.frames;
  figures.doubted += said.structure_agrees ? 0 : 1;
  figures.forwards += std::max(0, said.transitions);
  figures.backwards += std::max(0, -said.transitions);
  if (said.is_lost()) {
    ++figures.lost;
    return;
  }
  figures.right += on_right_arc(taught, said, truth) ? 1 : 0;
  figures.enough += said.tracked >= 50 ? 1 : 0;
  judge_way(figures, taught, said, here);
  figures.wrong_far += taught.arcs_between(said.arc, taught.arc_of(truth)) > 1 ? 1 : 0;
  figures.ends += said.at_end ? 1 : 0;
  for (const repeat::FollowedLandmark& one : repeater.landmarks()) {
    if (!one.is_tracked) continue;
    const double off_px = feature_off_px(taught, one, said.from_key, here);
    figures.off_px.push_back(off_px);
    figures.false_features += off_px > kWrong * options.width_px ? 1 : 0;
  }
}

void print(const Figures& figures, std::size_t arcs) {
  std::printf(
      "| arcs | right | tracked 50 | lost | arcs off by 2 | forwards, back | doubted | wrong features | off px median, "
      "99 %% | beside off m, median, 90 %% | bearing off deg | ms median, 90 %%, worst | pictures/s |\n");
  const double n = figures.frames;
  const double wrong = figures.false_features / std::max(1.0, static_cast<double>(figures.off_px.size()));
  std::printf(
      "| %zu | %.3f | %.3f | %d | %d | %d, %d | %d | %.4f | %.2f, %.2f | %.3f, %.3f | %.1f, %.1f | %.1f, %.1f, %.1f | "
      "%.0f |\n",
      arcs, figures.right / n, figures.enough / n, figures.lost, figures.wrong_far, figures.forwards, figures.backwards,
      figures.doubted, wrong, at_share(figures.off_px, 0.5), at_share(figures.off_px, 0.99),
      at_share(figures.lateral_off_m, 0.5), at_share(figures.lateral_off_m, 0.9),
      at_share(figures.bearing_off_deg, 0.5), at_share(figures.bearing_off_deg, 0.9), at_share(figures.ms, 0.5),
      at_share(figures.ms, 0.9), at_share(figures.ms, 1.0),
      1e3 * n / std::accumulate(figures.ms.begin(), figures.ms.end(), 0.0));
}

/// How often a path is found that nothing is known of the place on.
void begin_anywhere(const Options& options, const Taught& taught, const PerspectiveTour& drive,
                    const repeat::Repeater& unbegun) {
  const int keys = static_cast<int>(taught.keys.size());
  const int windows = 1 + (keys - 1) / options.repeating.recognition->most_compared;
  int tried = 0, found = 0, right = 0, truth = 0;
  for (int number = 0; number + windows <= static_cast<int>(drive.grey.size()); ++number) {
    truth = beside(taught.poses, *taught.path, drive.poses[at(number)], truth);
    if (number % options.anywhere != 0) continue;
    ++tried;
    repeat::Repeater repeater = unbegun;
    for (int k = 0; k < windows; ++k) {
      const auto grey = tracking::ImagePyramid::build(drive.grey[at(number + k)]).value();
      const repeat::Repeated said = repeater.step(std::make_shared<const tracking::ImagePyramid>(grey)).value();
      if (said.is_lost()) continue;
      ++found;
      const bool is_right = on_right_arc(taught, said, truth);
      right += is_right ? 1 : 0;
      if (options.verbose && !is_right)
        std::printf("%d: arc %d, and is on %d\n", number, said.arc, taught.arc_of(truth));
      break;
    }
  }
  std::printf("begun anywhere %d times, found %d, on a right arc %d\n", tried, found, right);
}

int run(const Options& options) {
  const Taught taught = teach(options);
  PerspectiveTour drive = read_perspective_tour(options.repeat, options.width_px);
  const auto picture_of = [&taught](int key) { return taught.keys[at(key)]; };
  auto repeater = repeat::Repeater::create(options.repeating, taught.path, picture_of, taught.camera).value();
  if (options.anywhere > 0) {
    begin_anywhere(options, taught, drive, repeater);
    return 0;
  }
  const auto begun = options.begin < 0 ? Status{} : repeater.begin(options.begin);
  if (!begun) throw std::runtime_error(begun.error().message);
  Figures figures;
  int truth = options.from;
  std::ofstream out(options.out);
  for (int number = options.from; number < static_cast<int>(drive.grey.size()); ++number) {
    if (options.only >= 0 && truth >= options.only - 1) break;
    Image& grey = drive.grey[at(number)];
    const bool covered = number >= options.cover_from && number < options.cover_from + options.cover_count;
    if (covered) cover(grey, options.cover_share);
    const double before_ms = cpu_ms();
    auto pyramid = std::make_shared<const tracking::ImagePyramid>(tracking::ImagePyramid::build(grey).value());
    const repeat::Repeated said = repeater.step(std::move(pyramid)).value();
    const double ms = cpu_ms() - before_ms;
    figures.ms.push_back(ms);
    const Pose2& here = drive.poses[at(number)];
    truth = beside(taught.poses, *taught.path, here, truth);
    const std::size_t wrong_before = static_cast<std::size_t>(figures.false_features);
    judge(figures, taught, repeater, said, truth, here, options);
    const int from = taught.picture_of(said.from_key);
    const int to = taught.picture_of(said.to_key);
    write_line(out, number, said, from, to, ms);
    if (!options.verbose) continue;
    std::printf(
        "%3d truth %3d arc %2d (%2d) %d-%d lost %d tracked %3d/%3d predicted %3d progress %5.2f lateral %5.2f steer "
        "%5.2f err %.2f conf %.2f agrees %d wrong %zu ms %.1f%s\n",
        number, truth, said.arc, taught.arc_of(truth), from, to, static_cast<int>(said.lost), said.tracked,
        said.expected, said.predicted, said.progress, said.lateral, said.steering_rad, said.error_px, said.confidence,
        said.structure_agrees, static_cast<std::size_t>(figures.false_features) - wrong_before, ms,
        covered ? " covered" : "");
  }
  print(figures, taught.path->arcs.size());
  if (options.growth) {
    std::set<int> landmarks;
    for (const map::KeyImage& key : taught.path->key_images) {
      for (const repeat::KeyFeature& one : key.features) landmarks.insert(one.feature);
    }
    std::printf("%zu pictures, %zu arcs, %zu landmarks\n", taught.ms.size(), taught.path->arcs.size(),
                landmarks.size());
    print_tenths("teaching", taught.ms);
    print_tenths("repeating", figures.ms);
  }
  if (options.closes) {
    std::printf("closed at picture %d, past an end in %d pictures\n",
                taught.path->closing ? taught.picture_of(taught.path->closing->key_image) : -1, figures.ends);
  }
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
