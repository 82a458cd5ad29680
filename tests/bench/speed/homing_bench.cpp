// SPDX-License-Identifier: Apache-2.0
// Homing to a view: the first vector from a 640x480 picture, everything included, and one of the motion phase.
#include <benchmark/benchmark.h>

#include "homing/visual_homing.hpp"
#include "pipeline/eye.hpp"
#include "sim/generate/worlds.hpp"
#include "sim/renderer.hpp"
#include "support/sample_cameras.hpp"

namespace {

using namespace homeward;  // NOLINT(google-build-using-namespace): a benchmark's own file

/// A target in the generated house, and pictures on the way to it from 3 m.
struct Scene {
  std::unique_ptr<pipeline::Eye> eye;
  features::Appearance target;
  std::vector<Pose2> poses;
  std::vector<Image> pictures;
};

const Scene& scene() {
  static const Scene made = [] {
    Scene s;
    const camera::CameraConfig config = testing::mirror_camera();
    const auto camera = camera::Camera::create(config).value();
    s.eye = std::make_unique<pipeline::Eye>(
        pipeline::Eye::create(config, pipeline::suited_feature_config(*camera)).value());
    sim::LitWorld world(sim::generate_house(1));
    const sim::Renderer renderer(world, sim::LightPreset::kDay, camera);
    const Pose2 home = world.world().start;
    s.target = s.eye->look(renderer.render(home, {}, 1)).value();
    constexpr int kPictures = 20;
    for (int i = 0; i < kPictures; ++i) {
      const double left_m = 1.5 - 0.04 * i;
      s.poses.push_back(home * Pose2{-left_m, 0.1, 0.02 * i});
      s.pictures.push_back(renderer.render(s.poses.back(), {}, static_cast<std::uint64_t>(i) + 2));
    }
    return s;
  }();
  return made;
}

void BM_HomingInitialisation(benchmark::State& state) {
  const Scene& s = scene();
  for (auto _ : state) {
    homing::VisualHoming homing;
    const auto panorama = s.eye->unwrap(s.pictures[0]).value();
    const auto seen =
        homing.update(s.eye->look(panorama), s.target, s.poses[0], std::nullopt, tracking::TrackingFrame(panorama), 1);
    if (!seen || !seen->target_m) state.SkipWithError("not begun");
    benchmark::DoNotOptimize(seen);
  }
}

/// One picture recognised anew in a map that is refined with it.
void BM_HomingRecognition(benchmark::State& state) {
  const Scene& s = scene();
  std::size_t next = 0;
  homing::VisualHoming homing;
  for (auto _ : state) {
    if (next % s.pictures.size() == 0) {
      homing = {};
      next = 0;
    }
    const auto panorama = s.eye->unwrap(s.pictures[next]).value();
    benchmark::DoNotOptimize(homing.update(s.eye->look(panorama), s.target, s.poses[next], std::nullopt,
                                           tracking::TrackingFrame(panorama), 1));
    ++next;
  }
}

/// One picture of the motion phase: unwrapped, tracked, vector.
void BM_HomingMotion(benchmark::State& state) {
  const Scene& s = scene();
  homing::VisualHoming homing;
  const auto begin = [&] {
    const auto panorama = s.eye->unwrap(s.pictures[0]).value();
    homing = {};
    (void)homing.update(s.eye->look(panorama), s.target, s.poses[0], std::nullopt, tracking::TrackingFrame(panorama),
                        1);
  };
  begin();
  std::size_t next = 1;
  for (auto _ : state) {
    const auto panorama = s.eye->unwrap(s.pictures[next]).value();
    const auto seen = homing.track(tracking::TrackingFrame(panorama), s.poses[next], 1);
    if (!seen) state.SkipWithError("lost");
    benchmark::DoNotOptimize(seen);
    if (++next < s.pictures.size()) continue;
    state.PauseTiming();
    begin();
    next = 1;
    state.ResumeTiming();
  }
}

BENCHMARK(BM_HomingInitialisation)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_HomingRecognition)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_HomingMotion)->Unit(benchmark::kMillisecond);

}  // namespace
