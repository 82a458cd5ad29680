// SPDX-License-Identifier: Apache-2.0
// Matching of two sets of features.
#include <benchmark/benchmark.h>

#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>
#include <random>

#include "matching/match.hpp"

namespace {

using namespace homeward;  // NOLINT(google-build-using-namespace): a benchmark's own file

/// Descriptors as different as random ones, half of them the other set's with noise.
features::FeatureSet features_of(int count, int length, std::uint64_t noise_seed) {
  std::mt19937_64 same(1);
  std::mt19937_64 noise(noise_seed);
  features::FeatureSet set;
  set.bearings.setZero(count, 3);
  set.scales_rad.setZero(count);
  set.colours.setZero(count, 3);
  set.descriptors.resize(count, length);
  for (int i = 0; i < count; ++i) {
    for (int d = 0; d < length; ++d) {
      const auto value = static_cast<int>(same() % 200);
      const auto other = static_cast<int>(noise() % 200);
      set.descriptors(i, d) = static_cast<std::uint8_t>(i % 2 == 0 ? value + other / 20 : other);
    }
  }
  return set;
}

void BM_Match(benchmark::State& state) {
  const auto count = static_cast<int>(state.range(0));
  const auto length = static_cast<int>(state.range(1));
  const auto current = features_of(count, length, 2);
  const auto target = features_of(count, length, 3);
  std::size_t found = 0;
  for (auto _ : state) found = matching::match(current, target, {}).size();
  state.counters["matches"] = static_cast<double>(found);
}

void BM_OpenCvBruteForce(benchmark::State& state) {
  cv::Mat current(300, 128, CV_8U);
  cv::Mat target(300, 128, CV_8U);
  cv::RNG random(1);
  random.fill(current, cv::RNG::UNIFORM, 0, 256);
  random.fill(target, cv::RNG::UNIFORM, 0, 256);
  const auto matcher = cv::BFMatcher::create(cv::NORM_L2, true);
  std::vector<cv::DMatch> matches;
  for (auto _ : state) matcher->match(current, target, matches);
}

BENCHMARK(BM_Match)->Args({300, 32})->Args({300, 48})->Args({300, 128})->Args({600, 32})->Unit(benchmark::kMillisecond);
BENCHMARK(BM_OpenCvBruteForce)->Unit(benchmark::kMillisecond);

}  // namespace
