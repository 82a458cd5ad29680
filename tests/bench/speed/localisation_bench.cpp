// SPDX-License-Identifier: Apache-2.0
// What one picture costs a belief, in a small map and in that of a large building: features, candidates, comparing.
#include <benchmark/benchmark.h>

#include <map>
#include <memory>
#include <random>

#include "localisation/localiser.hpp"
#include "pipeline/belief_tracker.hpp"
#include "sim/generate/worlds.hpp"
#include "sim/renderer.hpp"
#include "support/sample_cameras.hpp"

namespace {

using namespace homeward;  // NOLINT(google-build-using-namespace): a benchmark's own file

constexpr int kPictures = 24;

struct Seen {
  camera::CameraConfig camera;
  features::FeatureConfig config;
  std::vector<Image> pictures;
  std::vector<features::Appearance> appearances;
};

/// A walk through a room of the generated house.
const Seen& seen() {
  static const Seen made = [] {
    Seen s;
    s.camera = testing::mirror_camera();
    const auto camera = camera::Camera::create(s.camera).value();
    s.config = pipeline::suited_feature_config(*camera);
    const auto eye = pipeline::Eye::create(s.camera, s.config).value();
    sim::LitWorld world(sim::generate_house(1));
    const sim::Renderer renderer(world, sim::LightPreset::kDay, camera);
    for (int i = 0; i < kPictures; ++i) {
      Pose2 pose = world.world().start;
      pose.x_m += 0.4 * (i % 6);
      pose.y_m += 0.4 * (i / 6);
      s.pictures.push_back(renderer.render(pose, {}, static_cast<std::uint64_t>(i)));
      s.appearances.push_back(eye.look(s.pictures.back()).value());
    }
    return s;
  }();
  return made;
}

/// A made-up place: a quarter of its features are those of a picture, a little changed, as of a building where doors
/// and lamps repeat; the others are changed beyond recognition, though not beyond the same words.
features::Appearance made_up(int number) {
  std::mt19937_64 random(static_cast<std::uint64_t>(number));
  features::Appearance made = seen().appearances[random() % kPictures];
  for (features::FeatureSet* set : {&made.sift, &made.columns}) {
    for (Eigen::Index i = 0; i < set->size(); ++i) {
      const int most = random() % 4 == 0 ? 20 : 80;
      for (Eigen::Index d = 0; d < set->descriptors.cols(); ++d) {
        const int change = static_cast<int>(random() % static_cast<std::uint64_t>(2 * most + 1)) - most;
        set->descriptors(i, d) = static_cast<std::uint8_t>(std::clamp(set->descriptors(i, d) + change, 0, 255));
      }
    }
  }
  return made;
}

/// Corridors of places one after the other; the first ones are those of the walk.
std::shared_ptr<const map::TopologicalMap> map_of(int places) {
  static std::map<int, std::shared_ptr<const map::TopologicalMap>> kept;
  auto& made = kept[places];
  if (made) return made;
  map::TopologicalMap map;
  map.camera = seen().camera;
  map.feature_config = seen().config;
  map.feature_config_id = features::feature_config_id(map.feature_config);
  map.motion.distance_scale = 0.2;
  map.motion.hop_spread = 0.6;
  for (int i = 0; i < places; ++i) {
    map::Place place;
    place.id = PlaceId("p" + std::to_string(i));
    place.appearances.push_back(i < kPictures ? seen().appearances[static_cast<std::size_t>(i)] : made_up(i));
    map.places.push_back(std::move(place));
    if (i == 0) continue;
    map::Edge edge;
    edge.from = map.places[static_cast<std::size_t>(i) - 1].id;
    edge.to = map.places[static_cast<std::size_t>(i)].id;
    map.edges.push_back(edge);
    std::swap(edge.from, edge.to);
    map.edges.push_back(edge);
  }
  made = std::make_shared<const map::TopologicalMap>(std::move(map));
  return made;
}

/// From a picture to a belief.
void BM_Localise(benchmark::State& state) {
  auto tracker = pipeline::BeliefTracker::create(map_of(static_cast<int>(state.range(0)))).value();
  std::size_t next = 0;
  std::size_t right = 0;
  std::size_t asked = 0;
  for (auto _ : state) {
    const auto belief = tracker.update(seen().pictures[next]);
    right += belief->top.front().place.str() == "p" + std::to_string(next) ? 1 : 0;
    ++asked;
    next = (next + 1) % kPictures;
  }
  state.counters["right"] = static_cast<double>(right) / static_cast<double>(asked);
}

/// The same without the features: candidates, comparing and the filter.
void BM_LocaliseSeen(benchmark::State& state) {
  localisation::LocaliserConfig config;
  config.max_candidates = static_cast<int>(state.range(1));
  localisation::Localiser localiser(map_of(static_cast<int>(state.range(0))), config);
  std::size_t next = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(localiser.update(seen().appearances[next]));
    next = (next + 1) % kPictures;
  }
}

BENCHMARK(BM_Localise)->Arg(100)->Arg(10'000)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_LocaliseSeen)->ArgsProduct({{100, 10'000}, {8, 16, 24}})->Unit(benchmark::kMillisecond);

}  // namespace
