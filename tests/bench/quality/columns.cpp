// SPDX-License-Identifier: Apache-2.0
// homeward_bench_columns CAMERA PAIRS MODE [MAX_COLUMNS [MAX_SIFT]]: what invariant column segments give on pairs of
// pictures whose motion is known. PAIRS has no header; each line is group,current,target,bearing_rad,turn_rad (nan:
// turn not known). MODE: time, spread, right or home.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <map>
#include <numeric>
#include <sstream>
#include <string>
#include <vector>

#include "core/angles.hpp"
#include "features/columns.hpp"
#include "features/extract.hpp"
#include "files/read_file.hpp"
#include "geometry/planar_motion.hpp"
#include "geometry/planar_solver.hpp"
#include "matching/match.hpp"
#include "matching/match_columns.hpp"
#include "pipeline/eye.hpp"

namespace {

using homeward::geometry::Correspondence;
using homeward::geometry::PlanarMotion;
using homeward::matching::Match;

struct Pair {
  std::string group;
  std::string current;
  std::string target;
  PlanarMotion truth;
};

std::vector<Pair> read_pairs(const char* file) {
  std::ifstream in(file);
  std::vector<Pair> pairs;
  for (std::string line; std::getline(in, line);) {
    while (!line.empty() && line.back() == '\r') line.pop_back();
    std::stringstream words(line);
    Pair pair;
    std::string bearing;
    std::string turn;
    std::getline(words, pair.group, ',');
    std::getline(words, pair.current, ',');
    std::getline(words, pair.target, ',');
    std::getline(words, bearing, ',');
    std::getline(words, turn, ',');
    pair.truth = {std::stod(bearing), std::stod(turn)};
    pairs.push_back(pair);
  }
  return pairs;
}

class Pictures {
 public:
  Pictures(const char* camera_file, int max_columns, int max_sift) {
    const auto config = homeward::files::read_camera(camera_file);
    const auto camera = homeward::camera::Camera::create(config.value());
    features = homeward::pipeline::suited_feature_config(*camera.value());
    features.max_columns = max_columns;
    features.max_sift = max_sift;
    eye_ = std::make_unique<homeward::pipeline::Eye>(
        std::move(homeward::pipeline::Eye::create(config.value(), features).value()));
  }
  const homeward::features::Appearance& look(const std::string& file) {
    const auto found = seen_.find(file);
    if (found != seen_.end()) return found->second;
    const auto panorama = unwrap(file);
    return seen_.emplace(file, homeward::features::extract(panorama, features)).first->second;
  }
  homeward::camera::Panorama unwrap(const std::string& file) {
    return eye_->unwrap(homeward::files::read_picture(file).value()).value();
  }
  homeward::features::FeatureConfig features;

 private:
  std::unique_ptr<homeward::pipeline::Eye> eye_;
  std::map<std::string, homeward::features::Appearance> seen_;
};

Eigen::Vector3d bearing(const homeward::features::FeatureSet& set, int i) {
  return set.bearings.row(i).transpose().cast<double>().normalized();
}

struct Errors {
  double middle = 0.0;
  double top = 0.0;
  double bottom = 0.0;
  [[nodiscard]] double worse() const { return std::max(top, bottom); }
};

Errors errors_of(const PlanarMotion& motion, const homeward::features::FeatureSet& a, int i,
                 const homeward::features::FeatureSet& b, int j) {
  const auto ends_a = homeward::features::column_ends(a, i);
  const auto ends_b = homeward::features::column_ends(b, j);
  using homeward::geometry::epipolar_error_rad;
  return {std::abs(epipolar_error_rad(motion, {bearing(a, i), bearing(b, j)})),
          std::abs(epipolar_error_rad(motion, {ends_a.top, ends_b.top})),
          std::abs(epipolar_error_rad(motion, {ends_a.bottom, ends_b.bottom}))};
}

/// Positive where both rays meet in front of both viewpoints, seen from above.
bool in_front(const PlanarMotion& motion, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const double alpha = std::atan2(a.y(), a.x()) - motion.direction_rad;
  const double beta = std::atan2(b.y(), b.x()) + motion.turn_rad - motion.direction_rad;
  const double parallax = homeward::wrap_angle(beta - alpha);
  return std::sin(alpha) * std::sin(parallax) >= -1e-3;
}

void time_extraction(Pictures& pictures, const std::vector<Pair>& pairs) {
  std::vector<double> took_ms;
  std::vector<double> match_ms;
  std::vector<homeward::features::FeatureSet> all;
  for (std::size_t i = 0; i < std::min<std::size_t>(30, pairs.size()); ++i) {
    const auto panorama = pictures.unwrap(pairs[i].current);
    double best = 1e9;
    for (int k = 0; k < 5; ++k) {
      const std::clock_t start = std::clock();
      auto set = homeward::features::extract_columns(panorama, pictures.features);
      best = std::min(best, 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
      if (k == 0) all.push_back(std::move(set));
    }
    took_ms.push_back(best);
  }
  double number = 0.0;
  for (std::size_t i = 0; i + 1 < all.size(); ++i) {
    double best = 1e9;
    for (int k = 0; k < 5; ++k) {
      const std::clock_t start = std::clock();
      const auto matches = homeward::matching::match_columns(all[i], all[i + 1], {});
      best = std::min(best, 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    }
    match_ms.push_back(best);
    number += all[i].size() / static_cast<double>(all.size() - 1);
  }
  std::sort(took_ms.begin(), took_ms.end());
  std::sort(match_ms.begin(), match_ms.end());
  std::printf("processor time: extraction median %.2f ms, worst %.2f ms; columns %.0f; matching: median %.3f ms\n",
              took_ms[took_ms.size() / 2], took_ms.back(), number, match_ms[match_ms.size() / 2]);
}

using Sums = std::array<double, homeward::features::kColumnInvariants>;

/// Sum of squared differences of each invariant over pairs of segments whose ends agree with the motion.
double add_differences(const PlanarMotion& motion, const homeward::features::FeatureSet& a,
                       const homeward::features::FeatureSet& b, Sums& sums) {
  double count = 0.0;
  for (int i = 0; i < a.size(); ++i) {
    for (int j = 0; j < b.size(); ++j) {
      if (errors_of(motion, a, i, b, j).worse() > 0.006 || !in_front(motion, bearing(a, i), bearing(b, j))) continue;
      count += 1.0;
      for (int k = 0; k < homeward::features::kColumnInvariants; ++k) {
        const double difference =
            k < 3 ? a.colours(i, k) - b.colours(j, k) : a.descriptors(i, k - 3) - b.descriptors(j, k - 3);
        sums[static_cast<std::size_t>(k)] += difference * difference / (127.0 * 127.0);
      }
    }
  }
  return count;
}

/// The ends of corresponding segments agree with the true motion; so do, by chance, those of others, as many as agree
/// with a false motion. What is left after these are taken out is the spread between corresponding ones.
void measure_spread(Pictures& pictures, const std::vector<Pair>& pairs) {
  Sums with{};
  Sums chance{};
  double with_count = 0.0;
  double chance_count = 0.0;
  constexpr std::array<double, 4> kFalseTurns = {0.9, -0.9, 1.7, -1.7};
  for (const Pair& pair : pairs) {
    if (pair.group != "day 0.4-1m") continue;
    const auto& a = pictures.look(pair.current).columns;
    const auto& b = pictures.look(pair.target).columns;
    with_count += add_differences(pair.truth, a, b, with);
    for (const double turn : kFalseTurns) {
      const PlanarMotion wrong{homeward::wrap_angle(pair.truth.direction_rad),
                               homeward::wrap_angle(pair.truth.turn_rad + turn)};
      chance_count += add_differences(wrong, a, b, chance) / kFalseTurns.size();
    }
  }
  for (double& sum : chance) sum /= kFalseTurns.size();
  std::printf("agree with the true motion: %.0f; by chance: %.0f\n", with_count, chance_count);
  for (std::size_t k = 0; k < with.size(); ++k) {
    std::printf("%zu: corresponding %.4f  random %.4f\n", k,
                std::sqrt(std::max(0.0, (with[k] - chance[k]) / (with_count - chance_count))),
                std::sqrt(chance[k] / chance_count));
  }
}

struct Row {
  double pairs = 0.0;
  double matches = 0.0;
  std::array<double, 4> middle{};  // within 0.006, 0.01, 0.015, 0.03
  std::array<double, 4> ends{};
  std::array<double, 4> far{};
  std::array<double, 4> chance{};  // far ends that agree with motions that are not the true one
  double front = 0.0;
};

void measure_right(Pictures& pictures, const std::vector<Pair>& pairs) {
  constexpr std::array<double, 4> kBounds = {0.006, 0.01, 0.015, 0.03};
  std::map<std::string, Row> rows;
  for (const Pair& pair : pairs) {
    if (std::isnan(pair.truth.turn_rad)) continue;
    const auto& a = pictures.look(pair.current);
    const auto& b = pictures.look(pair.target);
    Row& sift = rows[pair.group + " sift 0.90"];
    sift.pairs += 1.0;
    for (const Match& m : homeward::matching::match(a.sift, b.sift, {})) {
      const double error = std::abs(
          homeward::geometry::epipolar_error_rad(pair.truth, {bearing(a.sift, m.current), bearing(b.sift, m.target)}));
      sift.matches += 1.0;
      for (std::size_t k = 0; k < 4; ++k) sift.middle[k] += error < kBounds[k];
    }
    for (const double ratio : {0.7, 0.8, 0.9}) {
      char name[64];
      std::snprintf(name, sizeof name, "%s columns %.2f", pair.group.c_str(), ratio);
      Row& row = rows[name];
      row.pairs += 1.0;
      homeward::matching::ColumnMatchConfig config;
      config.ratio = ratio;
      for (const Match& m : homeward::matching::match_columns(a.columns, b.columns, config)) {
        const Errors errors = errors_of(pair.truth, a.columns, m.current, b.columns, m.target);
        row.matches += 1.0;
        const bool front = in_front(pair.truth, bearing(a.columns, m.current), bearing(b.columns, m.target));
        row.front += front;
        const auto far = homeward::matching::bearings_of(a.columns, b.columns, m);
        for (const double turn : {0.0, 1.7, -1.7}) {
          const PlanarMotion motion{pair.truth.direction_rad, homeward::wrap_angle(pair.truth.turn_rad + turn)};
          const double error = std::abs(homeward::geometry::epipolar_error_rad(motion, {far.current, far.target}));
          for (std::size_t k = 0; k < 4; ++k) {
            if (turn == 0.0) {
              row.far[k] += error < kBounds[k];
            } else {
              row.chance[k] += 0.5 * (error < kBounds[k]);
            }
          }
        }
        for (std::size_t k = 0; k < 4; ++k) {
          row.middle[k] += errors.middle < kBounds[k];
          row.ends[k] += front && errors.worse() < kBounds[k];
        }
      }
    }
  }
  for (const auto& [name, row] : rows) {
    std::printf("%-32s matches/pair %6.1f  middle", name.c_str(), row.matches / row.pairs);
    for (const double n : row.middle) std::printf(" %.2f", n / std::max(1.0, row.matches));
    std::printf("  far");
    for (const double n : row.far) std::printf(" %.2f", n / std::max(1.0, row.matches));
    std::printf("  by chance");
    for (const double n : row.chance) std::printf(" %.2f", n / std::max(1.0, row.matches));
    std::printf("  both ends");
    for (const double n : row.ends) std::printf(" %.2f", n / std::max(1.0, row.matches));
    std::printf("  front %.2f; right/pair %.1f\n", row.front / std::max(1.0, row.matches), row.ends[2] / row.pairs);
  }
}

enum class Use { kNot, kMiddle, kEnds, kFarEnd };

void measure_home(Pictures& pictures, const std::vector<Pair>& pairs) {
  struct Result {
    double pairs = 0.0;
    double answered = 0.0;
    double good = 0.0;
    std::vector<double> errors;
  };
  std::map<std::string, Result> results;
  for (const Pair& pair : pairs) {
    const auto& a = pictures.look(pair.current);
    const auto& b = pictures.look(pair.target);
    for (const Use use : {Use::kNot, Use::kMiddle, Use::kEnds, Use::kFarEnd}) {
      for (const double ratio : {0.7, 0.8, 0.9}) {
        if (use == Use::kNot && ratio != 0.8) continue;
        std::vector<Correspondence> all;
        for (const Match& m : homeward::matching::match(a.sift, b.sift, {})) {
          all.push_back({bearing(a.sift, m.current), bearing(b.sift, m.target)});
        }
        if (use != Use::kNot) {
          homeward::matching::ColumnMatchConfig config;
          config.ratio = ratio;
          for (const Match& m : homeward::matching::match_columns(a.columns, b.columns, config)) {
            if (use == Use::kMiddle) all.push_back({bearing(a.columns, m.current), bearing(b.columns, m.target)});
            if (use == Use::kFarEnd) {
              const auto far = homeward::matching::bearings_of(a.columns, b.columns, m);
              all.push_back({far.current, far.target});
            }
            if (use == Use::kEnds) {
              const auto from = homeward::features::column_ends(a.columns, m.current);
              const auto to = homeward::features::column_ends(b.columns, m.target);
              all.push_back({from.top, to.top});
              all.push_back({from.bottom, to.bottom});
            }
          }
        }
        char name[96];
        constexpr std::array<const char*, 4> kNames = {"sift alone", "middles", "ends", "far ends"};
        std::snprintf(name, sizeof name, "%s: %s %.2f", pair.group.c_str(), kNames[static_cast<std::size_t>(use)],
                      ratio);
        Result& result = results[name];
        result.pairs += 1.0;
        const auto estimate = homeward::geometry::estimate_planar_motion(all, {}, 1);
        if (!estimate || estimate->inliers.size() < 8) continue;
        result.answered += 1.0;
        const double error = homeward::degrees(
            std::abs(homeward::wrap_angle(estimate->motion.direction_rad - pair.truth.direction_rad)));
        result.good += error < 15.0;
        result.errors.push_back(error);
      }
    }
  }
  for (auto& [name, result] : results) {
    std::sort(result.errors.begin(), result.errors.end());
    const std::size_t n = result.errors.size();
    std::printf("%-34s answered %.2f  below 15 deg %.2f  median %.2f  p95 %.1f\n", name.c_str(),
                result.answered / result.pairs, result.good / result.pairs, n > 0 ? result.errors[n / 2] : -1.0,
                n > 0 ? result.errors[n * 95 / 100] : -1.0);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    std::fprintf(stderr, "homeward_bench_columns CAMERA PAIRS time|spread|right|home [MAX_COLUMNS [MAX_SIFT]]\n");
    return 2;
  }
  Pictures pictures(argv[1], argc > 4 ? std::stoi(argv[4]) : 300, argc > 5 ? std::stoi(argv[5]) : 300);
  const std::vector<Pair> pairs = read_pairs(argv[2]);
  const std::string mode = argv[3];
  if (mode == "time") time_extraction(pictures, pairs);
  if (mode == "spread") measure_spread(pictures, pairs);
  if (mode == "right") measure_right(pictures, pairs);
  if (mode == "home") measure_home(pictures, pairs);
  return 0;
}
