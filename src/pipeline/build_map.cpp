// SPDX-License-Identifier: Apache-2.0
#include "pipeline/build_map.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <unordered_set>

#include "mapping/common_features.hpp"
#include "mapping/compare_all.hpp"
#include "mapping/map_builder.hpp"
#include "mapping/parallel.hpp"
#include "pipeline/eye.hpp"
#include "pipeline/learn_calibration.hpp"
#include "pipeline/picture_frame.hpp"
#include "pipeline/tour_check.hpp"
#include "pipeline/tour_shortcuts.hpp"

namespace homeward::pipeline {
namespace {

constexpr int kFewFeatures = 20;         // a picture with fewer shows no texture
constexpr double kTooManyBlank = 0.5;    // share of such pictures that makes a tour useless
constexpr double kFeaturesShare = 0.35;  // of the time of a build, for the progress bar
constexpr double kCompareShare = 0.57;
constexpr double kClusterShare = 0.03;

/// All tours one after the other.
struct Pictures {
  struct Where {
    const TourSource* tour = nullptr;
    std::size_t index = 0;
  };
  std::vector<map::MapImage> images;
  std::vector<int> tour_of;
  std::vector<Where> where;
  std::vector<mapping::MarkedImage> marks;
};

/// Takes out the pictures that have a trouble; returns those troubles. A mark goes with its picture.
std::vector<Error> leave_out(Pictures& pictures, std::vector<features::Appearance>& appearances,
                             const std::vector<std::optional<Error>>& troubles) {
  std::vector<Error> skipped;
  std::vector<int> now_at(troubles.size(), -1);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < troubles.size(); ++i) {
    if (troubles[i]) {
      skipped.push_back(*troubles[i]);
      continue;
    }
    now_at[i] = static_cast<int>(kept);
    if (kept != i) {
      pictures.images[kept] = std::move(pictures.images[i]);
      pictures.tour_of[kept] = pictures.tour_of[i];
      pictures.where[kept] = pictures.where[i];
      appearances[kept] = std::move(appearances[i]);
    }
    ++kept;
  }
  std::vector<mapping::MarkedImage> marks;
  for (mapping::MarkedImage& mark : pictures.marks) {
    const auto was_at = static_cast<std::size_t>(mark.image);
    if (now_at[was_at] >= 0) {
      marks.push_back({now_at[was_at], std::move(mark.label)});
      continue;
    }
    const auto error = std::ranges::find(skipped, troubles[was_at]->where, &Error::where);
    error->message += " Its destination \"" + mark.label + "\" is left out with it.";
  }
  pictures.images.resize(kept);
  pictures.tour_of.resize(kept);
  pictures.where.resize(kept);
  pictures.marks = std::move(marks);
  appearances.resize(kept);
  return skipped;
}

Result<Pictures> gather(const std::vector<const TourSource*>& tours) {
  Pictures all;
  std::unordered_set<ImageId> ids;
  for (std::size_t t = 0; t < tours.size(); ++t) {
    const auto first = static_cast<int>(all.images.size());
    const std::vector<TourImage>& images = tours[t]->images();
    for (std::size_t i = 0; i < images.size(); ++i) {
      if (!ids.insert(images[i].id).second) {
        return fail(ErrorCode::kInvalidInput, "The image " + images[i].id.str() + " occurs twice.", images[i].id.str());
      }
      all.images.push_back({images[i].id, images[i].t_us, images[i].odometry});
      all.tour_of.push_back(static_cast<int>(t));
      all.where.push_back({tours[t], i});
    }
    for (const TourMark& mark : tours[t]->marks()) {
      const auto found = std::ranges::find_if(images, [&](const TourImage& image) {
        const std::string& id = image.id.str();
        return id.substr(id.rfind('/') + 1) == mark.image;
      });
      if (found == images.end()) {
        return fail(ErrorCode::kInvalidInput,
                    "The tour marks the image " + mark.image + " as " + mark.label + ", but has no such image.",
                    mark.image);
      }
      all.marks.push_back({first + static_cast<int>(found - images.begin()), mark.label});
    }
  }
  return all;
}

/// The pictures that can be read, looked at, and what is to be said about the others.
struct SeenPictures {
  Pictures pictures;
  std::vector<features::Appearance> appearances;
  std::vector<Error> skipped;
};

Result<SeenPictures> look_at_all(Pictures all, const Eye& eye, int threads, const std::function<void(double)>& progress,
                                 const std::stop_token& stop) {
  const std::size_t count = all.images.size();
  const FrameSampler sampler(eye.camera());
  std::vector<PictureSize> sizes(count);
  std::vector<PictureFrame> frames(count);
  std::vector<std::optional<Error>> troubles(count);
  SeenPictures seen;
  seen.appearances.resize(count);
  const auto look = [&](std::size_t i) {
    const auto picture = all.where[i].tour->read(all.where[i].index);
    if (!picture) {
      troubles[i] = picture.error();
      return;
    }
    sizes[i] = {picture->width_px, picture->height_px};
    auto appearance = eye.look(*picture);
    if (appearance) {
      seen.appearances[i] = std::move(*appearance);
      frames[i] = sampler.sample(*picture);
    } else {
      troubles[i] = appearance.error();
    }
  };
  const auto report = [&](std::size_t done) { progress(static_cast<double>(done) / static_cast<double>(count)); };
  if (!mapping::parallel_for(count, threads, look, report, stop)) {
    return fail(ErrorCode::kCancelled, "The build was cancelled.");
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (troubles[i]) troubles[i]->where = all.images[i].id.str();
  }
  if (const Status sized = check_sizes(all.images, sizes, eye.camera().config()); !sized) return pass_on(sized);
  if (const Status one = check_one_camera(all.images, frames); !one) return pass_on(one);
  seen.skipped = leave_out(all, seen.appearances, troubles);
  if (const Status enough = check_left(seen.skipped, all.images.size()); !enough) return pass_on(enough);
  seen.pictures = std::move(all);
  return seen;
}

/// Of each picture its sweep, null: it has none.
std::vector<const RangeSweep*> sweeps_of(const Pictures& pictures) {
  std::vector<const RangeSweep*> sweeps;
  for (const Pictures::Where& where : pictures.where) {
    const std::optional<RangeSweep>& sweep = where.tour->images()[where.index].sweep;
    sweeps.push_back(sweep ? &*sweep : nullptr);
  }
  return sweeps;
}

Status check_texture(const Pictures& pictures, const std::vector<features::Appearance>& appearances) {
  std::size_t blank = 0;
  std::string first_blank;
  for (std::size_t i = 0; i < appearances.size(); ++i) {
    if (appearances[i].size() >= kFewFeatures) continue;
    if (blank++ == 0) first_blank = pictures.images[i].id.str();
  }
  const double share = static_cast<double>(blank) / static_cast<double>(appearances.size());
  if (share <= kTooManyBlank) return {};
  return fail(ErrorCode::kTooFewFeatures,
              std::to_string(static_cast<int>(std::lround(share * 100.0))) + " % of the pictures (" +
                  std::to_string(blank) + " of " + std::to_string(appearances.size()) +
                  ") show no texture to recognise a place by; is the lens covered or the room dark?",
              first_blank);
}

}  // namespace

Result<map::TopologicalMap> build_map(const std::vector<const TourSource*>& tours, const camera::CameraConfig& camera,
                                      const BuildOptions& options, const map::TopologicalMap* previous,
                                      const ProgressSink& progress, const std::stop_token& stop) {
  auto built = build_noted_map(tours, camera, options, previous, progress, stop);
  if (!built) return pass_on(built);
  return std::move(built->map);
}

Result<BuiltMap> build_noted_map(const std::vector<const TourSource*>& tours, const camera::CameraConfig& camera,
                                 const BuildOptions& options, const map::TopologicalMap* previous,
                                 const ProgressSink& progress, const std::stop_token& stop) {
  auto gathered = gather(tours);
  if (!gathered) return pass_on(gathered);
  const std::size_t count = gathered->images.size();
  if (count == 0) return fail(ErrorCode::kEmptyInput, "The tour has no pictures.");
  if (count < kFewestImages) {
    return fail(ErrorCode::kTooFewImages, "The tour has " + std::to_string(count) + " picture" +
                                              (count == 1 ? "" : "s") + "; a map needs at least " +
                                              std::to_string(kFewestImages) + ".");
  }
  const auto model = camera::Camera::create(camera);
  if (!model) return pass_on(model);
  const auto eye = Eye::create(camera, suited_feature_config(**model));
  if (!eye) return pass_on(eye);

  const auto stage = [&](const char* name, double begin, double share) {
    return [&progress, name, begin, share](double done) {
      if (progress) progress({name, begin + share * done});
    };
  };
  auto seen = look_at_all(std::move(*gathered), *eye, options.threads, stage("features", 0.0, kFeaturesShare), stop);
  if (!seen) return pass_on(seen);
  const Pictures* pictures = &seen->pictures;
  std::vector<features::Appearance>* appearances = &seen->appearances;
  if (const Status textured = check_texture(*pictures, *appearances); !textured) return pass_on(textured);

  if (const Status moved = check_motion(pictures->images, *appearances, options.seed); !moved) return pass_on(moved);
  auto pairs = mapping::compare_all(*appearances, pictures->tour_of, {}, options.seed, options.threads,
                                    stage("compare", kFeaturesShare, kCompareShare), stop);
  if (!pairs) return pass_on(pairs);
  auto warnings = check_order(pictures->images, pictures->tour_of, *pairs);
  if (!warnings) return pass_on(warnings);

  stage("cluster", kFeaturesShare + kCompareShare, 0.0)(0.0);
  const std::vector<const RangeSweep*> sweeps = sweeps_of(*pictures);
  const mapping::MappingInput input{pictures->images, pictures->tour_of, *appearances,
                                    pictures->marks,  &*pairs,           sweeps};
  mapping::NotedMap made = mapping::make_noted_map(input, {}, previous);
  map::TopologicalMap& map = made.map;
  map.name = options.name;
  map.camera = camera;
  map.feature_config = eye->feature_config();
  map.feature_config_id = features::feature_config_id(map.feature_config);
  constexpr double kBeforeLast = kFeaturesShare + kCompareShare + kClusterShare;
  const auto calibration = learn_calibration(map, *appearances, pictures->tour_of, options.threads,
                                             stage("places", kBeforeLast, 1.0 - kBeforeLast), stop);
  if (!calibration) return pass_on(calibration);
  map.calibration = *calibration;
  if (!mapping::count_common_features(map, {}, options.threads, stop)) {
    return fail(ErrorCode::kCancelled, "The build was cancelled.");
  }
  add_shortcuts(map, tours);
  stage("places", 1.0, 0.0)(0.0);
  return BuiltMap{std::move(made.map),
                  {pictures->tour_of, std::move(*appearances), std::move(*pairs), std::move(made.notes),
                   std::move(seen->skipped), std::move(*warnings)}};
}

}  // namespace homeward::pipeline
