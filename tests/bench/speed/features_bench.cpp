// SPDX-License-Identifier: Apache-2.0
// From a mirror camera's JPEG to features, beside OpenCV's plain SIFT on the same panorama.
#include <benchmark/benchmark.h>

#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

#include "camera/panorama.hpp"
#include "features/colour.hpp"
#include "features/columns.hpp"
#include "features/extract.hpp"
#include "imageio/decode.hpp"
#include "pipeline/eye.hpp"
#include "sim/generate/worlds.hpp"
#include "sim/renderer.hpp"
#include "support/sample_cameras.hpp"

namespace {

using namespace homeward;  // NOLINT(google-build-using-namespace): a benchmark's own file

/// A picture of the generated house as it comes from a camera, and what each step needs.
struct Scene {
  std::vector<std::uint8_t> jpeg;
  Image picture;
  features::FeatureConfig config;
  std::unique_ptr<pipeline::Eye> eye;
  camera::Panorama panorama;
};

const Scene& scene() {
  static const Scene made = [] {
    Scene s;
    const camera::CameraConfig camera = testing::mirror_camera();
    sim::LitWorld world(sim::generate_house(1));
    const Pose2 start = world.world().start;
    s.picture =
        sim::Renderer(world, sim::LightPreset::kDay, camera::Camera::create(camera).value()).render(start, {}, 1);
    s.jpeg = imageio::encode_jpeg(s.picture, 92);
    s.config = pipeline::suited_feature_config(*camera::Camera::create(camera).value());
    s.eye = std::make_unique<pipeline::Eye>(pipeline::Eye::create(camera, s.config).value());
    s.panorama = s.eye->unwrap(s.picture).value();
    return s;
  }();
  return made;
}

void BM_Decode(benchmark::State& state) {
  scene();  // made before the clock runs
  for (auto _ : state) benchmark::DoNotOptimize(imageio::decode(scene().jpeg, "picture"));
}

void BM_Unwrap(benchmark::State& state) {
  scene();  // made before the clock runs
  for (auto _ : state) benchmark::DoNotOptimize(scene().eye->unwrap(scene().picture));
}

void BM_Extract(benchmark::State& state) {
  scene();  // made before the clock runs
  int count = 0;
  for (auto _ : state) count = features::extract(scene().panorama, scene().config).size();
  state.counters["features"] = count;
}

/// Without columns: SIFT with its colour invariants, and the colour moments.
void BM_ExtractSift(benchmark::State& state) {
  features::FeatureConfig config = scene().config;
  config.max_columns = 0;
  for (auto _ : state) benchmark::DoNotOptimize(features::extract(scene().panorama, config));
}

void BM_ExtractColumns(benchmark::State& state) {
  scene();  // made before the clock runs
  for (auto _ : state) benchmark::DoNotOptimize(features::extract_columns(scene().panorama, scene().config));
}

/// The colour invariants of as many patches as there are SIFT features.
void BM_ColourInvariants(benchmark::State& state) {
  const Image& rgb = scene().panorama.rgb;
  for (auto _ : state) {
    for (int i = 0; i < scene().config.max_sift; ++i) {
      benchmark::DoNotOptimize(features::colour_invariants(rgb, i * 1.7, 20 + i % 160, 3.0 + i % 7));
    }
  }
}

void BM_ColourMoments(benchmark::State& state) {
  scene();  // made before the clock runs
  for (auto _ : state) benchmark::DoNotOptimize(features::colour_moments(scene().panorama));
}

/// All of it, as a robot's frame goes: JPEG in, features out.
void BM_JpegToFeatures(benchmark::State& state) {
  scene();  // made before the clock runs
  for (auto _ : state) benchmark::DoNotOptimize(scene().eye->look(imageio::decode(scene().jpeg, "picture").value()));
}

/// The measure to hold ours against: OpenCV's detectAndCompute with the same budget on the same panorama alone.
void BM_OpenCvSift(benchmark::State& state) {
  const Image& rgb = scene().panorama.rgb;
  const cv::Mat colour(rgb.height_px, rgb.width_px, CV_8UC3, const_cast<std::uint8_t*>(rgb.data.data()));
  cv::Mat grey;
  cv::cvtColor(colour, grey, cv::COLOR_RGB2GRAY);
  const auto sift = cv::SIFT::create(scene().config.max_sift);
  std::size_t count = 0;
  for (auto _ : state) {
    std::vector<cv::KeyPoint> points;
    cv::Mat descriptors;
    sift->detectAndCompute(grey, cv::noArray(), points, descriptors);
    count = points.size();
  }
  state.counters["features"] = static_cast<double>(count);
}

BENCHMARK(BM_Decode)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_Unwrap)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_Extract)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_ExtractSift)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_ExtractColumns)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_ColourInvariants)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_ColourMoments)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_JpegToFeatures)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_OpenCvSift)->Unit(benchmark::kMillisecond);

}  // namespace
