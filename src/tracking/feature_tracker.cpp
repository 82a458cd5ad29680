// SPDX-License-Identifier: Apache-2.0
#include "tracking/feature_tracker.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace homeward::tracking {
namespace {

constexpr int kSmallestWindow_px = 7;
constexpr double kSmallestStep_px = 0.4;
constexpr double kPlaceFirst_px = 0.3;     // a step shorter than this: the scale is looked for, too
constexpr double kNearlyAtRest_px = 0.1;   // with all iterations done, a last step shorter than this counts as rest
constexpr double kCoarserConverged = 5.0;  // times as far from rest is enough where a finer level follows

/// What is looked for on one level, and its result.
struct Search {
  const GreyLevel& level;
  const PatchReference& reference;
  double pixels;  // of the picture in one of the level
  double shrunk;  // how many times finer than the level the reference is
  int iterations;
  double converged_px;
  bool is_finest;
};

enum class Rest { kFound, kOffPicture, kNone };

/// Moves a feature on one level until it rests. Its scale is looked for on the finest level alone, once its place is
/// nearly found: from afar a scale runs away to whatever looks least unlike (docs/experiments/feature_tracker.md).
Rest settle(const Search& search, TrackedFeature& feature) {
  const PatchView patch = search.reference.view();
  const int half = patch.side / 2;
  StepOf of = StepOf::kPlace;
  double moved_px = std::numeric_limits<double>::infinity();  // by the last step, in the level's pixels
  for (int i = 0; i < search.iterations; ++i) {
    const double step_px = feature.scale * search.shrunk;
    if (!(step_px >= kSmallestStep_px && step_px <= kLargestStep_px)) return Rest::kNone;
    const PatchPlace place{feature.pixel_px.x() / search.pixels - half * step_px,
                           feature.pixel_px.y() / search.pixels - half * step_px, step_px};
    if (!inside(search.level, patch.side, place, search.is_finest ? 0.0 : kMostOutside_px)) return Rest::kOffPicture;
    const PatchStep step = search.reference.step(patch_sums(search.level, patch, place), of);
    feature.gain = step.gain;
    feature.offset = step.offset;
    feature.residual = step.residual;
    if (!(step.gain > 0.0)) return Rest::kNone;
    // The reference moved by the step looks as what is seen: the place moves by the step's inverse.
    const double zoomed = 1.0 / (1.0 + step.zoom);
    const Eigen::Vector2d move_px = Eigen::Vector2d(step.du_px, step.dv_px) * (step_px * zoomed);
    feature.scale *= zoomed;
    feature.pixel_px -= move_px * search.pixels;
    moved_px = move_px.norm();
    if (search.is_finest && of == StepOf::kPlace) {
      if (moved_px < kPlaceFirst_px) of = StepOf::kPlaceAndScale;
    } else if (moved_px < search.converged_px && std::abs(step.zoom) * half < 2.0 * search.converged_px) {
      return Rest::kFound;
    }
  }
  return moved_px < kNearlyAtRest_px ? Rest::kFound : Rest::kNone;
}

FeatureState judged(const TrackedFeature& feature, const FeatureGuess& guess, const FeatureTrackerConfig& config) {
  const bool near = (feature.pixel_px - guess.pixel_px).norm() <= config.most_from_guess_px;
  if (!near || !(feature.scale >= config.least_scale && feature.scale <= config.most_scale)) {
    return FeatureState::kLostDiverged;
  }
  if (!(feature.gain >= config.least_gain && feature.gain <= config.most_gain)) return FeatureState::kLostContrast;
  const bool is_dark = config.darker_residual && feature.gain < kDarkGain;
  const double residual = is_dark ? feature.residual * feature.gain : feature.residual;
  return residual <= config.most_residual ? FeatureState::kTracked : FeatureState::kLostResidual;
}

}  // namespace

std::vector<std::string> problems(const FeatureTrackerConfig& config) {
  std::vector<std::string> found;
  const auto expect = [&](bool holds, const char* problem) {
    if (!holds) found.emplace_back(problem);
  };
  expect(
      config.window_px >= kSmallestWindow_px && config.window_px <= kLargestPatchSide_px && config.window_px % 2 == 1,
      "window_px is not odd, 7 to 15");
  expect(config.iterations >= 1, "iterations is not positive");
  expect(config.converged_px > 0.0, "converged_px is not positive");
  expect(config.most_residual >= 0.0, "most_residual is negative");
  expect(config.least_texture > 0.0, "least_texture is not positive");
  expect(config.least_gain > 0.0 && config.least_gain <= 1.0, "least_gain is not above 0, to 1");
  expect(config.most_gain >= 1.0, "most_gain is less than 1");
  expect(config.least_scale > 0.0 && config.least_scale <= 1.0, "least_scale is not above 0, to 1");
  expect(config.most_scale >= 1.0, "most_scale is less than 1");
  expect(config.most_from_guess_px > 0.0, "most_from_guess_px is not positive");
  return found;
}

Result<FeatureTracker> FeatureTracker::create(const FeatureTrackerConfig& config) {
  if (const auto wrong = problems(config); !wrong.empty()) return fail(ErrorCode::kInvalidInput, wrong.front());
  return FeatureTracker(config);
}

std::vector<ReferenceState> FeatureTracker::add(const ImagePyramid& picture,
                                                std::span<const Eigen::Vector2d> pixels_px) {
  std::vector<ReferenceState> states;
  states.reserve(pixels_px.size());
  const int reach = config_.window_px / 2 + 1;
  for (const Eigen::Vector2d& pixel_px : pixels_px) {
    const PatchPlace place{pixel_px.x() - reach, pixel_px.y() - reach, 1.0};
    if (!inside(picture.levels().front(), config_.window_px + 2, place, 0.0)) {
      states.push_back(ReferenceState::kOffPicture);
      continue;
    }
    Reference reference;
    double pixels = 1.0;
    for (const GreyLevel& level : picture.levels()) {
      reference.push_back(
          PatchReference::make(level, pixel_px / pixels, config_.window_px, config_.changes, config_.least_texture));
      pixels *= 2.0;
    }
    const bool is_taken = reference.front().has_value();
    states.push_back(is_taken ? ReferenceState::kTaken : ReferenceState::kNoTexture);
    if (is_taken) references_.push_back(std::move(reference));
  }
  return states;
}

std::vector<TrackedFeature> FeatureTracker::track(const ImagePyramid& picture,
                                                  std::span<const FeatureGuess> guesses) const {
  std::vector<TrackedFeature> found;
  found.reserve(guesses.size());
  for (const FeatureGuess& guess : guesses) found.push_back(track_one(picture, guess));
  return found;
}

TrackedFeature FeatureTracker::track_one(const ImagePyramid& picture, const FeatureGuess& guess) const {
  TrackedFeature feature;
  feature.pixel_px = guess.pixel_px;
  feature.scale = guess.scale;
  if (guess.reference >= references_.size() || !guess.pixel_px.allFinite() || !std::isfinite(guess.scale) ||
      !(guess.scale > 0.0)) {
    return feature;
  }
  feature.state = FeatureState::kLostDiverged;
  if (!(guess.scale >= config_.least_scale && guess.scale <= config_.most_scale)) return feature;
  const Reference& reference = references_[guess.reference];
  const auto& levels = picture.levels();
  // Level `of` of the reference is compared with level `of + coarser` of the picture.
  const int coarser = static_cast<int>(std::lround(std::log2(guess.scale)));
  const int finest = std::max(0, -coarser);
  Rest rest = Rest::kNone;
  for (int of = static_cast<int>(reference.size()) - 1; of >= finest; --of) {
    const int in = of + coarser;
    const auto& patch = reference[static_cast<std::size_t>(of)];
    if (in >= static_cast<int>(levels.size()) || !patch) continue;
    TrackedFeature tried = feature;
    rest = settle({levels[static_cast<std::size_t>(in)], *patch, std::exp2(in), std::exp2(-coarser), config_.iterations,
                   (of == finest ? 1.0 : kCoarserConverged) * config_.converged_px, of == finest},
                  tried);
    if (rest == Rest::kFound || of == finest) feature = tried;
    if (of == finest) break;
    rest = Rest::kNone;
  }
  if (rest == Rest::kOffPicture) feature.state = FeatureState::kLostOffPicture;
  if (rest == Rest::kFound) feature.state = judged(feature, guess, config_);
  return feature;
}

}  // namespace homeward::tracking
