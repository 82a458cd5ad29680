// SPDX-License-Identifier: Apache-2.0
// homeward_bench_feature_tracks TOUR [WIDTH [MOST [DRAWN]]]: how long trackers hold Harris corners of a pinhole camera,
// how far off they then are, and what they cost. TOUR is a folder of pictures with camera.json and poses.csv (the
// truth); WIDTH: the pictures shrunk to it; MOST: corners; DRAWN: a PNG of the feature tracker's features by state.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <opencv2/core.hpp>
#include <string>
#include <variant>
#include <vector>

#include "core/pose2.hpp"
#include "feature_followers.hpp"
#include "files/write_file.hpp"
#include "imageio/decode.hpp"
#include "perspective_tour.hpp"
#include "tracking/harris.hpp"

namespace homeward::bench {
namespace {

constexpr int kEvery = 10;  // pictures from one start to the next
constexpr std::array<int, 5> kAges{1, 5, 10, 20, 40};
constexpr std::array<std::size_t, 3> kDrawnStarts{20, 120, 220};
constexpr std::array<std::size_t, 2> kStatesAt{0, 2};  // of kAges
constexpr std::array<int, 2> kDrawnAges{10, 30};
constexpr double kLeastBaseline_m = 0.05;  // nearer, the epipolar line says nothing

/// How far a point is from where the true motion allows it; negative where the motion is too small to say.
double error_px(const PerspectiveTour& tour, std::size_t first, const Eigen::Vector2d& first_px, std::size_t now,
                const Eigen::Vector2d& now_px) {
  const Pose2& a = tour.poses[first];
  const Pose2& b = tour.poses[now];
  const Eigen::Vector3d moved(b.x_m - a.x_m, b.y_m - a.y_m, 0.0);
  if (moved.norm() < kLeastBaseline_m) return -1.0;
  const auto turn = [](double theta) { return Eigen::AngleAxisd(theta, Eigen::Vector3d::UnitZ()).toRotationMatrix(); };
  const auto& k = std::get<camera::Pinhole>(tour.camera.model).intrinsics;
  const Eigen::Matrix3d robot_from_camera = tour.camera.robot_from_camera_rotation.toRotationMatrix();
  const auto ray = [&](const Eigen::Vector2d& pixel) {
    return Eigen::Vector3d((pixel.x() - k.cx_px) / k.fx_px, (pixel.y() - k.cy_px) / k.fy_px, 1.0);
  };
  const Eigen::Vector3d seen = turn(a.theta_rad) * robot_from_camera * ray(first_px);
  const Eigen::Vector3d normal = (turn(b.theta_rad) * robot_from_camera).transpose() * moved.cross(seen).normalized();
  return std::abs(normal.dot(ray(now_px))) / std::hypot(normal.x() / k.fx_px, normal.y() / k.fy_px);
}

struct Age {
  std::array<int, 6> states{};  // how many are in each, of the ways by reference
  int all = 0;
  int alive = 0;
  int wrong = 0;
  std::vector<double> errors_px;
};

std::vector<Eigen::Vector2d> corners(const Image& grey, int most) {
  tracking::HarrisConfig config;
  config.most = most;
  std::vector<Eigen::Vector2d> points;
  const auto picture = tracking::ImagePyramid::build(grey).value();
  const auto found = tracking::harris_corners(picture, config).value();
  for (const auto& corner : found) {
    points.push_back(corner.pixel_px);
  }
  return points;
}

void measure(const PerspectiveTour& tour, const NamedFollower& named, int most) {
  std::array<Age, kAges.size()> ages;
  std::vector<double> first_ms;
  double life = 0.0;
  int lives = 0;
  const double wrong_px = tour.grey.front().width_px / 320.0;
  for (std::size_t first = 0; first + kAges.back() < tour.grey.size(); first += kEvery) {
    const auto points = corners(tour.grey[first], most);
    const auto follower = named.make();
    follower->start(tour.grey[first], points);
    lives += static_cast<int>(points.size());
    for (int age = 1; age <= kAges.back(); ++age) {
      const std::size_t now = first + static_cast<std::size_t>(age);
      const double before = cpu_ms();
      follower->follow(tour.grey[now]);
      if (age == 1) first_ms.push_back(cpu_ms() - before);
      life += static_cast<double>(std::count(follower->is_alive.begin(), follower->is_alive.end(), true));
      const auto* found = std::find(kAges.begin(), kAges.end(), age);
      if (found == kAges.end()) continue;
      Age& row = ages[static_cast<std::size_t>(found - kAges.begin())];
      for (std::size_t i = 0; i < points.size(); ++i) {
        ++row.all;
        if (!follower->states.empty()) ++row.states[static_cast<std::size_t>(follower->states[i])];
        if (!follower->is_alive[i]) continue;
        ++row.alive;
        const double off_px = error_px(tour, first, points[i], now, follower->at_px[i]);
        if (off_px < 0.0) continue;
        row.errors_px.push_back(off_px);
        row.wrong += off_px > wrong_px ? 1 : 0;
      }
    }
  }
  std::printf("| %s | %.1f |", named.name.c_str(), life / lives);
  for (const Age& age : ages) std::printf(" %.3f |", static_cast<double>(age.alive) / age.all);
  for (std::size_t i = 2; i < ages.size(); ++i) {
    const auto& off = ages[i].errors_px;
    std::printf(" %.2f, %.2f, %.3f |", at_share(off, 0.5), at_share(off, 0.9),
                off.empty() ? 0.0 : ages[i].wrong / static_cast<double>(off.size()));
  }
  std::printf(" %.2f |", at_share(first_ms, 0.5));
  for (const std::size_t i : kStatesAt) {
    for (const int count : ages[i].states) std::printf(" %.3f", static_cast<double>(count) / ages[i].all);
    std::printf(" |");
  }
  std::printf("\n");
}

/// Green: tracked; red: lost by residual; yellow: diverged; blue: off the picture; magenta: contrast; white: never
/// taken.
void draw(const PerspectiveTour& tour, int most, const std::string& file) {
  constexpr int kAcross = 3;
  const int width_px = tour.grey.front().width_px;
  const int height_px = tour.grey.front().height_px;
  Image all(kAcross * width_px, 2 * height_px, 3);
  int part = 0;
  for (const std::size_t first : kDrawnStarts) {
    for (const int age : kDrawnAges) {
      const auto points = corners(tour.grey[first], most);
      const auto follower = all_followers(tour.camera).front().make();
      follower->start(tour.grey[first], points);
      for (int i = 1; i <= age; ++i) follower->follow(tour.grey[first + static_cast<std::size_t>(i)]);
      const Image& grey = tour.grey[first + static_cast<std::size_t>(age)];
      const int left = part / 2 * width_px;
      const int top = part % 2 * height_px;
      ++part;
      for (int v = 0; v < height_px; ++v) {
        for (int u = 0; u < width_px; ++u) std::fill_n(all.at(left + u, top + v), 3, *grey.at(u, v));
      }
      constexpr std::array<std::array<std::uint8_t, 3>, 6> kColours{
          {{0, 255, 0}, {60, 120, 255}, {255, 255, 0}, {255, 0, 255}, {255, 0, 0}, {255, 255, 255}}};
      for (std::size_t i = 0; i < points.size(); ++i) {
        const auto& colour = kColours[static_cast<std::size_t>(follower->states[i])];
        for (int d = -3; d <= 3; ++d) {
          const std::array<std::pair<int, int>, 4> square{{{d, 3}, {d, -3}, {3, d}, {-3, d}}};
          for (const auto& [du, dv] : square) {
            const int u = static_cast<int>(std::lround(follower->at_px[i].x())) + du;
            const int v = static_cast<int>(std::lround(follower->at_px[i].y())) + dv;
            if (u < 0 || v < 0 || u >= width_px || v >= height_px) continue;
            std::copy(colour.begin(), colour.end(), all.at(left + u, top + v));
          }
        }
      }
    }
  }
  const auto bytes = imageio::encode_png(all);
  if (!files::write_file(file, {reinterpret_cast<const char*>(bytes.data()), bytes.size()})) {
    std::fprintf(stderr, "%s could not be written\n", file.c_str());
  }
}

}  // namespace
}  // namespace homeward::bench

int main(int argc, char** argv) try {
  using namespace homeward::bench;
  if (argc < 2) {
    std::fprintf(stderr, "usage: homeward_bench_feature_tracks TOUR [WIDTH [MOST [DRAWN]]]\n");
    return 2;
  }
  cv::setNumThreads(1);
  const int width_px = argc > 2 ? std::stoi(argv[2]) : 640;
  const int most = argc > 3 ? std::stoi(argv[3]) : 200;
  const PerspectiveTour tour = read_perspective_tour(argv[1], width_px);
  if (tour.grey.size() <= static_cast<std::size_t>(kAges.back())) {
    std::fprintf(stderr, "%s: %d pictures and more are followed, and it has %zu\n", argv[1], kAges.back() + 1,
                 tour.grey.size());
    return 1;
  }
  double sum = 0.0;
  int starts = 0;
  for (std::size_t first = 0; first + kAges.back() < tour.grey.size(); first += kEvery, ++starts) {
    sum += static_cast<double>(corners(tour.grey[first], most).size());
  }
  std::printf("%d pixels wide, at most %d corners (%.0f on average), %d starts\n", width_px, most, sum / starts,
              starts);
  std::printf(
      "| way | pictures held | alive after 1 | 5 | 10 | 20 | 40 | error after 10: median, 90 %%, wrong | 20 | 40 | ms "
      "|\n");
  for (const NamedFollower& named : all_followers(tour.camera)) measure(tour, named, most);
  if (argc > 4) draw(tour, most, argv[4]);
  return 0;
} catch (const tl::bad_expected_access<homeward::Error>& stopped) {
  std::fprintf(stderr, "%s: %s\n", stopped.error().where.c_str(), stopped.error().message.c_str());
  return 1;
} catch (const std::exception& stopped) {
  std::fprintf(stderr, "%s\n", stopped.what());
  return 1;
}
