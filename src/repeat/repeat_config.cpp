// SPDX-License-Identifier: Apache-2.0
#include "repeat/repeat_config.hpp"

namespace homeward::repeat {
namespace {

bool is_share(double value) { return value >= 0.0 && value <= 1.0; }

}  // namespace

std::vector<std::string> problems(const RepeatConfig& config) {
  std::vector<std::string> found;
  const auto expect = [&](bool holds, const char* problem) {
    if (!holds) found.emplace_back(problem);
  };
  expect(config.reach >= 0, "reach is negative");
  expect(config.most_error_rad > 0.0, "most_error_rad is not positive");
  expect(config.doubtful_error_rad > 0.0, "doubtful_error_rad is not positive");
  expect(config.least_visible >= 0.0, "least_visible is negative");
  expect(config.fewest_features >= 4, "fewest_features is less than 4");
  expect(is_share(config.least_agreeing), "least_agreeing is not 0 to 1");
  expect(is_share(config.least_expected), "least_expected is not 0 to 1");
  expect(config.fewest_recovered >= config.fewest_features, "fewest_recovered is less than fewest_features");
  expect(is_share(config.least_recovered), "least_recovered is not 0 to 1");
  expect(is_share(config.enough_agreeing), "enough_agreeing is not 0 to 1");
  expect(config.passed >= 1.0, "passed is less than 1");
  expect(is_share(config.turned), "turned is not 0 to 1");
  expect(is_share(config.nearly_passed), "nearly_passed is not 0 to 1");
  expect(config.turning > 0.0 && config.turning <= 1.0, "turning is not above 0, to 1");
  expect(config.clear_way_rad > 0.0, "clear_way_rad is not positive");
  expect(config.back <= 0.0, "back is more than 0");
  expect(config.most_transitions >= 1, "most_transitions is not positive");
  expect(config.most_from_predicted_rad > 0.0, "most_from_predicted_rad is not positive");
  expect(config.most_from_start_rad > 0.0, "most_from_start_rad is not positive");
  expect(config.most_predicted >= 0, "most_predicted is negative");
  expect(config.keys_tried >= 0, "keys_tried is negative");
  expect(is_share(config.retry_share), "retry_share is not 0 to 1");
  expect(config.turn_from_scale >= 1.0, "turn_from_scale is less than 1");
  expect(config.fewest_scaled >= 1, "fewest_scaled is not positive");
  expect(config.steering_gain > 0.0, "steering_gain is not positive");
  expect(config.pose.seen_spread_px > 0.0, "pose.seen_spread_px is not positive");
  expect(config.pose.agree_rad > 0.0, "pose.agree_rad is not positive");
  expect(config.pose.most_open_rad >= 0.0, "pose.most_open_rad is negative");
  expect(config.pose.stray_share > 0.0, "pose.stray_share is not positive");
  for (const auto& problem : tracking::problems(config.tracker)) found.push_back("tracker: " + problem);
  for (const auto& problem : geometry::problems(config.geometry)) found.push_back("geometry: " + problem);
  if (config.recognition) {
    for (const auto& problem : problems(*config.recognition)) found.push_back("recognition: " + problem);
  }
  return found;
}

}  // namespace homeward::repeat
