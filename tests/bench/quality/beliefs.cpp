// SPDX-License-Identifier: Apache-2.0
// What is odometry worth to a belief? Walks with true poses through a map, localised from a uniform start at many of
// their pictures, once with the walk's odometry and once without, as CSV. With pictures left out between, the way from
// one to the next grows: that is a robot that drives fast, or a server that has little time for it.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <iostream>

#include "db/map_file.hpp"
#include "localisation/localiser.hpp"
#include "mapping/parallel.hpp"
#include "walk.hpp"

namespace homeward {
namespace {

namespace fs = std::filesystem;

/// Where prototypes were taken. As the developers' judge of beliefs counts: near is the closest prototype, one within
/// 1 m of being it, or one within 2.5 m; a lost belief is near nothing.
class Judge {
 public:
  Judge(const map::TopologicalMap& map, const fs::path& poses_file) {
    const auto poses = read_poses(poses_file);
    for (const map::Place& place : map.places)
      prototypes_.emplace(place.id, pose2_of(poses.at(file_of(place.prototype))));
  }
  [[nodiscard]] double closest_m(const Pose2& truth) const {
    double least_m = std::numeric_limits<double>::infinity();
    for (const auto& [place, pose] : prototypes_) least_m = std::min(least_m, apart_m(pose, truth));
    return least_m;
  }
  [[nodiscard]] bool exact(const localisation::Belief& belief, const Pose2& truth) const {
    return apart_m(prototypes_.at(belief.top.front().place), truth) <= closest_m(truth);
  }
  [[nodiscard]] bool near(const localisation::Belief& belief, const Pose2& truth) const {
    constexpr double kNear_m = 2.5;
    const double found_m = apart_m(prototypes_.at(belief.top.front().place), truth);
    return !belief.lost && found_m <= std::max(kNear_m, closest_m(truth) + 1.0);
  }

 private:
  std::map<PlaceId, Pose2> prototypes_;
};

struct Figures {
  int count = 0;
  int near = 0;
  int exact = 0;
  int lost = 0;
  int sure_and_wrong = 0;
  struct Bin {
    int count = 0;
    int near = 0;
    double stated = 0.0;
  };
  std::array<Bin, 10> bins;

  void add(const localisation::Belief& belief, bool is_near, bool is_exact) {
    ++count;
    near += is_near ? 1 : 0;
    exact += is_exact ? 1 : 0;
    lost += belief.lost ? 1 : 0;
    sure_and_wrong += !is_near && belief.near_probability > 0.9 ? 1 : 0;
    Bin& bin = bins[std::min<std::size_t>(bins.size() - 1, static_cast<std::size_t>(belief.near_probability * 10.0))];
    ++bin.count;
    bin.near += is_near ? 1 : 0;
    bin.stated += belief.near_probability;
  }
  [[nodiscard]] double calibration_error() const {
    double sum = 0.0;
    for (const Bin& bin : bins) sum += std::abs(bin.stated - bin.near);
    return sum / count;
  }
};

struct Options {
  fs::path map;
  fs::path poses;
  std::vector<fs::path> walks;
  std::vector<int> every{1, 4, 8};
  int updates = 6;
  int starts = 2;
  int threads = 2;
};

/// The figures after each update.
std::vector<Figures> localise(const localisation::Localiser& fresh, const Walk& walk, const Judge& judge,
                              const Options& options, int every, bool with_odometry) {
  std::vector<Figures> after(static_cast<std::size_t>(options.updates));
  const auto reach = static_cast<std::size_t>(every * (options.updates - 1));
  if (walk.seen.size() <= reach) return after;
  std::vector<std::size_t> starts;
  for (std::size_t i = 0; i + reach < walk.seen.size(); i += static_cast<std::size_t>(options.starts)) {
    starts.push_back(i);
  }
  std::vector<std::vector<localisation::Belief>> beliefs(starts.size());
  const auto drive = [&](std::size_t s) {
    localisation::Localiser localiser = fresh.another();
    for (int u = 0; u < options.updates; ++u) {
      const std::size_t i = starts[s] + static_cast<std::size_t>(u * every);
      beliefs[s].push_back(localiser.update(walk.seen[i], with_odometry ? walk.odometry[i] : std::nullopt));
    }
  };
  mapping::parallel_for(starts.size(), options.threads, drive, [](std::size_t) {}, {});
  for (std::size_t s = 0; s < starts.size(); ++s) {
    for (std::size_t u = 0; u < after.size(); ++u) {
      const Pose2& truth = walk.truth[starts[s] + u * static_cast<std::size_t>(every)];
      after[u].add(beliefs[s][u], judge.near(beliefs[s][u], truth), judge.exact(beliefs[s][u], truth));
    }
  }
  return after;
}

void measure(const Options& options) {
  const auto map = std::make_shared<const map::TopologicalMap>(or_die(db::load_map(options.map)).map);
  const Judge judge(*map, options.poses);
  const localisation::Localiser localiser(map, {});
  std::cout << "walk,every,odometry,update,beliefs,near,exact,lost,sure_and_wrong,calibration_error\n";
  for (const fs::path& folder : options.walks) {
    const Walk walk = see(folder, *map, options.threads, false);
    for (const int every : options.every) {
      for (const bool with_odometry : {false, true}) {
        const std::vector<Figures> after = localise(localiser, walk, judge, options, every, with_odometry);
        for (std::size_t u = 0; u < after.size(); ++u) {
          const Figures& of = after[u];
          if (of.count == 0) continue;
          const auto share = [&](int part) { return static_cast<double>(part) / of.count; };
          std::cout << folder.filename().string() << "," << every << "," << (with_odometry ? "yes" : "no") << ","
                    << u + 1 << "," << of.count << "," << share(of.near) << "," << share(of.exact) << ","
                    << share(of.lost) << "," << of.sure_and_wrong << "," << of.calibration_error() << std::endl;
        }
      }
    }
  }
}

}  // namespace
}  // namespace homeward

int main(int argc, char** argv) {
  homeward::Options options;
  CLI::App program("What odometry is worth to a belief");
  program.add_option("--map", options.map, "Map file")->required();
  program.add_option("--poses", options.poses, "poses.csv of the map's tour")->required();
  program.add_option("--walk", options.walks, "Folders of pictures with poses.csv and odometry.csv")->required();
  program.add_option("--every", options.every, "Take each picture, each fourth, ...");
  program.add_option("--updates", options.updates, "Pictures from each start");
  program.add_option("--starts", options.starts, "Start at every so many pictures");
  program.add_option("--threads", options.threads, "Threads");
  CLI11_PARSE(program, argc, argv);
  try {
    homeward::measure(options);
  } catch (const std::exception& failure) {
    std::cerr << failure.what() << "\n";
    return 1;
  }
  return 0;
}
