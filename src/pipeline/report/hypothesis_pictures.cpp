// SPDX-License-Identifier: Apache-2.0
#include "pipeline/report/hypothesis_pictures.hpp"

#include "imageio/decode.hpp"
#include "map/lookup.hpp"
#include "mapping/parallel.hpp"
#include "matching/verify.hpp"
#include "pipeline/comparison_picture.hpp"
#include "pipeline/eye.hpp"
#include "pipeline/report/html.hpp"

namespace homeward::pipeline {
namespace {

constexpr int kWidth_px = 640;
constexpr int kQuality = 68;

struct Where {
  const TourSource* tour = nullptr;
  std::size_t index = 0;
};
using Pictures = std::unordered_map<ImageId, Where>;

Pictures find_pictures(const std::vector<const TourSource*>& tours) {
  Pictures pictures;
  for (const TourSource* tour : tours) {
    for (std::size_t i = 0; i < tour->images().size(); ++i) pictures.emplace(tour->images()[i].id, Where{tour, i});
  }
  return pictures;
}

Result<camera::Panorama> unwrap_again(const Eye& eye, const Pictures& pictures, const ImageId& id) {
  const auto where = pictures.find(id);
  if (where == pictures.end()) return fail(ErrorCode::kNotFound, "No tour has this picture any more.", id.str());
  const auto picture = where->second.tour->read(where->second.index);
  if (!picture) return pass_on(picture);
  auto panorama = eye.unwrap(*picture);
  if (!panorama) return fail(panorama.error().code, panorama.error().message, id.str());
  return panorama;
}

Result<HypothesisPicture> draw(const Eye& eye, const Pictures& pictures, const BuiltMap& built,
                               const std::unordered_map<ImageId, int>& images, const map::Hypothesis& hypothesis,
                               std::uint64_t seed) {
  const auto panorama_a = unwrap_again(eye, pictures, hypothesis.prototype_a);
  if (!panorama_a) return pass_on(panorama_a);
  const auto panorama_b = unwrap_again(eye, pictures, hypothesis.prototype_b);
  if (!panorama_b) return pass_on(panorama_b);
  const auto a = static_cast<std::size_t>(images.at(hypothesis.prototype_a));
  const auto b = static_cast<std::size_t>(images.at(hypothesis.prototype_b));
  const ComparedView upper{*panorama_a, built.notes.appearances[a]};
  const ComparedView lower{*panorama_b, built.notes.appearances[b]};
  const auto verified = matching::verify(upper.appearance, lower.appearance, {}, seed);
  HypothesisPicture picture;
  std::optional<matching::VerifiedMatch> shown;
  if (verified) {
    shown = *verified;
    picture.matches = static_cast<int>(verified->matches.size());
    picture.agree = static_cast<int>(verified->pose.inliers.size());
  }
  const Image drawn =
      draw_comparison(upper, lower, shown, {.words = false, .unmatched = false, .most_lines = kMostLines, .cut = true});
  const Image small = imageio::shrink_to_fit(drawn, kWidth_px, 2 * kWidth_px);
  picture.uri = data_uri("image/jpeg", imageio::encode_jpeg(small, kQuality));
  return picture;
}

}  // namespace

Result<std::unordered_map<int, HypothesisPicture>> draw_hypotheses(const BuiltMap& built,
                                                                   const std::vector<const TourSource*>& tours,
                                                                   const std::vector<int>& wanted,
                                                                   const ReportOptions& options,
                                                                   const std::stop_token& stop) {
  std::unordered_map<int, HypothesisPicture> drawn;
  if (wanted.empty()) return drawn;
  const auto eye = Eye::create(built.map.camera, built.map.feature_config);
  if (!eye) return pass_on(eye);
  const Pictures pictures = find_pictures(tours);
  const auto images = map::image_indices(built.map);
  std::vector<Result<HypothesisPicture>> results(wanted.size());
  const auto work = [&](std::size_t i) {
    const map::Hypothesis& hypothesis = built.map.hypotheses[static_cast<std::size_t>(wanted[i])];
    results[i] = draw(*eye, pictures, built, images, hypothesis, options.seed);
  };
  if (!mapping::parallel_for(wanted.size(), options.threads, work, {}, stop)) {
    return fail(ErrorCode::kCancelled, "Drawing the report was cancelled.");
  }
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (!results[i]) return pass_on(results[i]);
    drawn.emplace(wanted[i], std::move(*results[i]));
  }
  return drawn;
}

}  // namespace homeward::pipeline
