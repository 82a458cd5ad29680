// SPDX-License-Identifier: Apache-2.0
// How do time and memory of map building grow with the length of the tour? Buildings are strung together: each is the
// tour that is given, with features of its own.
#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <iostream>
#include <random>
#include <set>

#include "mapping/compare_all.hpp"
#include "mapping/map_builder.hpp"
#include "truth.hpp"

namespace homeward {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

std::vector<features::Appearance> look_at(const fs::path& folder) {
  const camera::CameraConfig config = or_die(agent::read_camera(folder / "camera.json"));
  const auto eye = or_die(pipeline::Eye::create(config, usual_features(config)));
  std::vector<features::Appearance> tour;
  for (const auto& [file, pose] : read_poses(folder / "poses.csv")) {
    tour.push_back(or_die(eye.look(or_die(agent::read_picture(folder / file)))));
  }
  return tour;
}

/// Numbers of a descriptor mirrored about their middle, the same ones in each feature of one building: within a
/// building nothing changes, between two of them features no longer look alike.
void mirror(features::FeatureSet& set, std::mt19937 random) {
  for (Eigen::Index number = 0; number < set.descriptors.cols(); ++number) {
    if (random() % 2 == 0) continue;
    for (Eigen::Index i = 0; i < set.descriptors.rows(); ++i) {
      set.descriptors(i, number) = static_cast<std::uint8_t>(std::min(255, 256 - set.descriptors(i, number)));
    }
  }
}

std::vector<features::Appearance> strung_together(const std::vector<features::Appearance>& tour, std::size_t images) {
  std::vector<features::Appearance> all;
  for (std::size_t i = 0; i < images; ++i) {
    all.push_back(tour[i % tour.size()]);
    const auto building = static_cast<unsigned>(i / tour.size());
    if (building == 0) continue;
    mirror(all.back().sift, std::mt19937(building));
    mirror(all.back().columns, std::mt19937(building + 1'000'000));
  }
  return all;
}

void measure(const std::vector<features::Appearance>& tour, std::size_t images, int threads, bool only_candidates) {
  const auto appearances = strung_together(tour, images);
  const std::vector<int> tour_of(images, 0);
  const auto start = Clock::now();
  const auto candidates = or_die(mapping::first_candidates(appearances, tour_of, {}, 1, threads, {}));
  const double candidates_s = seconds_since(start);
  std::size_t pairs = 0;
  for (const auto& list : candidates) pairs += list.size();
  std::cout << images << "," << pairs << "," << candidates_s;
  if (!only_candidates) {
    const auto begin = Clock::now();
    const mapping::PairTable table = or_die(mapping::compare_all(appearances, tour_of, {}, 1, threads, {}, {}));
    const double compare_s = seconds_since(begin);
    std::size_t verified = 0;
    std::vector<map::MapImage> names;
    for (std::size_t i = 0; i < images; ++i) {
      verified += table.partners(static_cast<int>(i)).size();
      names.push_back({ImageId("tour/" + std::to_string(i)), std::nullopt, std::nullopt});
    }
    const auto compared = Clock::now();
    const map::TopologicalMap map = mapping::make_map({names, tour_of, appearances, {}, &table}, {}, nullptr);
    const double map_s = seconds_since(compared);
    int mixed = 0;
    for (const map::Place& place : map.places) {
      std::set<std::size_t> buildings;
      for (const ImageId& image : place.members) buildings.insert(std::stoul(image.str().substr(5)) / tour.size());
      mixed += buildings.size() > 1 ? 1 : 0;
    }
    std::cout << "," << verified / 2 << "," << compare_s << "," << map_s << "," << map.places.size() << "," << mixed;
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  std::cout << (only_candidates ? ",,,,," : "") << "," << usage.ru_maxrss / 1024 << "\n" << std::flush;
}

}  // namespace
}  // namespace homeward

int main(int argc, char** argv) {
  CLI::App program("Time and memory of map building against the length of the tour, as CSV");
  std::string folder;
  std::vector<std::size_t> sizes{300, 600, 1200};
  int threads = 2;
  bool only_candidates = false;
  program.add_option("--tour", folder, "Tour with camera.json and poses.csv")->required();
  program.add_option("--sizes", sizes, "How many images, ascending");
  program.add_option("--threads", threads, "How many threads");
  program.add_flag("--only-candidates", only_candidates, "Only ask the index, the part that grows with the square");
  CLI11_PARSE(program, argc, argv);
  try {
    const auto tour = homeward::look_at(folder);
    std::cout << "images,first_pairs,candidates_s,verified,compare_s,map_s,places,places_of_two_buildings,peak_mib\n";
    for (const std::size_t images : sizes) homeward::measure(tour, images, threads, only_candidates);
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
  return 0;
}
