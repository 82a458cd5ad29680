// SPDX-License-Identifier: Apache-2.0
#include "geometry/planar_motion.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "core/angles.hpp"
#include "geometry/estimate_summary.hpp"
#include "geometry/motion_fit.hpp"
#include "geometry/packed_matches.hpp"
#include "geometry/planar_solver.hpp"
#include "geometry/repetition.hpp"
#include "geometry/tilted_refinement.hpp"

namespace homeward::geometry {
namespace {

constexpr int kFewest = 3;
constexpr int kLines = 12;                // bins of directions, up to their sign
constexpr int kTurns = 8;                 // bins of turns
constexpr double kApartRad = kPi / 12.0;  // motions whose directions or turns differ by more are rivals

/// The angle between two lines of travel, whichever way along them, [0, pi/2].
double between_lines_rad(double a_rad, double b_rad) {
  const double apart_rad = std::abs(wrap_angle(a_rad - b_rad));
  return std::min(apart_rad, kPi - apart_rad);
}

bool are_rivals(const PlanarMotion& a, const PlanarMotion& b) {
  return between_lines_rad(a.direction_rad, b.direction_rad) > kApartRad ||
         std::abs(wrap_angle(a.turn_rad - b.turn_rad)) > kApartRad;
}

/// How much a match says: minus the logarithm of the share of planar motions that would explain it, 1 at most. A match
/// at the horizon in both views satisfies all of them and says nothing.
std::vector<double> weights_of(std::span<const Correspondence> correspondences, double bound_rad) {
  constexpr int kPhases = 12;
  std::array<double, kPhases> cosines{};
  for (int i = 0; i < kPhases; ++i) cosines[static_cast<std::size_t>(i)] = std::cos(kPi * (i + 0.5) / kPhases);
  std::vector<double> weights;
  weights.reserve(correspondences.size());
  for (const Correspondence& c : correspondences) {
    const double heights2 = c.current.z() * c.current.z() + c.target.z() * c.target.z();
    const double level_current = std::sqrt(std::max(0.0, 1.0 - c.current.z() * c.current.z()));
    const double level_target = std::sqrt(std::max(0.0, 1.0 - c.target.z() * c.target.z()));
    double explained = 0.5;
    for (int i = 0; i < kPhases / 2; ++i) {  // the other half are the same motions reversed
      const double across_current = level_current * cosines[static_cast<std::size_t>(i)];
      for (const double b : cosines) {
        const double across_target = level_target * b;
        const double residual = c.target.z() * across_current + c.current.z() * across_target;
        const double gradient2 = heights2 + across_current * across_current + across_target * across_target;
        explained += residual * residual < bound_rad * bound_rad * gradient2 ? 1.0 : 0.0;
      }
    }
    constexpr int kMotions = kPhases / 2 * kPhases;
    constexpr double kAll = kMotions + 0.5;
    weights.push_back(std::log(kAll / explained) / std::log(kAll / 0.5));
  }
  return weights;
}

/// What is left of a match's weight for how it looks: as likely as it is to be right among matches of which few are, in
/// units of what one whose look says nothing has.
double weight_of_look(double odds) {
  constexpr double kShare = 0.1;
  return odds / (kShare * odds + 1.0 - kShare);
}

/// How many samples of two make it `sure_enough` that one of them was free of outliers.
int iterations_needed(double inlier_share, double sure_enough, int limit) {
  // Noise spoils many a sample without outliers.
  constexpr double kGoodOfClean = 0.3;
  const double good = kGoodOfClean * inlier_share * inlier_share;
  if (good <= 0.0) return limit;
  const double needed = std::log(1.0 - sure_enough) / std::log(1.0 - good);
  return needed >= limit ? limit : std::max(1, static_cast<int>(std::ceil(needed)));
}

struct Candidate {
  PlanarMotion motion;
  float cost = std::numeric_limits<float>::max();
};

std::size_t bin_of(const PlanarMotion& motion) {
  const double line_rad = motion.direction_rad < 0.0 ? motion.direction_rad + kPi : motion.direction_rad;
  const int line = std::clamp(static_cast<int>(line_rad * kLines / kPi), 0, kLines - 1);
  const int turn = std::clamp(static_cast<int>((motion.turn_rad + kPi) * kTurns / (2.0 * kPi)), 0, kTurns - 1);
  const int bin = line * kTurns + turn;
  return static_cast<std::size_t>(bin);
}

/// The best planar motion of each bin of directions and turns, best first.
std::vector<Candidate> search(std::span<const Correspondence> correspondences, const std::vector<int>& pool,
                              const std::vector<double>& weights, const PackedMatches& packed,
                              const PlanarRansacConfig& config, std::uint64_t seed) {
  std::array<Candidate, static_cast<std::size_t>(kLines) * kTurns> best;
  float best_cost = packed.total_weight();
  const int count = static_cast<int>(pool.size());
  std::mt19937_64 random(seed);
  std::vector<double> upto;
  upto.reserve(weights.size());
  double total = 0.0;
  for (const double weight : weights) upto.push_back(total += weight);
  // Matches are drawn as often as they weigh.
  const auto pick = [&] {
    const double at = total * static_cast<double>(random() >> 11) * 0x1p-53;
    return std::min(count - 1, static_cast<int>(std::ranges::upper_bound(upto, at) - upto.begin()));
  };
  const auto match = [&](int i) {
    return correspondences[static_cast<std::size_t>(pool[static_cast<std::size_t>(i)])];
  };
  int needed = config.max_iterations;
  for (int iteration = 0; iteration < needed; ++iteration) {
    const int first = pick();
    const int second = pick();
    if (first == second) continue;
    for (const PlanarMotion& motion : solve_planar_motion({match(first), match(second)})) {
      Candidate& here = best[bin_of(motion)];
      const float enough = std::min(here.cost, packed.total_weight());
      const float cost = packed.cost(motion, static_cast<float>(config.search_error_rad), enough);
      if (!(cost < enough)) continue;
      here = {motion, cost};
      if (cost >= best_cost) continue;
      best_cost = cost;
      // The weight explained stands for the share of inliers: never more than it.
      needed = std::min(needed, iterations_needed(1.0 - static_cast<double>(cost / packed.total_weight()),
                                                  config.sure_enough, config.max_iterations));
    }
  }
  std::vector<Candidate> found;
  for (const Candidate& candidate : best) {
    if (candidate.cost < packed.total_weight()) found.push_back(candidate);
  }
  std::ranges::stable_sort(found, {}, &Candidate::cost);
  return found;
}

/// From a planar motion that holds loosely to one, slightly tilted, that holds tightly.
TiltedMotion tightened(const PlanarMotion& planar, const MatchRows& matches, const PlanarRansacConfig& config) {
  TiltedMotion motion{planar};
  for (int step = 0; step < config.refinements; ++step) {
    const double share = static_cast<double>(step) / std::max(1, config.refinements - 1);
    const double bound_rad = config.search_error_rad * std::pow(config.max_error_rad / config.search_error_rad, share);
    refine_tilted(matches, bound_rad, 0.5 * bound_rad, config.tilt, motion);
  }
  return motion;
}

FitConfig fit_config(const PlanarRansacConfig& config) {
  FitConfig fit;
  fit.start_spread_rad = 0.5 * config.max_error_rad;
  fit.most_spread_rad = 0.75 * config.max_error_rad;
  fit.tilt = config.tilt;
  return fit;
}

struct Judged {
  MotionFit best;
  double lead = 0.0;
};

/// The likeliest motion among the candidates, optimised.
Judged judge(std::span<const Correspondence> correspondences, const std::vector<Candidate>& candidates,
             const PlanarRansacConfig& config) {
  const MatchRows matches(correspondences);
  std::vector<MotionFit> fits;
  FitConfig quick = fit_config(config);
  quick.steps = 2;
  for (const Candidate& candidate : candidates) {
    if (static_cast<int>(fits.size()) == config.candidates) break;
    fits.push_back(fit_motion(matches, tightened(candidate.motion, matches, config), quick));
  }
  // That a repetition looks alike is one coincidence, however many matches it is made of.
  for (MotionFit& fit : fits) {
    fit.log_likelihood *= 1.0 - repetition_probability(shared_view(correspondences, fit));
  }
  const auto best = std::ranges::max_element(fits, {}, &MotionFit::log_likelihood);
  double rival = 0.0;  // chance
  for (const MotionFit& fit : fits) {
    if (are_rivals(fit.motion.planar, best->motion.planar)) {
      rival = std::max(rival, fit.log_likelihood);
    }
  }
  const double lead = best->log_likelihood - rival;
  FitConfig full = fit_config(config);
  MotionFit tilted = fit_motion(matches, best->motion, full);
  full.level = true;
  MotionFit level = fit_motion(matches, best->motion, full);
  // Three angles more must gain what they cost (Schwarz 1978).
  const double right = std::max(1.0, tilted.share * static_cast<double>(correspondences.size()));
  const bool tilts_pay = tilted.log_likelihood - level.log_likelihood > 1.5 * std::log(right);
  return {tilts_pay ? std::move(tilted) : std::move(level), lead};
}

Result<PlanarEstimate> estimate_of_finite(std::span<const Correspondence> correspondences,
                                          const PlanarRansacConfig& config, std::uint64_t seed) {
  // Matches that can tell one motion from another; the others are only counted in the end.
  constexpr double kTelling = 0.1;
  std::vector<int> pool;
  std::vector<double> pool_weights;
  const std::vector<double> weights = weights_of(correspondences, config.search_error_rad);
  for (std::size_t i = 0; i < correspondences.size(); ++i) {
    if (weights[i] < kTelling) continue;
    pool.push_back(static_cast<int>(i));
    pool_weights.push_back(weights[i] * weight_of_look(correspondences[i].odds));
  }
  if (static_cast<int>(pool.size()) < kFewest) {
    return fail(ErrorCode::kTooLittleSupport, "Fewer than three matches that could tell one motion from another.");
  }
  const PackedMatches packed(correspondences, pool, pool_weights);
  const std::vector<Candidate> candidates = search(correspondences, pool, pool_weights, packed, config, seed);
  if (candidates.empty()) return fail(ErrorCode::kTooLittleSupport, "No motion explains three matches.");

  Judged judged = judge(correspondences, candidates, config);
  const SharedView view = shared_view(correspondences, judged.best);
  const double log_likelihood = judged.best.log_likelihood;
  const double greatest_gain = judged.best.greatest_gain;
  auto estimate = summarise(correspondences, std::move(judged.best), config.max_error_rad);
  if (!estimate) return estimate;
  estimate->lead = judged.lead;
  // Two matches fit by construction; every other pair could have been tried, each with two motions.
  const auto size = static_cast<double>(pool.size());
  estimate->evidence =
      (1.0 - repetition_probability(view)) * (log_likelihood - 2.0 * greatest_gain - std::log(size * (size - 1.0)));
  estimate->height = view.height;
  estimate->agreeing = view.agreeing;
  return estimate;
}

}  // namespace

Result<PlanarEstimate> estimate_planar_motion(std::span<const Correspondence> correspondences,
                                              const PlanarRansacConfig& config, std::uint64_t seed) {
  return with_finite_only(correspondences, [&](std::span<const Correspondence> finite) {
    return estimate_of_finite(finite, config, seed);
  });
}

}  // namespace homeward::geometry
