// SPDX-License-Identifier: Apache-2.0
#include "pipeline/teach_path.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

#include "camera/camera.hpp"
#include "core/angles.hpp"
#include "core/index.hpp"
#include "features/appearance.hpp"
#include "pipeline/eye.hpp"
#include "repeat/closing.hpp"
#include "repeat/teach.hpp"
#include "tracking/image_pyramid.hpp"

namespace homeward::pipeline {
namespace {

using map::PathArc;
using map::TaughtPath;
using map::TopologicalMap;

/// The tour as it was shown: the pictures that can be read, numbered anew.
struct Shown {
  TaughtPath taught;
  std::vector<map::MapImage> images;
  std::vector<std::size_t> of_tour;  // index of each in the tour
  std::vector<Error> skipped;
};

Error at_picture(Error error, const ImageId& image) {
  if (error.where.empty()) error.where = image.str();
  return error;
}

Result<Shown> show(const TourSource& tour, repeat::Teacher teacher, const ProgressSink& progress,
                   const std::stop_token& stop) {
  Shown shown;
  const std::size_t all = tour.images().size();
  for (std::size_t i = 0; i < all; ++i) {
    if (stop.stop_requested()) return fail(ErrorCode::kCancelled, "The work was cancelled.");
    if (progress) progress({"path", static_cast<double>(i) / static_cast<double>(all)});
    const TourImage& image = tour.images()[i];
    const auto picture = tour.read(i);
    if (!picture) {
      shown.skipped.push_back(at_picture(picture.error(), image.id));
      continue;
    }
    auto pyramid = tracking::ImagePyramid::build(*picture);
    if (!pyramid) return tl::unexpected<Error>(at_picture(pyramid.error(), image.id));
    if (const auto added = teacher.add(*std::move(pyramid)); !added) {
      return fail(added.error().code, added.error().message, image.id.str());
    }
    shown.images.push_back({image.id, image.t_us, image.odometry});
    shown.of_tour.push_back(i);
  }
  if (shown.images.empty()) {
    if (!shown.skipped.empty()) return tl::unexpected<Error>(shown.skipped.front());
    return fail(ErrorCode::kEmptyInput, "The tour has no pictures.");
  }
  auto taught = teacher.path();
  if (!taught) return pass_on(taught);
  shown.taught = *std::move(taught);
  return shown;
}

/// The key image that was shown nearest to a picture.
std::size_t nearest_key(const TaughtPath& taught, int picture) {
  const auto nearest = std::ranges::min_element(
      taught.key_images, {}, [&](const map::KeyImage& key) { return std::abs(key.picture - picture); });
  return static_cast<std::size_t>(nearest - taught.key_images.begin());
}

/// That a direction is right within 15 degrees, by how well the arc's own geometry knows it.
double confidence_of(const PathArc& arc) {
  constexpr double kRight_rad = 15.0 * std::numbers::pi / 180.0;
  return arc.has_baseline ? std::erf(kRight_rad / (std::numbers::sqrt2 * std::max(1e-6, arc.direction_spread_rad)))
                          : 0.0;
}

/// How long an arc is. A closing one leads back over all that odometry has drifted since: its length is told by the arc
/// before and the scale between them, where that is known.
void measure(const Shown& shown, const PathArc& arc, map::Edge& edge) {
  const auto& from = shown.taught.key_images[at(arc.from)];
  const auto& to = shown.taught.key_images[at(shown.taught.to_key(arc))];
  const auto& begins = shown.images[at(from.picture)].odometry;
  const auto& ends = shown.images[at(to.picture)].odometry;
  if (shown.taught.is_closing(arc)) {
    const auto& before = shown.images[at(shown.taught.key_images[at(arc.from) - 1].picture)].odometry;
    edge.length_m = 1.0;
    edge.length_from = map::LengthSource::kTourImages;
    if (!begins || !before || !from.scale) return;
    edge.length_m = from.scale->ratio * (position_m(*begins) - position_m(*before)).norm();
    edge.length_from = map::LengthSource::kOdometry;
  } else if (begins && ends) {
    edge.length_m = (position_m(*ends) - position_m(*begins)).norm();
    edge.length_from = map::LengthSource::kOdometry;
  } else {
    edge.length_m = to.picture - from.picture;
    edge.length_from = map::LengthSource::kTourImages;
  }
}

void add_edges(const Shown& shown, const PathArc& arc, TopologicalMap& map) {
  const Eigen::Matrix3d& turn = arc.motion.current_from_target;
  map::Edge there;
  there.from = map.places[at(arc.from)].id;
  there.to = map.places[at(shown.taught.to_key(arc))].id;
  there.turn_rad = std::atan2(turn(1, 0), turn(0, 0));
  if (arc.has_baseline) {
    there.bearing_rad = std::atan2(arc.motion.target_in_current.y(), arc.motion.target_in_current.x());
  }
  measure(shown, arc, there);
  there.confidence = confidence_of(arc);
  there.inliers = static_cast<int>(arc.matches.size());
  map::Edge back = there;
  std::swap(back.from, back.to);
  back.turn_rad = -*there.turn_rad;
  if (there.bearing_rad) {
    const Eigen::Vector3d behind = -(turn.transpose() * arc.motion.target_in_current);
    back.bearing_rad = std::atan2(behind.y(), behind.x());
  }
  map.edges.push_back(std::move(there));
  map.edges.push_back(std::move(back));
}

Result<features::Appearance> appearance_of(const TourSource& tour, const Shown& shown, std::size_t picture,
                                           const Eye& eye) {
  const ImageId& id = shown.images[picture].id;
  const auto read = tour.read(shown.of_tour[picture]);
  if (!read) return tl::unexpected<Error>(at_picture(read.error(), id));
  auto appearance = eye.look(*read);
  if (!appearance) return tl::unexpected<Error>(at_picture(appearance.error(), id));
  return appearance;
}

Status add_places(const TourSource& tour, const Shown& shown, const Eye& eye, TopologicalMap& map) {
  for (const map::KeyImage& key : shown.taught.key_images) {
    auto appearance = appearance_of(tour, shown, at(key.picture), eye);
    if (!appearance) return pass_on(appearance);
    map::Place place;
    place.id = PlaceId("p" + std::to_string(map.next_place_number++));
    place.prototype = shown.images[at(key.picture)].id;
    place.appearances.push_back(*std::move(appearance));
    map.places.push_back(std::move(place));
  }
  for (std::size_t i = 0; i < shown.images.size(); ++i) {
    map.places[nearest_key(shown.taught, static_cast<int>(i))].members.push_back(shown.images[i].id);
  }
  return {};
}

Status add_destinations(const TourSource& tour, const Shown& shown, const Eye& eye, TopologicalMap& map) {
  for (const TourMark& mark : tour.marks()) {
    const auto is_it = [&](const map::MapImage& image) {
      return image.id.str().substr(image.id.str().rfind('/') + 1) == mark.image;
    };
    const auto found = std::ranges::find_if(shown.images, is_it);
    if (found == shown.images.end()) {
      return fail(ErrorCode::kInvalidInput,
                  "The tour marks the image " + mark.image + " as " + mark.label +
                      ", but there is no such image or it cannot be read.",
                  mark.image);
    }
    const auto picture = static_cast<std::size_t>(found - shown.images.begin());
    auto appearance = appearance_of(tour, shown, picture, eye);
    if (!appearance) return pass_on(appearance);
    map::Place& place = map.places[nearest_key(shown.taught, static_cast<int>(picture))];
    if (place.label.empty()) place.label = mark.label;
    map.destinations.push_back({DestinationId("d" + std::to_string(map.next_destination_number++)), place.id, found->id,
                                mark.label, *std::move(appearance)});
  }
  return {};
}

Result<map::MapPath> keep_pictures(Shown shown, const PictureBytes& bytes) {
  map::MapPath path;
  path.taught = std::move(shown.taught);
  for (const map::KeyImage& key : path.taught.key_images) {
    auto picture = bytes(shown.of_tour[at(key.picture)]);
    if (!picture) return pass_on(picture);
    path.images.push_back(shown.images[at(key.picture)].id);
    path.pictures.push_back(*std::move(picture));
  }
  return path;
}

/// Closes the path if it comes round; key images are read again for that.
void close_path(const TourSource& tour, const std::shared_ptr<const camera::Camera>& camera,
                const repeat::TeachConfig& config, Shown& shown) {
  const auto picture_of = [&](int key) -> std::shared_ptr<const tracking::ImagePyramid> {
    const auto picture = tour.read(shown.of_tour[at(shown.taught.key_images[at(key)].picture)]);
    if (!picture) return nullptr;
    auto pyramid = tracking::ImagePyramid::build(*picture);
    if (!pyramid) return nullptr;
    return std::make_shared<const tracking::ImagePyramid>(*std::move(pyramid));
  };
  repeat::close_path(shown.taught, picture_of, camera, config);
}

}  // namespace

Result<PathMap> teach_path(const TourSource& tour, const camera::CameraConfig& camera, const std::string& name,
                           const repeat::TeachConfig& config, const PictureBytes& bytes, const ProgressSink& progress,
                           const std::stop_token& stop) {
  auto model = camera::Camera::create(camera);
  if (!model) return pass_on(model);
  const features::FeatureConfig features = suited_feature_config(**model);
  auto teacher = repeat::Teacher::create(config, *model);
  if (!teacher) return pass_on(teacher);
  const auto eye = Eye::create(camera, features);
  if (!eye) return pass_on(eye);
  auto shown = show(tour, *std::move(teacher), progress, stop);
  if (!shown) return pass_on(shown);
  close_path(tour, *model, config, *shown);
  PathMap made;
  made.skipped = std::move(shown->skipped);
  TopologicalMap& map = made.map;
  map.name = name;
  map.camera = camera;
  map.feature_config = features;
  map.feature_config_id = features::feature_config_id(features);
  map.images = shown->images;
  if (Status added = add_places(tour, *shown, *eye, map); !added) return pass_on(added);
  for (const PathArc& arc : shown->taught.arcs) add_edges(*shown, arc, map);
  if (Status added = add_destinations(tour, *shown, *eye, map); !added) return pass_on(added);
  auto path = keep_pictures(*std::move(shown), bytes);
  if (!path) return pass_on(path);
  map.path = std::make_shared<const map::MapPath>(*std::move(path));
  return made;
}

}  // namespace homeward::pipeline
