// SPDX-License-Identifier: Apache-2.0
// What geometric verification says of pairs of pictures whose true directions are known: a CSV line for each pair that
// it answers, for fitting the confidence (confidence.py) and for looking at what goes wrong.
#include <CLI/CLI.hpp>
#include <chrono>
#include <fstream>
#include <iostream>
#include <map>

#include "matching/confidence.hpp"
#include "matching/match_odds.hpp"
#include "matching/verify.hpp"
#include "truth.hpp"

namespace homeward {
namespace {

namespace fs = std::filesystem;

/// A pair with its truth and its matches: all that verification needs, without the pictures.
struct Pair : KnownPair {
  std::vector<matching::Match> matches;
  std::vector<geometry::Correspondence> correspondences;  // of the matches
};

class Pictures {
 public:
  explicit Pictures(const fs::path& camera_file) {
    const camera::CameraConfig config = or_die(files::read_camera(camera_file));
    eye_.emplace(or_die(pipeline::Eye::create(config, usual_features(config))));
  }

  const features::Appearance& operator()(const fs::path& file) {
    const auto known = seen_.find(file);
    if (known != seen_.end()) return known->second;
    return seen_.emplace(file, or_die(eye_->look(or_die(files::read_picture(file))))).first->second;
  }

 private:
  std::optional<pipeline::Eye> eye_;
  std::map<fs::path, features::Appearance> seen_;
};

std::vector<Pair> match_pairs(const fs::path& camera, const fs::path& list, const fs::path& poses, double same_m) {
  Pictures pictures(camera);
  std::vector<Pair> pairs;
  for (KnownPair& known : read_pairs(list, poses, same_m)) {
    const features::Appearance& current = pictures(list.parent_path() / known.current);
    const features::Appearance& target = pictures(list.parent_path() / known.target);
    auto matches = matching::match_both_kinds(current, target, {}, {});
    auto correspondences = matching::correspondences(current, target, matches);
    pairs.push_back({std::move(known), std::move(matches), std::move(correspondences)});
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
    const auto pairs = loaded.empty() ? homeward::match_pairs(camera, list, poses, same_m) : homeward::load(loaded);
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
