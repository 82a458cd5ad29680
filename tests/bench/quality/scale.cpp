// SPDX-License-Identifier: Apache-2.0
// How do time and memory of map building grow with the length of the tour? Buildings are strung together: each is the
// tour that is given, with features of its own. All of a build runs at full size but for looking at pictures, which is
// timed on the tour and counted for each image.
#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <iostream>
#include <opencv2/core.hpp>
#include <random>
#include <set>

#include "db/map_file.hpp"
#include "mapping/compare_all.hpp"
#include "mapping/map_builder.hpp"
#include "pipeline/learn_calibration.hpp"
#include "truth.hpp"

namespace homeward {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

std::vector<features::Appearance> look_at(const fs::path& folder, const camera::CameraConfig& config) {
  const auto eye = or_die(pipeline::Eye::create(config, usual_features(config)));
  std::vector<features::Appearance> tour;
  for (const auto& [file, pose] : read_poses(folder / "poses.csv")) {
    tour.push_back(or_die(eye.look(or_die(files::read_picture(folder / file)))));
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

/// Processor time of the program so far, all threads, seconds.
double processor_s() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

long peak_mib() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss / 1024;
}

/// Time of one stage, on the clock and of the processor.
struct Stage {
  double wall_s = 0.0;
  double cpu_s = 0.0;
};

class StageClock {
 public:
  Stage lap() {
    const Stage stage{seconds_since(wall_), processor_s() - cpu_s_};
    wall_ = Clock::now();
    cpu_s_ = processor_s();
    return stage;
  }

 private:
  Clock::time_point wall_ = Clock::now();
  double cpu_s_ = processor_s();
};

/// One line of progress now and then, for runs that take long.
class Teller {
 public:
  Teller(std::size_t images, std::string stage) : images_(images), stage_(std::move(stage)) {}
  void operator()(double share) {
    if (share - reported_ < 0.05) return;
    reported_ = share;
    std::cerr << images_ << " images, " << stage_ << ": " << std::lround(100.0 * share) << " %, "
              << std::lround(seconds_since(start_)) << " s, peak " << peak_mib() << " MiB\n";
  }

 private:
  std::size_t images_;
  std::string stage_;
  double reported_ = 0.0;
  Clock::time_point start_ = Clock::now();
};

struct Measured {
  std::size_t images = 0;
  double cpu_s = 0.0;
  double wall_s = 0.0;
};

/// One size of tour. `look`: what decoding and features take for one picture, on one thread; every picture of a real
/// tour costs it once.
Measured measure(const std::vector<features::Appearance>& tour, std::size_t images, int threads, bool only_candidates,
                 const Stage& look, const camera::CameraConfig& camera, const fs::path& file) {
  const auto appearances = strung_together(tour, images);
  const std::vector<int> tour_of(images, 0);
  StageClock clock;
  const auto candidates = or_die(mapping::first_candidates(appearances, tour_of, {}, 1, threads, {}));
  const Stage asked = clock.lap();
  std::size_t pairs = 0;
  for (const auto& list : candidates) pairs += list.size();
  std::cout << images << "," << pairs << "," << asked.wall_s << "," << asked.cpu_s;
  if (only_candidates) {
    std::cout << ",,,,,,,,,,,,," << peak_mib() << "\n" << std::flush;
    return {images, asked.cpu_s, asked.wall_s};
  }
  const mapping::PairTable table =
      or_die(mapping::compare_all(appearances, tour_of, {}, 1, threads, Teller(images, "compare"), {}));
  const Stage compared = clock.lap();
  std::size_t verified = 0;
  std::vector<map::MapImage> names;
  for (std::size_t i = 0; i < images; ++i) {
    verified += table.partners(static_cast<int>(i)).size();
    names.push_back({ImageId("tour/" + std::to_string(i)), std::nullopt, std::nullopt});
  }
  map::TopologicalMap map = mapping::make_map({names, tour_of, appearances, {}, &table}, {}, nullptr);
  const Stage made = clock.lap();
  map.camera = camera;
  map.calibration =
      or_die(pipeline::learn_calibration(map, appearances, tour_of, threads, Teller(images, "calibration"), {}));
  const Stage calibrated = clock.lap();
  if (const Status saved = db::save_map(file, map, {}); !saved) throw std::runtime_error(saved.error().message);
  const Stage saved = clock.lap();
  int mixed = 0;
  for (const map::Place& place : map.places) {
    std::set<std::size_t> buildings;
    for (const ImageId& image : place.members) buildings.insert(std::stoul(image.str().substr(5)) / tour.size());
    mixed += buildings.size() > 1 ? 1 : 0;
  }
  Measured all{images, look.cpu_s * static_cast<double>(images), look.wall_s * static_cast<double>(images) / threads};
  std::cout << "," << verified / 2;
  for (const Stage& stage : {compared, made, calibrated, saved}) {
    std::cout << "," << stage.wall_s << "," << stage.cpu_s;
    all.cpu_s += stage.cpu_s;
    all.wall_s += stage.wall_s;
  }
  std::cout << "," << all.wall_s << "," << all.cpu_s << "," << map.places.size() << "," << mixed << "," << peak_mib()
            << "\n"
            << std::flush;
  return all;
}

/// How time grows: the exponent b of a n^b that fits best, by least squares of the logarithms.
double exponent(const std::vector<Measured>& sizes, double Measured::*time) {
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (const Measured& one : sizes) {
    const double log_images = std::log(static_cast<double>(one.images));
    const double log_time = std::log(one.*time);
    n += 1.0;
    x += log_images;
    y += log_time;
    xx += log_images * log_images;
    xy += log_images * log_time;
  }
  return (n * xy - x * y) / (n * xx - x * x);
}

}  // namespace
}  // namespace homeward

int main(int argc, char** argv) {
  CLI::App program(
      "Time and memory of map building against the length of the tour, as CSV. Pictures of the tour that is given are "
      "looked at once; longer tours string its features together, in each repetition with numbers of the descriptors "
      "mirrored, so that a repetition is as like itself as the tour is and like no other");
  std::string folder;
  std::string file = (std::filesystem::temp_directory_path() / "homeward_bench_scale.hwmap").string();
  std::vector<std::size_t> sizes{300, 900, 2000, 6000, 20'000};
  int threads = 2;
  bool only_candidates = false;
  program.add_option("--tour", folder, "Tour with camera.json and poses.csv")->required();
  program.add_option("--sizes", sizes, "How many images, ascending: memory is the peak so far")->capture_default_str();
  program.add_option("--threads", threads, "How many threads")->check(CLI::Range(1, 256))->capture_default_str();
  program.add_flag("--only-candidates", only_candidates, "Only ask the index, the part that grows with the square");
  program.add_option("--map", file, "Where maps are written, each over the last one; removed in the end")
      ->capture_default_str();
  CLI11_PARSE(program, argc, argv);
  try {
    cv::setNumThreads(1);
    homeward::StageClock clock;
    const auto camera = homeward::or_die(homeward::files::read_camera(std::filesystem::path(folder) / "camera.json"));
    const auto tour = homeward::look_at(folder, camera);
    homeward::Stage look = clock.lap();
    look.wall_s /= static_cast<double>(tour.size());
    look.cpu_s /= static_cast<double>(tour.size());
    std::cerr << "features: " << 1e3 * look.cpu_s << " ms of processor time for a picture, " << homeward::peak_mib()
              << " MiB\n";
    std::cout << "images,first_pairs,candidates_s,candidates_cpu_s,verified,compare_s,compare_cpu_s,map_s,map_cpu_s,"
                 "calibration_s,calibration_cpu_s,save_s,save_cpu_s,all_s,all_cpu_s,places,places_of_two_buildings,"
                 "peak_mib\n";
    std::vector<homeward::Measured> measured;
    for (const std::size_t images : sizes) {
      measured.push_back(homeward::measure(tour, images, threads, only_candidates, look, camera, file));
    }
    if (measured.size() > 1) {
      std::cerr << "exponent of time " << homeward::exponent(measured, &homeward::Measured::wall_s)
                << ", of processor time " << homeward::exponent(measured, &homeward::Measured::cpu_s) << "\n";
    }
    std::filesystem::remove(file);
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
  return 0;
}
