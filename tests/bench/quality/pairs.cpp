// SPDX-License-Identifier: Apache-2.0
// What geometric verification says of pairs of pictures whose true directions are known: a CSV line for each pair that
// it answers, for fitting the confidence (confidence.py) and for looking at what goes wrong.
#include <CLI/CLI.hpp>
#include <chrono>
#include <fstream>
#include <iostream>
#include <map>

#include "agent/files/csv.hpp"
#include "agent/files/read_file.hpp"
#include "core/angles.hpp"
#include "matching/confidence.hpp"
#include "matching/match_odds.hpp"
#include "matching/verify.hpp"
#include "pipeline/eye.hpp"

namespace homeward {
namespace {

namespace fs = std::filesystem;

/// A pair with its truth and its matches: all that verification needs, without the pictures.
struct Pair {
  std::string current;
  std::string target;
  bool same = true;
  double distance_m = 0.0;  // 0: not known
  double bearing_rad = 0.0;
  std::vector<matching::Match> matches;
  std::vector<geometry::Correspondence> correspondences;  // of the matches
};

template <typename T>
T or_die(Result<T> result) {
  if (!result) throw std::runtime_error(result.error().where + ": " + result.error().message);
  return std::move(*result);
}

class Pictures {
 public:
  explicit Pictures(const fs::path& camera_file) {
    const camera::CameraConfig config = or_die(agent::read_camera(camera_file));
    eye_.emplace(or_die(
        pipeline::Eye::create(config, pipeline::suited_feature_config(*or_die(camera::Camera::create(config))))));
  }

  const features::Appearance& operator()(const fs::path& file) {
    const auto known = seen_.find(file);
    if (known != seen_.end()) return known->second;
    return seen_.emplace(file, or_die(eye_->look(or_die(agent::read_picture(file))))).first->second;
  }

 private:
  std::optional<pipeline::Eye> eye_;
  std::map<fs::path, features::Appearance> seen_;
};

struct Pose {
  double x_m, y_m, theta_rad;
};

std::map<std::string, Pose> read_poses(const fs::path& file) {
  const agent::CsvTable table = or_die(agent::read_csv(file));
  std::map<std::string, Pose> poses;
  const auto at = [&](const char* name) { return table.column(name).value(); };
  for (const auto& row : table.rows) {
    poses[row[at("filename")]] = {std::stod(row[at("x_m")]), std::stod(row[at("y_m")]),
                                  std::stod(row[at("theta_rad")])};
  }
  return poses;
}

/// Pairs of a table; a row with same=0, or, with poses, one whose pictures are further than `same_m` apart, is of
/// different places.
std::vector<Pair> read_pairs(const fs::path& camera, const fs::path& list, const fs::path& poses_file, double same_m) {
  Pictures pictures(camera);
  const agent::CsvTable table = or_die(agent::read_csv(list));
  const std::map<std::string, Pose> poses = poses_file.empty() ? std::map<std::string, Pose>{} : read_poses(poses_file);
  std::vector<Pair> pairs;
  for (const auto& row : table.rows) {
    Pair pair;
    pair.current = row[table.column("current").value()];
    pair.target = row[table.column("target").value()];
    const auto same = table.column("same");
    pair.same = !same || row[*same] != "0";
    if (!poses.empty()) {
      const Pose& here = poses.at(pair.current);
      const Pose& there = poses.at(pair.target);
      pair.distance_m = std::hypot(there.x_m - here.x_m, there.y_m - here.y_m);
      pair.bearing_rad = wrap_angle(std::atan2(there.y_m - here.y_m, there.x_m - here.x_m) - here.theta_rad);
      if (pair.distance_m < 0.05) continue;
      if (pair.distance_m > same_m) pair.same = false;
    } else if (pair.same) {
      pair.bearing_rad = std::stod(row[table.column("bearing_rad").value()]);
    }
    const features::Appearance& current = pictures(list.parent_path() / pair.current);
    const features::Appearance& target = pictures(list.parent_path() / pair.target);
    pair.matches = matching::match_both_kinds(current, target, {}, {});
    pair.correspondences = matching::correspondences(current, target, pair.matches);
    pairs.push_back(std::move(pair));
  }
  return pairs;
}

void save(const std::vector<Pair>& pairs, const fs::path& file) {
  std::ofstream out(file);
  out.precision(9);
  for (const Pair& pair : pairs) {
    out << pair.current << ' ' << pair.target << ' ' << pair.same << ' ' << pair.distance_m << ' ' << pair.bearing_rad
        << ' ' << pair.correspondences.size() << '\n';
    for (std::size_t i = 0; i < pair.correspondences.size(); ++i) {
      const geometry::Correspondence& c = pair.correspondences[i];
      out << c.current.transpose() << ' ' << c.target.transpose() << ' ' << c.log_scale_ratio << ' '
          << static_cast<int>(pair.matches[i].kind) << ' ' << pair.matches[i].ratio << '\n';
    }
  }
}

std::vector<Pair> load(const fs::path& file) {
  std::ifstream in(file);
  std::vector<Pair> pairs;
  Pair pair;
  std::size_t count = 0;
  while (in >> pair.current >> pair.target >> pair.same >> pair.distance_m >> pair.bearing_rad >> count) {
    pair.correspondences.resize(count);
    pair.matches.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      geometry::Correspondence& c = pair.correspondences[i];
      int kind = 0;
      in >> c.current.x() >> c.current.y() >> c.current.z() >> c.target.x() >> c.target.y() >> c.target.z() >>
          c.log_scale_ratio >> kind >> pair.matches[i].ratio;
      pair.matches[i].kind = static_cast<matching::FeatureKind>(kind);
      c.odds = matching::odds_of(pair.matches[i]);
    }
    pairs.push_back(pair);
  }
  return pairs;
}

void report(const std::vector<Pair>& pairs, const std::string& name, bool general, std::uint64_t seed) {
  for (const Pair& pair : pairs) {
    const auto begin = std::chrono::steady_clock::now();
    const auto estimate = general ? geometry::estimate_motion(pair.correspondences, {}, seed)
                                  : geometry::estimate_planar_motion(pair.correspondences, {}, seed);
    const double ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
    std::cout << name << ',' << pair.current << ',' << pair.target << ',' << pair.same << ',' << pair.distance_m << ','
              << pair.correspondences.size() << ',' << ms;
    const matching::VerifyConfig config;
    if (estimate) {
      const matching::ConfidenceSigns signs = matching::signs_of(*estimate, pair.matches, pair.correspondences);
      const bool answered =
          static_cast<int>(estimate->inliers.size()) >= config.min_inliers && estimate->evidence >= config.min_evidence;
      const double error_deg = degrees(wrap_angle(estimate->motion.direction_rad - pair.bearing_rad));
      std::cout << ',' << std::abs(error_deg) << ',' << estimate->inliers.size() << ',' << estimate->forward_share
                << ',' << degrees(estimate->direction_spread_rad) << ',' << estimate->error_spread_rad << ','
                << degrees(estimate->tilt_rad) << ',' << estimate->evidence << ',' << estimate->lead << ','
                << estimate->sign_log_odds << ',' << degrees(estimate->median_parallax_rad) << ',' << signs.around
                << ',' << signs.disagreeing << ',' << estimate->height << ',' << estimate->agreeing << ','
                << matching::confidence(signs) << ',' << answered;
    } else {
      std::cout << ",,0,,,,,,,,,,,,,0,0";
    }
    std::cout << '\n';
  }
}

}  // namespace
}  // namespace homeward

int main(int argc, char** argv) {
  CLI::App program("What geometric verification says of pairs of pictures with known directions, as CSV");
  std::string camera;
  std::string list;
  std::string poses;
  std::string name = "pairs";
  std::string saved;
  std::string loaded;
  double same_m = 12.0;
  bool general = false;
  std::uint64_t seed = 1;
  program.add_option("--camera", camera, "camera.json");
  program.add_option("--pairs", list, "Table with columns current, target and, without poses, bearing_rad and same");
  program.add_option("--poses", poses, "Table with columns filename, x_m, y_m, theta_rad");
  program.add_option("--same-m", same_m, "Pictures further apart than this are of different places");
  program.add_option("--name", name, "First column of every line");
  program.add_option("--save", saved, "Keep the matches of all pairs in this file");
  program.add_option("--load", loaded, "Take the matches from such a file instead of pictures");
  program.add_option("--seed", seed, "Seed of the estimate");
  program.add_flag("--general", general, "Look for a general motion where the planar one is weak");
  CLI11_PARSE(program, argc, argv);
  try {
    const auto pairs = loaded.empty() ? homeward::read_pairs(camera, list, poses, same_m) : homeward::load(loaded);
    if (!saved.empty()) homeward::save(pairs, saved);
    std::cout
        << "set,current,target,same,distance_m,matches,ms,error_deg,inliers,forward_share,spread_deg,"
           "error_spread_rad,tilt_deg,evidence,lead,sign,parallax_deg,around,disagreeing,height,agreeing,confidence,"
           "answered\n";
    homeward::report(pairs, name, general, seed);
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
  return 0;
}
