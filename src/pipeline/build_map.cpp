// SPDX-License-Identifier: Apache-2.0
#include "pipeline/build_map.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <optional>
#include <unordered_set>

#include "mapping/compare_all.hpp"
#include "mapping/map_builder.hpp"
#include "mapping/parallel.hpp"
#include "pipeline/eye.hpp"
#include "pipeline/learn_calibration.hpp"

namespace homeward::pipeline {
namespace {

constexpr int kFewestImages = 3;
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

/// The first failure in picture order, whichever thread met it.
class FirstFailure {
 public:
  void offer(std::size_t index, const Error& error) {
    const std::scoped_lock lock(mutex_);
    if (failure_ && failure_->first <= index) return;
    failure_ = std::pair(index, error);
  }
  [[nodiscard]] const std::optional<std::pair<std::size_t, Error>>& get() const { return failure_; }

 private:
  std::mutex mutex_;
  std::optional<std::pair<std::size_t, Error>> failure_;
};

Result<std::vector<features::Appearance>> look_at_all(const Pictures& pictures, const Eye& eye, int threads,
                                                      const std::function<void(double)>& progress,
                                                      const std::stop_token& stop) {
  std::vector<features::Appearance> appearances(pictures.images.size());
  FirstFailure failure;
  const auto look = [&](std::size_t i) {
    const auto picture = pictures.where[i].tour->read(pictures.where[i].index);
    if (!picture) return failure.offer(i, picture.error());
    auto seen = eye.look(*picture);
    if (seen) {
      appearances[i] = std::move(*seen);
    } else {
      failure.offer(i, {seen.error().code, seen.error().message, pictures.images[i].id.str()});
    }
  };
  const auto report = [&](std::size_t done) {
    progress(static_cast<double>(done) / static_cast<double>(pictures.images.size()));
  };
  const bool finished = mapping::parallel_for(pictures.images.size(), threads, look, report, stop);
  if (failure.get()) return tl::unexpected<Error>(failure.get()->second);
  if (!finished) return fail(ErrorCode::kCancelled, "The build was cancelled.");
  return appearances;
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
                                      const ProgressSink& progress, std::stop_token stop) {
  auto built = build_noted_map(tours, camera, options, previous, progress, std::move(stop));
  if (!built) return pass_on(built);
  return std::move(built->map);
}

Result<BuiltMap> build_noted_map(const std::vector<const TourSource*>& tours, const camera::CameraConfig& camera,
                                 const BuildOptions& options, const map::TopologicalMap* previous,
                                 const ProgressSink& progress, std::stop_token stop) {
  const auto pictures = gather(tours);
  if (!pictures) return pass_on(pictures);
  const std::size_t count = pictures->images.size();
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
  auto appearances = look_at_all(*pictures, *eye, options.threads, stage("features", 0.0, kFeaturesShare), stop);
  if (!appearances) return pass_on(appearances);
  if (const Status textured = check_texture(*pictures, *appearances); !textured) return pass_on(textured);

  auto pairs = mapping::compare_all(*appearances, pictures->tour_of, {}, options.seed, options.threads,
                                    stage("compare", kFeaturesShare, kCompareShare), stop);
  if (!pairs) return pass_on(pairs);

  stage("cluster", kFeaturesShare + kCompareShare, 0.0)(0.0);
  const mapping::MappingInput input{pictures->images, pictures->tour_of, *appearances, pictures->marks, &*pairs};
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
  stage("places", 1.0, 0.0)(0.0);
  return BuiltMap{std::move(made.map),
                  {pictures->tour_of, std::move(*appearances), std::move(*pairs), std::move(made.notes), {}}};
}

}  // namespace homeward::pipeline
