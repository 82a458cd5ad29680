// SPDX-License-Identifier: Apache-2.0
#include "pipeline/grow_map.hpp"

#include <span>
#include <string>
#include <utility>

#include "mapping/common_features.hpp"
#include "mapping/growth_input.hpp"
#include "pipeline/eye.hpp"
#include "pipeline/learn_calibration.hpp"
#include "pipeline/look_at_tours.hpp"
#include "pipeline/tour_shortcuts.hpp"

namespace homeward::pipeline {
namespace {

constexpr std::size_t kFewestImages = 3;
constexpr int kFewFeatures = 20;         // a picture with fewer shows no texture
constexpr double kFeaturesShare = 0.35;  // of the time, for the progress bar
constexpr double kCompareShare = 0.57;
constexpr double kLoopsShare = 0.03;

}  // namespace

Result<Eye> eye_for(const map::TopologicalMap& map, const std::optional<camera::CameraConfig>& camera) {
  const std::string own_id = features::feature_config_id(map.feature_config);
  if (map.feature_config_id != own_id) {
    return fail(ErrorCode::kFeatureConfigMismatch,
                "The map was made with the feature settings " + map.feature_config_id + ", this program uses " +
                    own_id + ": rebuild the map from the kept images.",
                map.name);
  }
  if (!camera) return Eye::create(map.camera, map.feature_config);
  const auto model = camera::Camera::create(*camera);
  if (!model) return pass_on(model);
  const std::string suited = features::feature_config_id(suited_feature_config(**model));
  if (suited != map.feature_config_id) {
    return fail(ErrorCode::kFeatureConfigMismatch,
                "The map was made with another kind of camera: its features are " + map.feature_config_id +
                    ", those of this camera " + suited + ". Build a map of its own for this camera.",
                map.name);
  }
  return Eye::create(*camera, map.feature_config);
}

Result<ToursAdded> add_tours(const map::TopologicalMap& old, const std::vector<const TourSource*>& tours,
                             const std::optional<camera::CameraConfig>& camera, const BuildOptions& options,
                             const ProgressSink& progress, const std::stop_token& stop) {
  const auto eye = eye_for(old, camera);
  if (!eye) return pass_on(eye);
  const auto stage = [&](const char* name, double begin, double share) {
    return [&progress, name, begin, share](double done) {
      if (progress) progress({name, begin + share * done});
    };
  };
  auto seen = look_at_tours(tours, *eye, options.threads, stage("features", 0.0, kFeaturesShare), stop);
  if (!seen) return pass_on(seen);
  const std::size_t count = seen->tours.images.size();
  if (count < kFewestImages) {
    return fail(ErrorCode::kTooFewImages, "The tour has " + std::to_string(count) + " picture" +
                                              (count == 1 ? "" : "s") + "; adding to a map needs at least " +
                                              std::to_string(kFewestImages) + ".");
  }
  std::size_t blank = 0;
  for (const features::Appearance& appearance : seen->tours.appearances) blank += appearance.size() < kFewFeatures;
  if (2 * blank > count) {
    return fail(ErrorCode::kTooFewFeatures, std::to_string(blank) + " of " + std::to_string(count) +
                                                " pictures show no texture to recognise a place by; is the lens "
                                                "covered or the room dark?");
  }
  const auto input = mapping::growth_input(old, std::move(seen->tours));
  if (!input) return pass_on(input);
  mapping::CompareConfig compare;
  // By other light colours differ everywhere: what looks alike by its features is compared all the same.
  compare.candidates.gate_factor = 1e9;
  const auto pairs = mapping::compare_with_map(*input, compare, options.seed, options.threads,
                                               stage("compare", kFeaturesShare, kCompareShare), stop);
  if (!pairs) return pass_on(pairs);
  stage("places", kFeaturesShare + kCompareShare, 0.0)(0.0);
  ToursAdded result{mapping::grow_map(old, *input, *pairs, {}), std::move(seen->skipped)};
  constexpr double kBeforeLast = kFeaturesShare + kCompareShare + kLoopsShare;
  const auto fresh = static_cast<std::size_t>(input->new_images);
  const auto calibration = relearn_calibration(result.grown.map, std::span(input->appearances).first(fresh),
                                               std::span(input->tour_of).first(fresh), options.threads,
                                               stage("places", kBeforeLast, 1.0 - kBeforeLast), stop);
  if (!calibration) return pass_on(calibration);
  result.grown.map.calibration = *calibration;
  if (!mapping::count_common_features(result.grown.map, {}, options.threads, stop)) {
    return fail(ErrorCode::kCancelled, "Adding to the map was cancelled.");
  }
  add_shortcuts(result.grown.map, tours);
  stage("places", 1.0, 0.0)(0.0);
  return result;
}

}  // namespace homeward::pipeline
