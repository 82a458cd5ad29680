// SPDX-License-Identifier: Apache-2.0
#include "localisation/calibration.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace homeward::localisation::calibration_test {
namespace {

TEST(Calibration, RisesWithTheBeliefAndStaysAProbability) {
  const map::BeliefCalibration calibration{-0.5, 0.6};
  double before = 0.0;
  for (const double share : {0.0, 0.001, 0.1, 0.5, 0.9, 0.999}) {
    const double now = calibrated(calibration, share);
    EXPECT_GT(now, before) << share;
    EXPECT_LT(now, 1.0);
    before = now;
  }
  EXPECT_NEAR(calibrated({0.0, 1.0}, 0.3), 0.3, 1e-12);
}

TEST(Calibration, FindsTheLogisticThatMadeTheSamples) {
  const map::BeliefCalibration truth{0.8, 0.5};
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<CalibrationSample> samples;
  for (int i = 0; i < 20'000; ++i) {
    const double share = uniform(random);
    samples.push_back({share, uniform(random) < calibrated(truth, share)});
  }
  const map::BeliefCalibration found = fit_calibration(samples, {});
  EXPECT_NEAR(found.offset, truth.offset, 0.05);
  EXPECT_NEAR(found.slope, truth.slope, 0.05);
}

TEST(Calibration, WithoutSamplesIsWhatItWasBefore) {
  const map::BeliefCalibration found = fit_calibration({}, {0.7, 0.4});
  EXPECT_EQ(found.offset, 0.7);
  EXPECT_EQ(found.slope, 0.4);
}

TEST(Calibration, ATourWithoutErrorsGivesFiniteTrust) {
  const std::vector<CalibrationSample> samples(100, {0.8, true});
  const map::BeliefCalibration found = fit_calibration(samples, {0.0, 1.0});
  EXPECT_TRUE(std::isfinite(found.offset));
  EXPECT_GT(calibrated(found, 0.8), 0.97);
  EXPECT_LT(calibrated(found, 0.01), 0.9);  // nothing was learnt about such beliefs
}

TEST(Calibration, NeverFallsWithTheBelief) {
  std::vector<CalibrationSample> samples;
  for (int i = 0; i < 50; ++i) {
    samples.push_back({0.95, false});
    samples.push_back({0.2, true});
  }
  EXPECT_GT(fit_calibration(samples, {}).slope, 0.0);
}

}  // namespace
}  // namespace homeward::localisation::calibration_test
