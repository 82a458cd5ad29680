// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string_view>

#include "cli/command.hpp"
#include "features/aggregate.hpp"
#include "features/global.hpp"
#include "files/read_file.hpp"
#include "files/write_file.hpp"
#include "imageio/decode.hpp"
#include "matching/retrieval_index.hpp"
#include "matching/visual_distance.hpp"
#include "pipeline/comparison_picture.hpp"
#include "pipeline/eye.hpp"

namespace homeward::cli {
namespace {

struct CompareOptions {
  std::string camera;
  std::string measure = "features";
  std::vector<std::string> pictures;
  std::string drawing;
  std::uint64_t seed = 1;
};

/// One picture, unwrapped.
struct View {
  std::string file;
  Image picture;
  camera::Panorama panorama;
};

Result<View> view_of(const pipeline::Eye& eye, const std::string& file) {
  auto picture = files::read_picture(file);
  if (!picture) return pass_on(picture);
  auto panorama = eye.unwrap(*picture);
  if (!panorama) return fail(panorama.error().code, panorama.error().message, file);
  return View{file, std::move(*picture), std::move(*panorama)};
}

Result<features::GlobalDescriptor> describe(const View& view) {
  auto described = features::describe(view.panorama);
  if (!described) return fail(described.error().code, described.error().message, view.file);
  return described;
}

nlohmann::json line_of(const View& a, const View& b, const std::string& measure) {
  return {{"a", a.file}, {"b", b.file}, {"measure", measure}, {"dissimilarity", nullptr}};
}

Status compare_globally(features::GlobalMeasure measure, const std::vector<View>& views) {
  const auto first = describe(views.front());
  if (!first) return pass_on(first);
  for (std::size_t i = 1; i < views.size(); ++i) {
    const auto other = describe(views[i]);
    if (!other) return pass_on(other);
    nlohmann::json line = line_of(views.front(), views[i], std::string(features::global_measure_name(measure)));
    line["dissimilarity"] = features::dissimilarity(measure, *first, *other);
    std::cout << line.dump() << "\n";
  }
  return {};
}

/// By aggregated descriptors, their words learnt from the pictures themselves.
Status compare_aggregated(const pipeline::Eye& eye, const std::vector<View>& views, const CompareOptions& options) {
  std::vector<features::Appearance> seen;
  for (const View& view : views) {
    if (const auto shows_something = describe(view); !shows_something) return pass_on(shows_something);
    auto appearance = eye.look(view.picture);
    if (!appearance) return pass_on(appearance);
    if (appearance->sift.size() == 0) {
      return fail(ErrorCode::kTooFewFeatures, "The picture shows no features.", view.file);
    }
    seen.push_back(std::move(*appearance));
  }
  std::vector<const features::FeatureSet*> sets;
  sets.reserve(seen.size());
  for (const features::Appearance& appearance : seen) sets.push_back(&appearance.sift);
  const auto vocabulary = features::train_vocabulary(sets, matching::kRetrievalWords, options.seed);
  if (!vocabulary) return pass_on(vocabulary);
  const Eigen::VectorXf first = features::aggregate(seen.front().sift, *vocabulary);
  for (std::size_t i = 1; i < views.size(); ++i) {
    nlohmann::json line = line_of(views.front(), views[i], options.measure);
    line["dissimilarity"] = std::max(0.0F, 1.0F - first.dot(features::aggregate(seen[i].sift, *vocabulary)));
    std::cout << line.dump() << "\n";
  }
  return {};
}

Status compare_by_features(const pipeline::Eye& eye, const std::vector<View>& views, const CompareOptions& options) {
  const auto first = eye.look(views.front().picture);
  if (!first) return pass_on(first);
  for (std::size_t i = 1; i < views.size(); ++i) {
    const auto other = eye.look(views[i].picture);
    if (!other) return pass_on(other);
    nlohmann::json line = line_of(views.front(), views[i], "features");
    const auto compared = matching::compare(*first, *other, {}, options.seed);
    line["matches"] = compared.matches;
    line["verified"] = compared.verified;
    if (std::isfinite(compared.distance)) line["dissimilarity"] = compared.distance;
    line["turn_rad"] = nullptr;
    if (compared.pose) line["turn_rad"] = compared.pose->motion.turn_rad;
    std::cout << line.dump() << "\n";
    if (options.drawing.empty()) continue;
    const auto verified = matching::verify(*first, *other, {}, options.seed);
    const Image drawing = pipeline::draw_comparison({views.front().panorama, *first}, {views[i].panorama, *other},
                                                    verified ? std::optional(*verified) : std::nullopt);
    const auto png = imageio::encode_png(drawing);
    const std::string_view bytes(reinterpret_cast<const char*>(png.data()), png.size());
    if (Status written = files::write_file(options.drawing, bytes); !written) return written;
  }
  return {};
}

Status compare(const CompareOptions& options) {
  if (options.pictures.size() < 2) {
    return fail(ErrorCode::kTooFewImages, "Two pictures or more are needed: the first is compared with each other one.",
                "compare");
  }
  const bool by_features = options.measure == "features";
  const bool aggregated = options.measure == "vlad";
  const auto measure = std::ranges::find_if(features::kGlobalMeasures, [&](features::GlobalMeasure one) {
    return features::global_measure_name(one) == options.measure;
  });
  if (!by_features && !aggregated && measure == features::kGlobalMeasures.end()) {
    return fail(ErrorCode::kInvalidInput,
                "The measure '" + options.measure +
                    "' is not known; there are features, moments, jeffrey, chi2, sad, fourier, invariants, "
                    "rgb_jeffrey, row_fourier and vlad.",
                "--measure");
  }
  if (!options.drawing.empty() && (!by_features || options.pictures.size() != 2)) {
    return fail(ErrorCode::kInvalidInput, "Two pictures compared by features can be drawn, nothing else.", "--draw");
  }
  const auto config = files::read_camera(options.camera);
  if (!config) return pass_on(config);
  const auto camera = camera::Camera::create(*config);
  if (!camera) return pass_on(camera);
  const auto eye = pipeline::Eye::create(*config, pipeline::suited_feature_config(**camera));
  if (!eye) return pass_on(eye);
  std::vector<View> views;
  for (const std::string& file : options.pictures) {
    auto view = view_of(*eye, file);
    if (!view) return pass_on(view);
    views.push_back(std::move(*view));
  }
  if (by_features) return compare_by_features(*eye, views, options);
  return aggregated ? compare_aggregated(*eye, views, options) : compare_globally(*measure, views);
}

}  // namespace

void register_compare(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "compare", "How different the first picture is from each of the others: a JSON line per pair");
  const auto options = std::make_shared<CompareOptions>();
  command->add_option("--camera", options->camera, "camera.json")->required();
  command
      ->add_option("--measure", options->measure,
                   "features, moments, jeffrey, chi2, sad, fourier, invariants, rgb_jeffrey, row_fourier or vlad")
      ->capture_default_str();
  command->add_option("--draw", options->drawing, "Picture (PNG) of the two panoramas and what they have in common");
  command->add_option("--seed", options->seed, "Seed of everything random");
  command->add_option("pictures", options->pictures, "Pictures")->required();
  run_on(*command, [options] { return compare(*options); });
}

}  // namespace homeward::cli
