// SPDX-License-Identifier: Apache-2.0
#include "driving/stated.hpp"

#include <algorithm>

#include "driving/estimated_position.hpp"

namespace homeward::driving {
namespace {

/// Sums of weights may be off by their last digits; what is stated is a probability.
double as_probability(double value) { return std::clamp(value, 0.0, 1.0); }

bool follows_path(const DrivingState& state) { return state.mission && state.mission->homes(); }

}  // namespace

std::optional<double> stated_arrival(const DrivingState& state, const DrivingConfig& config) {
  if (!follows_path(state) || state.mission->path.alone() || state.follow.hypotheses.empty()) return std::nullopt;
  return as_probability(arrival_probability(state.follow, state.mission->path, config.follow));
}

std::optional<wire::EstimateReport> stated_estimate(const DrivingState& state, const DrivingConfig& config) {
  if (!follows_path(state) || state.covered || state.follow.hypotheses.empty()) return std::nullopt;
  const auto place = estimated_place(state.follow, state.mission->path, config.follow);
  if (!place) return std::nullopt;
  constexpr double kAtOdds = 0.5;  // with a belief as sure as it
  const double probability = as_probability(position_probability(state.follow, state.mission->path));
  return wire::EstimateReport{*place, state.at_odds ? std::min(kAtOdds, probability) : probability};
}

std::vector<wire::EstimateReport> stated_places(const DrivingState& state) {
  std::vector<wire::EstimateReport> stated;
  if (!follows_path(state) || state.covered) return stated;
  for (const PossiblePlace& one : possible_places(state.follow, state.mission->path)) {
    stated.push_back({one.place, as_probability(one.probability)});
  }
  return stated;
}

std::optional<wire::QuestionReport> open_question(const DrivingState& state, const DrivingConfig& config,
                                                  Milliseconds now_ms) {
  if (!follows_path(state) || !state.asking.since_ms || state.asking.answer) return std::nullopt;
  const VisualPath& path = state.mission->path;
  const Milliseconds left_ms = std::max<Milliseconds>(0, config.asks_ms - (now_ms - *state.asking.since_ms));
  return wire::QuestionReport{state.asking.number, path.place_of(path.size() - 1), state.mission->label,
                              0.001 * static_cast<double>(left_ms)};
}

std::int64_t stated_index(const DrivingState& state) {
  if (!state.mission || !state.mission->repeats) return state.follow.index;
  constexpr int kMost = 2000;  // that the link takes
  return state.repeat.known ? std::min(kMost, state.repeat.known->arc) : 0;
}

}  // namespace homeward::driving
