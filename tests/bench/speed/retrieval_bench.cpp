// SPDX-License-Identifier: Apache-2.0
// The retrieval index with as many places as a large building has: asking, adding, reading; memory.
#include <benchmark/benchmark.h>

#include <map>
#include <random>

#include "matching/retrieval_index.hpp"
#include "pipeline/eye.hpp"
#include "sim/generate/worlds.hpp"
#include "sim/renderer.hpp"
#include "support/sample_cameras.hpp"

namespace {

using namespace homeward;  // NOLINT(google-build-using-namespace): a benchmark's own file

constexpr int kPictures = 24;
constexpr std::size_t kNoGraph = 1'000'000'000;
constexpr int kQueries = 200;

/// What is seen from different places of the generated house.
const std::vector<features::FeatureSet>& pictures() {
  static const std::vector<features::FeatureSet> seen = [] {
    const camera::CameraConfig config = testing::mirror_camera();
    const auto camera = camera::Camera::create(config).value();
    const auto eye = pipeline::Eye::create(config, pipeline::suited_feature_config(*camera)).value();
    sim::LitWorld world(sim::generate_house(1));
    const sim::Renderer renderer(world, sim::LightPreset::kDay, camera);
    std::vector<features::FeatureSet> sets;
    for (int i = 0; i < kPictures; ++i) {
      Pose2 pose = world.world().start;
      pose.x_m += 0.5 * (i % 6);
      pose.y_m += 0.5 * (i / 6);
      const auto seed = static_cast<std::uint64_t>(i);
      sets.push_back(eye.look(renderer.render(pose, {}, seed)).value().sift);
    }
    return sets;
  }();
  return seen;
}

const features::Vocabulary& vocabulary() {
  static const features::Vocabulary trained = [] {
    std::vector<const features::FeatureSet*> sets;
    for (const auto& set : pictures()) sets.push_back(&set);
    return features::train_vocabulary(sets, matching::kRetrievalWords, 1).value();
  }();
  return trained;
}

/// A made-up place: six in ten features as in one picture, three in ten as in another, one in ten from anywhere; each
/// number changed a little. `visit` gives the same place as the camera sees it again: a tenth of its features differ.
features::FeatureSet place(int number, int visit) {
  std::mt19937_64 random(static_cast<std::uint64_t>(number));
  std::mt19937_64 noise(static_cast<std::uint64_t>(number) * 100 + static_cast<std::uint64_t>(visit));
  const std::size_t first = random() % kPictures;
  const std::size_t second = random() % kPictures;
  features::FeatureSet set;
  const Eigen::Index count = 700;
  set.bearings.setZero(count, 3);
  set.descriptors.resize(count, vocabulary().words.cols());
  for (Eigen::Index i = 0; i < count; ++i) {
    const std::uint64_t draw = random() % 10;
    std::size_t from = draw < 6 ? first : draw < 9 ? second : random() % kPictures;
    std::uint64_t row = random();
    if (visit > 0 && noise() % 10 == 0) {
      from = noise() % kPictures;
      row = noise();
    }
    const auto& descriptors = pictures()[from].descriptors;
    const auto at = static_cast<Eigen::Index>(row % static_cast<std::uint64_t>(descriptors.rows()));
    set.bearings.row(i) = pictures()[from].bearings.row(at);
    std::uint64_t bits = 0;
    for (Eigen::Index d = 0; d < set.descriptors.cols(); ++d) {
      if (d % 16 == 0) bits = noise();
      const int changed = descriptors(at, d) + static_cast<int>(bits & 15U) - 8;
      bits >>= 4U;
      set.descriptors(i, d) = static_cast<std::uint8_t>(std::clamp(changed, 0, 255));
    }
  }
  return set;
}

/// Made once for each size; the graph's from the exact one's bytes, by its header's field for where graphs begin.
const matching::RetrievalIndex& exact_index(int places) {
  static std::map<int, matching::RetrievalIndex> made;
  const auto known = made.find(places);
  if (known != made.end()) return known->second;
  auto index =
      matching::RetrievalIndex::create(vocabulary(), {matching::RetrievalConfig{}.code_length, kNoGraph}).value();
  for (int i = 0; i < places; ++i) {
    if (!index.add("place " + std::to_string(i), place(i, 0))) std::abort();
  }
  return made.emplace(places, std::move(index)).first->second;
}

std::vector<std::uint8_t> bytes_with_graph(int places) {
  std::vector<std::uint8_t> bytes = exact_index(places).serialise();
  constexpr std::size_t kGraphFromAt = 20;
  std::fill_n(bytes.begin() + kGraphFromAt, 4, std::uint8_t{0});
  return bytes;
}

const matching::RetrievalIndex& graph_index(int places) {
  static std::map<int, matching::RetrievalIndex> made;
  const auto known = made.find(places);
  if (known != made.end()) return known->second;
  return made.emplace(places, matching::RetrievalIndex::deserialise(bytes_with_graph(places), "bench").value())
      .first->second;
}

void ask(benchmark::State& state, const matching::RetrievalIndex& index) {
  const int places = static_cast<int>(state.range(0));
  std::vector<features::FeatureSet> queries;
  for (int i = 0; i < kQueries; ++i) queries.push_back(place(i * 37 % places, 1));
  std::size_t at = 0;
  for (auto _ : state) benchmark::DoNotOptimize(index.query(queries[at++ % kQueries], 10));
  const auto& exact = exact_index(places);
  int same = 0;
  int itself = 0;
  for (int i = 0; i < kQueries; ++i) {
    const auto found = index.query(queries[static_cast<std::size_t>(i)], 10);
    const auto truth = exact.query(queries[static_cast<std::size_t>(i)], 10);
    for (const auto& a : truth) {
      same += std::any_of(found.begin(), found.end(), [&](const auto& b) { return a.id == b.id; }) ? 1 : 0;
    }
    const std::string id = "place " + std::to_string(i * 37 % places);
    itself += std::any_of(found.begin(), found.end(), [&](const auto& b) { return b.id == id; }) ? 1 : 0;
  }
  state.counters["as_exact"] = same / (10.0 * kQueries);
  state.counters["place_at_10"] = itself / static_cast<double>(kQueries);
  state.counters["bytes_per_place"] = static_cast<double>(index.bytes_per_place());
}

/// All with aggregation of 700 features.
void BM_AskExact(benchmark::State& state) { ask(state, exact_index(static_cast<int>(state.range(0)))); }
void BM_AskGraph(benchmark::State& state) { ask(state, graph_index(static_cast<int>(state.range(0)))); }

/// With aggregation; without making the graph longer.
void BM_Add(benchmark::State& state) {
  auto index = matching::RetrievalIndex::create(vocabulary()).value();
  const features::FeatureSet set = place(1, 0);
  int count = 0;
  for (auto _ : state) benchmark::DoNotOptimize(index.add(std::to_string(count++), set));
}

void BM_Aggregate(benchmark::State& state) {
  const features::FeatureSet set = place(1, 0);
  for (auto _ : state) benchmark::DoNotOptimize(features::aggregate(set, vocabulary()));
}

/// Reading an index without a graph.
void BM_Read(benchmark::State& state) {
  const auto bytes = exact_index(static_cast<int>(state.range(0))).serialise();
  for (auto _ : state) benchmark::DoNotOptimize(matching::RetrievalIndex::deserialise(bytes, "bench"));
  state.counters["bytes"] = static_cast<double>(bytes.size());
}

/// Reading an index and making its graph.
void BM_ReadWithGraph(benchmark::State& state) {
  const auto bytes = bytes_with_graph(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(matching::RetrievalIndex::deserialise(bytes, "bench"));
  state.counters["bytes"] = static_cast<double>(bytes.size());
}

BENCHMARK(BM_Add)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_Aggregate)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_AskExact)->Arg(2'000)->Arg(10'000)->Arg(100'000)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_AskGraph)->Arg(2'000)->Arg(10'000)->Arg(100'000)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_Read)->Arg(10'000)->Arg(100'000)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_ReadWithGraph)->Arg(2'000)->Arg(10'000)->Arg(100'000)->Unit(benchmark::kMillisecond)->Iterations(1);

}  // namespace
