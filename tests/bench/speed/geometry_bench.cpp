// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <opengv/relative_pose/CentralRelativeAdapter.hpp>
#include <opengv/sac/Ransac.hpp>
#include <opengv/sac_problems/relative_pose/CentralRelativePoseSacProblem.hpp>
#include <random>

#include "core/angles.hpp"
#include "geometry/general_motion.hpp"
#include "geometry/motion_fit.hpp"
#include "geometry/planar_motion.hpp"

namespace homeward::geometry {
namespace {

// Noise of 0.7 px in hundredths of a degree: of a panorama 1024 px wide, and of cameras whose 640 px see 96 and 60
// degrees.
constexpr std::int64_t kOfPanorama = 25;
constexpr std::int64_t kOfWideLens = 14;
constexpr std::int64_t kOfLens = 7;

struct Scene {
  PlanarMotion truth;
  std::vector<Correspondence> correspondences;
};

/// Points of a building all around, 1 to 8 m away and from the floor to the ceiling, seen from two viewpoints 1 m
/// apart; bearings off by `noise_deg`, the target view tilted by `tilt_rad`, a share of the matches wrong.
Scene building(int count, double outlier_share, double noise_deg, double tilt_rad, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> angle_rad(-kPi, kPi);
  std::uniform_real_distribution<double> depth_m(1.0, 8.0);
  std::uniform_real_distribution<double> height_m(-1.0, 1.5);
  std::normal_distribution<double> noise_rad(0.0, radians(noise_deg));
  const auto point = [&] {
    const double azimuth_rad = angle_rad(random);
    const double away_m = depth_m(random);
    return Eigen::Vector3d(away_m * std::cos(azimuth_rad), away_m * std::sin(azimuth_rad), height_m(random));
  };
  const auto seen = [&](const Eigen::Vector3d& at) {
    const Eigen::Vector3d bearing = at.normalized();
    return Eigen::Vector3d(bearing + Eigen::Vector3d(noise_rad(random), noise_rad(random), noise_rad(random)))
        .normalized();
  };
  Scene scene;
  scene.truth = {angle_rad(random), angle_rad(random)};
  const Eigen::Vector3d t(std::cos(scene.truth.direction_rad), std::sin(scene.truth.direction_rad), 0.0);
  const Eigen::Matrix3d target_from_current =
      (Eigen::AngleAxisd(tilt_rad, Eigen::Vector3d(std::cos(1.0), std::sin(1.0), 0.0)) *
       Eigen::AngleAxisd(-scene.truth.turn_rad, Eigen::Vector3d::UnitZ()))
          .toRotationMatrix();
  const int wrong = static_cast<int>(outlier_share * count);
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d at = point();
    const Eigen::Vector3d there = i < wrong ? point() : at;
    scene.correspondences.push_back({seen(at), seen(target_from_current * (there - t))});
  }
  return scene;
}

std::vector<Scene> buildings(double outlier_share, double tilt_rad, double noise_deg, int count = 400) {
  constexpr int kMatches = 200;
  std::vector<Scene> scenes;
  for (std::uint64_t seed = 0; seed < static_cast<std::uint64_t>(count); ++seed) {
    scenes.push_back(building(kMatches, outlier_share, noise_deg, tilt_rad, 1000 + seed));
  }
  return scenes;
}

/// The direction's error when it is known which matches are right and that the views are level: no method does better.
double best_possible_deg(const Scene& scene, double outlier_share) {
  const auto wrong = static_cast<std::ptrdiff_t>(outlier_share * static_cast<double>(scene.correspondences.size()));
  const std::vector<Correspondence> right(scene.correspondences.begin() + wrong, scene.correspondences.end());
  FitConfig config;
  config.level = true;
  const MotionFit fit = fit_motion(MatchRows(right), {scene.truth}, config);
  return std::abs(degrees(wrap_angle(fit.motion.planar.direction_rad - scene.truth.direction_rad)));
}

/// Median and 95th percentile of the direction's error, and how often there is no answer, over all scenes.
void count_errors(benchmark::State& state, const std::vector<Scene>& scenes, double outlier_share, bool level) {
  std::vector<double> errors_deg;
  std::vector<double> bounds_deg;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const auto estimate = estimate_planar_motion(scenes[i].correspondences, {}, i);
    errors_deg.push_back(
        estimate ? std::abs(degrees(wrap_angle(estimate->motion.direction_rad - scenes[i].truth.direction_rad)))
                 : 180.0);
    bounds_deg.push_back(best_possible_deg(scenes[i], outlier_share));
  }
  std::ranges::sort(bounds_deg);
  std::ranges::sort(errors_deg);
  state.counters["median_deg"] = errors_deg[errors_deg.size() / 2];
  if (level) state.counters["bound_median_deg"] = bounds_deg[bounds_deg.size() / 2];
  state.counters["p95_deg"] = errors_deg[errors_deg.size() * 95 / 100];
  state.counters["max_deg"] = errors_deg.back();
}

/// Arguments: outliers in percent, tilt in tenths of a degree, noise in hundredths of one.
void planar_motion(benchmark::State& state) {
  const double outlier_share = static_cast<double>(state.range(0)) / 100.0;
  const std::vector<Scene> scenes = buildings(outlier_share, radians(static_cast<double>(state.range(1)) / 10.0),
                                              static_cast<double>(state.range(2)) / 100.0);
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(estimate_planar_motion(scenes[i % scenes.size()].correspondences, {}, i));
    ++i;
  }
  count_errors(state, scenes, outlier_share, state.range(1) == 0);
}
BENCHMARK(planar_motion)
    ->Unit(benchmark::kMillisecond)
    ->ArgsProduct({{0, 50, 80}, {0}, {kOfPanorama, kOfWideLens, kOfLens}})
    ->Args({50, 10, kOfPanorama})
    ->Args({50, 30, kOfPanorama});

/// OpenGV's five-point RANSAC with its refinement, of motions that need not be planar, on the same level scenes. The
/// arguments are as above, without the tilt.
void five_point_of_opengv(benchmark::State& state) {
  using Problem = opengv::sac_problems::relative_pose::CentralRelativePoseSacProblem;
  const double noise_deg = static_cast<double>(state.range(1)) / 100.0;
  constexpr int kScenes = 40;
  const std::vector<Scene> scenes = buildings(static_cast<double>(state.range(0)) / 100.0, 0.0, noise_deg, kScenes);
  std::vector<double> errors_deg;
  const auto estimate = [&](const Scene& scene) {
    opengv::bearingVectors_t current;
    opengv::bearingVectors_t target;
    for (const Correspondence& c : scene.correspondences) {
      current.push_back(c.current);
      target.push_back(c.target);
    }
    opengv::relative_pose::CentralRelativeAdapter adapter(current, target);
    opengv::sac::Ransac<Problem> ransac;
    constexpr bool kRandomSeed = false;
    ransac.sac_model_ = std::make_shared<Problem>(adapter, Problem::STEWENIUS, kRandomSeed);
    ransac.threshold_ = 2.0 * (1.0 - std::cos(3.0 * radians(noise_deg)));  // it sums 1 - cos of both reprojections
    ransac.max_iterations_ = 1000;
    if (!ransac.computeModel()) return 180.0;
    opengv::transformation_t motion;
    ransac.sac_model_->optimizeModelCoefficients(ransac.inliers_, ransac.model_coefficients_, motion);
    const double direction_rad = std::atan2(motion(1, 3), motion(0, 3));
    return std::abs(degrees(wrap_angle(direction_rad - scene.truth.direction_rad)));
  };
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(estimate(scenes[i++ % scenes.size()]));
  for (const Scene& scene : scenes) errors_deg.push_back(estimate(scene));
  std::ranges::sort(errors_deg);
  state.counters["median_deg"] = errors_deg[errors_deg.size() / 2];
  state.counters["max_deg"] = errors_deg.back();
}
BENCHMARK(five_point_of_opengv)
    ->Unit(benchmark::kMillisecond)
    ->ArgsProduct({{50}, {kOfPanorama, kOfWideLens, kOfLens}});

/// Matches at random: all iterations of both searches. The argument is how many.
void general_motion(benchmark::State& state) {
  std::vector<Scene> scenes;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    scenes.push_back(building(static_cast<int>(state.range(0)), 1.0, 0.01 * kOfPanorama, 0.0, 9000 + seed));
  }
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(estimate_motion(scenes[i % scenes.size()].correspondences, {}, i));
    ++i;
  }
}
BENCHMARK(general_motion)->Unit(benchmark::kMillisecond)->Arg(60)->Arg(200);

}  // namespace
}  // namespace homeward::geometry
