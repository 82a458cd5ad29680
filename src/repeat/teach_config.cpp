// SPDX-License-Identifier: Apache-2.0
#include "repeat/teach_config.hpp"

namespace homeward::repeat {

std::vector<std::string> problems(const BridgingConfig& config) {
  std::vector<std::string> found = problems(config.matching);
  const auto expect = [&](bool holds, const char* problem) {
    if (!holds) found.emplace_back(problem);
  };
  expect(config.most_ahead >= 1, "most_ahead is not positive");
  expect(config.most_turn_off_rad > 0.0, "most_turn_off_rad is not positive");
  expect(config.least_lead >= 0.0, "least_lead is negative");
  expect(config.fewest_around >= 1, "fewest_around is not positive");
  expect(config.most_aside_rad > 0.0, "most_aside_rad is not positive");
  return found;
}

std::vector<std::string> problems(const TeachConfig& config) {
  std::vector<std::string> found;
  const auto expect = [&](bool holds, const char* problem) {
    if (!holds) found.emplace_back(problem);
  };
  expect(config.most_error_px > 0.0, "most_error_px is not positive");
  expect(config.fewest_features >= config.geometry.fewest_pairs, "fewest_features is less than geometry.fewest_pairs");
  expect(config.least_features >= config.fewest_features, "least_features is less than fewest_features");
  expect(config.least_share > 0.0 && config.least_share <= 1.0, "least_share is not above 0, to 1");
  expect(config.least_agreeing >= 0.0 && config.least_agreeing <= 1.0, "least_agreeing is not 0 to 1");
  expect(config.least_kept >= 0.0 && config.least_kept <= 1.0, "least_kept is not 0 to 1");
  expect(config.least_common >= 0, "least_common is negative");
  expect(config.fewest_known >= 6, "fewest_known is less than 6");
  expect(config.known_weight >= 0.0, "known_weight is negative");
  expect(config.fewest_scaled >= 1, "fewest_scaled is not positive");
  expect(config.retry_share >= 0.0 && config.retry_share <= 1.0, "retry_share is not 0 to 1");
  expect(config.most_skipped >= 0, "most_skipped is negative");
  expect(config.most_features >= config.least_features, "most_features is less than least_features");
  for (const auto& problem : tracking::problems(config.corners)) found.push_back("corners: " + problem);
  for (const auto& problem : tracking::problems(config.tracker)) found.push_back("tracker: " + problem);
  for (const auto& problem : geometry::problems(config.geometry)) found.push_back("geometry: " + problem);
  if (config.bridging) {
    for (const auto& problem : problems(*config.bridging)) found.push_back("bridging: " + problem);
  }
  return found;
}

TeachConfig dense_teaching() {
  TeachConfig config;
  config.least_features = 120;
  config.least_share = 0.75;
  config.corners.spacing_px = 3.0;
  config.corners.least_strength = 3.0;
  config.tracker.least_texture = 0.2;
  return config;
}

}  // namespace homeward::repeat
