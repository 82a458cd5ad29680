// SPDX-License-Identifier: Apache-2.0
// Is a drawn plan a witness for the belief? Drives through a building whose map lies on a plan: the belief as it is,
// and as it is told where particles on the plan have a word in it. Counted are confident beliefs (at least 0.9): wrong
// ones, wrong ones that are told as confident all the same, right ones, and right ones from which confidence is taken.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <iostream>
#include <limits>
#include <random>
#include <string_view>

#include "core/pose2.hpp"
#include "db/map_file.hpp"
#include "linemodel/read_plan.hpp"
#include "localisation/localiser.hpp"
#include "map/metric_layout.hpp"
#include "map/plan_tie.hpp"
#include "mapping/parallel.hpp"
#include "matching/visual_distance.hpp"
#include "pipeline/plan_witness.hpp"
#include "walk.hpp"

namespace homeward {
namespace {

namespace fs = std::filesystem;

/// How a drive begins and goes on.
constexpr std::array<std::string_view, 5> kKinds{
    "said",       // somebody says at which place it begins
    "forgetful",  // the same, but the belief begins anew every few pictures, without a word
    "carried",    // the same as said, but half way the robot is carried elsewhere, which odometry does not notice
    "twin",       // the same, to where it looks most like where it was
    "anywhere"};  // nobody says anything

struct Options {
  fs::path map;
  fs::path poses;
  fs::path plan;
  std::vector<fs::path> walks;
  std::vector<std::string> kinds{kKinds.begin(), kKinds.end()};
  int drives = 10;
  int pictures = 60;
  int forget_every = 10;
  int pins = 8;
  double pin_spread_m = 0.2;
  int threads = 2;
  std::uint64_t seed = 1;
  bool list = false;
};

/// The map, its plan, where it lies on it by pins that are somewhat off, and where its places truly are.
struct Building {
  std::shared_ptr<const map::TopologicalMap> map;
  linemodel::Plan plan;
  map::MapOnPlan tie;
  std::map<PlaceId, Pose2> truth;

  [[nodiscard]] PlaceId nearest(const Pose2& robot) const {
    return std::ranges::min_element(truth, {}, [&](const auto& place) { return apart_m(place.second, robot); })->first;
  }
  /// As other judges of beliefs have it: not near is farther than 2.5 m, and farther than the nearest place by 1 m.
  [[nodiscard]] bool near(const PlaceId& place, const Pose2& robot) const {
    return apart_m(truth.at(place), robot) <= std::max(2.5, apart_m(truth.at(nearest(robot)), robot) + 1.0);
  }
};

Building building_of(const Options& options) {
  Building building;
  building.map = std::make_shared<const map::TopologicalMap>(or_die(db::load_map(options.map)).map);
  const std::string plan = or_die(files::read_text(options.plan));
  building.plan = or_die(linemodel::read_plan(plan, "wrl", {}, options.plan.string()));
  const auto poses = read_poses(options.poses);
  for (const map::Place& place : building.map->places) {
    building.truth.emplace(place.id, pose2_of(poses.at(file_of(place.prototype))));
  }
  std::mt19937_64 random(options.seed);
  std::normal_distribution<double> off_m(0.0, options.pin_spread_m);
  std::vector<map::PlanPin> pins;
  for (int i = 0; i < options.pins; ++i) {
    const std::size_t at =
        static_cast<std::size_t>(i) * building.map->places.size() / static_cast<std::size_t>(options.pins);
    const map::Place& place = building.map->places[at];
    const double x_off_m = off_m(random);
    pins.push_back(
        {place.prototype, position_m(building.truth.at(place.id)) + Eigen::Vector2d(x_off_m, off_m(random)), {}});
  }
  building.tie = map::lay_on_plan(*building.map, map::metric_layout(*building.map), pins);
  return building;
}

/// Pictures of a walk in the order in which a drive sees them; from `carried` on it is elsewhere.
struct Drive {
  std::string kind;
  std::vector<std::size_t> pictures;
  std::size_t carried = 0;  // 0: never
  std::uint64_t seed = 1;
};

/// Where a walk looks most like picture `here`, farther than a room away, with so many pictures to come.
std::size_t twin_of(const Walk& walk, std::size_t here, std::size_t to_come) {
  constexpr double kElsewhere_m = 4.0;
  std::size_t twin = 0;
  int most = -1;
  for (std::size_t i = 0; i + to_come < walk.truth.size(); ++i) {
    if (apart_m(walk.truth[i], walk.truth[here]) < kElsewhere_m) continue;
    const int verified = matching::compare(walk.seen[here], walk.seen[i], {}, 1).verified;
    if (verified <= most) continue;
    most = verified;
    twin = i;
  }
  return twin;
}

std::vector<Drive> drives_of(const Options& options, const std::string& kind, const Walk& walk) {
  std::mt19937_64 random(options.seed);
  const auto count = static_cast<std::size_t>(options.pictures);
  std::vector<Drive> drives;
  for (int d = 0; d < options.drives; ++d) {
    Drive drive{kind, {}, 0, static_cast<std::uint64_t>(d + 1)};
    const std::size_t first = random() % (walk.truth.size() - count);
    const std::size_t other = random() % (walk.truth.size() - count);
    for (std::size_t k = 0; k < count; ++k) drive.pictures.push_back(first + k);
    if (kind == "carried" || kind == "twin") {
      drive.carried = count / 2;
      const std::size_t from =
          kind == "twin" ? twin_of(walk, drive.pictures[drive.carried - 1], count - drive.carried) : other;
      for (std::size_t k = drive.carried; k < count; ++k) drive.pictures[k] = from + k - drive.carried;
    }
    drives.push_back(std::move(drive));
  }
  return drives;
}

struct Figures {
  int beliefs = 0;
  int wrong = 0;       // confident
  int wrong_told = 0;  // of these, told as confident
  int right = 0;
  int right_lost = 0;
  int spoken = 0;  // of confident ones, those on which the witness had a word
  std::string list;

  void add(const Figures& other) {
    beliefs += other.beliefs;
    wrong += other.wrong;
    wrong_told += other.wrong_told;
    right += other.right;
    right_lost += other.right_lost;
    spoken += other.spoken;
    list += other.list;
  }
};

class Trial {
 public:
  Trial(const Options& options, const Building& building, const Walk& walk)
      : options_(options), building_(building), walk_(walk), fresh_(building.map, {}) {}

  [[nodiscard]] Figures run(const Drive& drive) const {
    localisation::Localiser localiser = fresh_.another();
    pipeline::PlanWitnessConfig config;
    config.tracker.monte_carlo.seed = drive.seed;
    auto witness =
        or_die(pipeline::PlanWitness::create(building_.plan, building_.map->camera, building_.tie.places, config));
    if (drive.kind != "anywhere") {
      const std::vector<PlaceId> said{building_.nearest(walk_.truth[drive.pictures.front()])};
      localiser.start_at(said);
      witness.start_at(said);
    }
    Figures figures;
    Pose2 odometry;
    for (std::size_t k = 0; k < drive.pictures.size(); ++k) {
      const std::size_t i = drive.pictures[k];
      if (k > 0 && (drive.carried == 0 || k != drive.carried)) {
        odometry = odometry * (inverse(walk_.odometry[drive.pictures[k - 1]].value()) * walk_.odometry[i].value());
      }
      if (drive.kind == "forgetful" && k > 0 && k % static_cast<std::size_t>(options_.forget_every) == 0) {
        localiser.restart();
      }
      const localisation::Belief belief = localiser.update(walk_.seen[i], odometry);
      const linemodel::PlanEstimate estimate = or_die(witness.update(walk_.pictures[i], odometry));
      count(figures, drive, k, belief, witness, estimate);
    }
    return figures;
  }

 private:
  void count(Figures& figures, const Drive& drive, std::size_t k, const localisation::Belief& belief,
             pipeline::PlanWitness& witness, const linemodel::PlanEstimate& estimate) const {
    constexpr double kConfident = 0.9;
    const auto confident = [](const localisation::Belief& one) {
      return !one.lost && one.near_probability >= kConfident;
    };
    const pipeline::PlanWord word = witness.hear(belief);
    const Pose2& truth = walk_.truth[drive.pictures[k]];
    const bool right = building_.near(belief.top.front().place, truth);
    const bool sure = confident(belief);
    const bool told = confident(witness.told(belief, word));
    ++figures.beliefs;
    if (sure) (right ? figures.right : figures.wrong) += 1;
    if (sure && word != pipeline::PlanWord::kSilent) ++figures.spoken;
    if (sure && right && !told) ++figures.right_lost;
    if (told && !right) ++figures.wrong_told;
    if (!options_.list) return;
    std::array<char, 200> line{};
    std::snprintf(line.data(), line.size(), "#,%s,%s,%d,%zu,%d,%d,%d,%.2f,%.2f,%d,%.2f,%.2f,%d,%.3f,%.2f\n",
                  drive.kind.c_str(), walk_.name.c_str(), static_cast<int>(drive.seed), k, sure ? 1 : 0, right ? 1 : 0,
                  told ? 1 : 0, apart_m(building_.truth.at(belief.top.front().place), truth),
                  apart_m(estimate.pose, truth), static_cast<int>(estimate.lost), estimate.log_odds, estimate.spread_m,
                  witness.trusted() ? 1 : 0,
                  witness.odds_against_place().value_or(std::numeric_limits<double>::quiet_NaN()), estimate.explained);
    figures.list += line.data();
  }

  const Options& options_;
  const Building& building_;
  const Walk& walk_;
  localisation::Localiser fresh_;
};

void measure(const Options& options) {
  const Building building = building_of(options);
  std::cout << "# " << building.map->places.size() << " places, " << building.tie.places.size()
            << " on the plan, pins off by " << building.tie.rms_m.value_or(0.0) << " m\n";
  std::cout << "kind,walk,drives,beliefs,wrong,wrong_told,right,right_lost,spoken" << std::endl;
  for (const fs::path& folder : options.walks) {
    const Walk walk = see(folder, *building.map, options.threads, true);
    const Trial trial(options, building, walk);
    for (const std::string& kind : options.kinds) {
      const std::vector<Drive> drives = drives_of(options, kind, walk);
      std::vector<Figures> figures(drives.size());
      const auto run = [&](std::size_t d) { figures[d] = trial.run(drives[d]); };
      mapping::parallel_for(drives.size(), options.threads, run, [](std::size_t) {}, {});
      Figures all;
      for (const Figures& one : figures) all.add(one);
      std::cout << all.list << kind << "," << walk.name << "," << drives.size() << "," << all.beliefs << ","
                << all.wrong << "," << all.wrong_told << "," << all.right << "," << all.right_lost << "," << all.spoken
                << std::endl;
    }
  }
}

}  // namespace
}  // namespace homeward

int main(int argc, char** argv) {
  homeward::Options options;
  CLI::App program("Whether a drawn plan is a witness for the belief");
  program.add_option("--map", options.map, "Map file")->required();
  program.add_option("--poses", options.poses, "poses.csv of the map's tour")->required();
  program.add_option("--plan", options.plan, "Plan of the same world, a .wrl in its frame")->required();
  program.add_option("--walk", options.walks, "Folders of pictures with poses.csv and odometry.csv")->required();
  program.add_option("--kinds", options.kinds, "Kinds of drives")
      ->check(CLI::IsMember(std::vector<std::string>(homeward::kKinds.begin(), homeward::kKinds.end())));
  program.add_option("--drives", options.drives, "Of each kind, on each walk");
  program.add_option("--pictures", options.pictures, "Of each drive");
  program.add_option("--threads", options.threads, "Threads");
  program.add_option("--seed", options.seed, "Of pins and drives");
  program.add_flag(
      "--list", options.list,
      "A line for each belief too: kind, walk, drive, picture, confident, right, told as confident, metres "
      "that place and plan are off, lost, log odds, spread (m), trusted, odds against the place, explained");
  CLI11_PARSE(program, argc, argv);
  try {
    homeward::measure(options);
  } catch (const std::exception& failure) {
    std::cerr << failure.what() << "\n";
    return 1;
  }
  return 0;
}
