// SPDX-License-Identifier: Apache-2.0
#include "geometry/match_rows.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "core/angles.hpp"
#include "geometry/tilted_motion.hpp"
#include "geometry/tilted_refinement.hpp"

namespace homeward::geometry::match_rows_test {
namespace {

const TiltedMotion kMotion{{0.7, -0.4}, 0.02, 0.03, -0.01};

/// Bearings of every elevation, the horizon and the zenith among them, and changes of size of which some are not known.
std::vector<Correspondence> scattered(int count) {
  std::mt19937_64 random(3);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11U) * 0x1p-53;
  };
  const auto bearing = [&](double elevation_rad) {
    const double azimuth_rad = uniform(-kPi, kPi);
    return Eigen::Vector3d(std::cos(elevation_rad) * std::cos(azimuth_rad),
                           std::cos(elevation_rad) * std::sin(azimuth_rad), std::sin(elevation_rad));
  };
  std::vector<Correspondence> matches;
  for (int i = 0; i < count; ++i) {
    const double elevation_rad = i == 0 ? 0.0 : i == 1 ? 0.5 * kPi : uniform(-0.9, 0.9);
    matches.push_back({bearing(elevation_rad), bearing(uniform(-0.9, 0.9)), i % 3 == 0 ? 0.0 : uniform(-1.0, 1.0),
                       std::exp(uniform(-2.0, 2.0))});
  }
  return matches;
}

/// As one would write it for one match, with the library's functions.
double share_of_azimuths(const Eigen::Vector3d& line, double height, double window) {
  const double middle = line.z() * height / line.norm();
  const double reach = line.head<2>().norm() / line.norm() * std::sqrt(std::max(0.0, 1.0 - height * height));
  if (reach < 1e-9) return std::abs(middle) < window ? 1.0 : 0.0;
  return (std::acos(std::clamp((-window - middle) / reach, -1.0, 1.0)) -
          std::acos(std::clamp((window - middle) / reach, -1.0, 1.0))) /
         kPi;
}

TEST(MatchRows, ErrorsAndSlopesAreThoseOfEachMatch) {
  const std::vector<Correspondence> matches = scattered(203);
  const EpipolarError error_of(kMotion);
  std::vector<double> errors_rad;
  std::vector<double> same_rad;
  std::vector<double> slopes;
  const MatchRows rows(matches);
  rows.errors(error_of, errors_rad);
  rows.errors_and_slopes(error_of, same_rad, slopes);
  EXPECT_EQ(errors_rad, same_rad);
  for (std::size_t i = 0; i < matches.size(); ++i) {
    MotionAngles slope;
    EXPECT_NEAR(errors_rad[i], error_of(matches[i], slope), 1e-13);
    for (std::size_t k = 0; k < 5; ++k) {
      EXPECT_NEAR(slopes[k * matches.size() + i], slope[static_cast<Eigen::Index>(k)], 1e-12);
    }
  }
}

TEST(MatchRows, ChancesAreSharesOfTheCircle) {
  const std::vector<Correspondence> matches = scattered(300);
  for (const TiltedMotion& motion : {kMotion, TiltedMotion{{-2.0, 1.0}}}) {
    const EpipolarError error_of(motion);
    for (const double window_rad : {0.0004, 0.005, 0.3}) {
      std::vector<double> chances;
      MatchRows(matches).chances(error_of, window_rad, 0.01, chances);
      for (std::size_t i = 0; i < matches.size(); ++i) {
        const double window = window_rad * std::numbers::sqrt2;
        const double there =
            share_of_azimuths(error_of.essential().transpose() * matches[i].current, matches[i].target.z(), window);
        const double here = share_of_azimuths(error_of.essential() * matches[i].target, matches[i].current.z(), window);
        EXPECT_NEAR(chances[i], std::max({0.01, there, here}), 1e-7) << i;  // an arc cosine is steep at its ends
      }
    }
  }
}

TEST(MatchRows, JudgesAsTheFormulaeDo) {
  const std::vector<Correspondence> matches = scattered(301);
  const EpipolarError error_of(kMotion);
  const MatchRows rows(matches);
  for (const double spread_rad : {0.0003, 0.003, 0.05}) {
    MatchRows::Seen seen;
    rows.errors(error_of, seen.error_rad);
    rows.chances(error_of, spread_rad, 0.01, seen.chance);
    for (std::size_t i = 0; i < matches.size(); ++i) seen.possible.push_back(i % 10 == 7 ? 0.0 : 1.0);
    const Eigen::Vector3d here = kMotion.direction();
    const Eigen::Vector3d there = kMotion.rotation().transpose() * here;
    rows.judge({here, there, spread_rad, 0.4}, seen);
    for (std::size_t i = 0; i < matches.size(); ++i) {
      const Correspondence& m = matches[i];
      const double share = 0.4 * m.odds / (0.4 * m.odds + 0.6);
      const double sine2_here = std::max(1e-4, 1.0 - std::pow(m.current.dot(here), 2));
      const double sine2_there = std::max(1e-4, 1.0 - std::pow(m.target.dot(there), 2));
      const double parallax =
          std::sqrt(sine2_there) * m.current.dot(here) - std::sqrt(sine2_here) * m.target.dot(there);
      const double side = 2.0 / (1.0 + std::exp(-1.7 * parallax / (std::sqrt(2.0) * std::max(spread_rad, 0.001))));
      const double variance = 0.35 * 0.35 + spread_rad * spread_rad * (1.0 / sine2_here + 1.0 / sine2_there);
      const double off = m.log_scale_ratio - 0.5 * std::log(sine2_there / sine2_here);
      const double as_wrong = 1.0 + m.log_scale_ratio * m.log_scale_ratio / (3.0 * 0.25);
      const double as_right = 1.0 + off * off / (3.0 * variance);
      const double size = m.log_scale_ratio == 0.0 ? 1.0 : 0.5 / std::sqrt(variance) * std::pow(as_wrong / as_right, 2);
      const double tail = 1.0 / (1.0 + std::pow(seen.error_rad[i] / spread_rad, 2) / 4.0);
      const double right = seen.possible[i] * share * side * size * std::pow(tail, 2.5) / seen.chance[i];
      EXPECT_NEAR(seen.share[i], share, 1e-12);
      EXPECT_NEAR(seen.belief[i], right / (right + 1.0 - share), 1e-11);
      EXPECT_NEAR(seen.gain[i], std::log(right + 1.0 - share), 1e-11);
      EXPECT_NEAR(seen.pull[i], 1.25 * tail, 1e-12);
      EXPECT_NEAR(seen.telling[i], seen.possible[i] == 0.0 ? 1.0 : 1.0 - seen.chance[i], 1e-12);
    }
  }
}

TEST(NormalEquations, AreSumsOfOuterProducts) {
  const double slopes[] = {1.0, -2.0, 0.5, 3.0, -1.0};
  NormalEquations equations;
  equations.add(2.0, 0.1, slopes, 1);
  equations.add(1.0, -0.3, slopes, 1);
  const MotionAngles slope(slopes);
  EXPECT_TRUE(equations.curvature().isApprox(3.0 * slope * slope.transpose(), 1e-14));
  EXPECT_TRUE(equations.gradient().isApprox(-0.1 * slope, 1e-14));
}

}  // namespace
}  // namespace homeward::geometry::match_rows_test
