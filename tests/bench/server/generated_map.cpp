// SPDX-License-Identifier: Apache-2.0
#include "generated_map.hpp"

#include <cmath>
#include <stdexcept>

#include "imageio/decode.hpp"
#include "pipeline/eye.hpp"
#include "support/clustered_features.hpp"
#include "support/room_picture.hpp"

namespace homeward::bench {
namespace {

constexpr int kPlacesOfCorridor = 100;
constexpr int kPlacesBetweenCrossings = 20;
constexpr double kAlong_m = 1.0;
constexpr double kAcross_m = 3.0;
constexpr int kPlacesOfDestination = 100;

template <class T>
T or_throw(Result<T> result) {
  if (!result) throw std::runtime_error(result.error().message);
  return std::move(*result);
}

PlaceId place_id(int index) { return PlaceId("p" + std::to_string(index + 1)); }

Pose2 pose_of(int index) {
  return {kAlong_m * (index % kPlacesOfCorridor), kAcross_m * (index / kPlacesOfCorridor), 0.0};
}

/// All prototypes face the same way along their corridors.
void join(map::TopologicalMap& map, int a, int b) {
  const Pose2 from = pose_of(a);
  const Pose2 to = pose_of(b);
  for (const bool back : {false, true}) {
    const double sign = back ? -1.0 : 1.0;
    map::Edge edge;
    edge.from = place_id(back ? b : a);
    edge.to = place_id(back ? a : b);
    edge.bearing_rad = std::atan2(sign * (to.y_m - from.y_m), sign * (to.x_m - from.x_m));
    edge.turn_rad = 0.0;
    edge.length_m = std::hypot(to.x_m - from.x_m, to.y_m - from.y_m);
    edge.length_from = map::LengthSource::kOdometry;
    edge.confidence = 0.9;
    edge.inliers = 60;
    map.edges.push_back(std::move(edge));
  }
}

features::Appearance look_of_room(const pipeline::Eye& eye, int room) {
  const std::string jpeg = testing::room_picture(static_cast<unsigned>(room), 0);
  const std::vector<std::uint8_t> bytes(jpeg.begin(), jpeg.end());
  return or_throw(eye.look(or_throw(imageio::decode(bytes, "a room"))));
}

}  // namespace

map::TopologicalMap corridor_map(const MapSize& size, bool with_rooms) {
  map::TopologicalMap map;
  map.name = "corridors";
  map.camera = testing::small_panorama_camera();
  map.feature_config = pipeline::suited_feature_config(*or_throw(camera::Camera::create(map.camera)));
  map.feature_config_id = features::feature_config_id(map.feature_config);
  const auto eye = or_throw(pipeline::Eye::create(map.camera, map.feature_config));
  const int places_of_room = size.places / kRooms;
  for (int i = 0; i < size.places; ++i) {
    map::Place place;
    place.id = place_id(i);
    place.prototype = ImageId("tour/" + std::to_string(i) + ".jpg");
    place.members = {place.prototype};
    map.images.push_back({place.prototype, 1'000'000LL * i, pose_of(i)});
    features::Appearance appearance;
    if (with_rooms && i % places_of_room == 0 && i / places_of_room < kRooms) {
      appearance = look_of_room(eye, i / places_of_room + 1);
    } else {
      appearance.sift = testing::clustered_features(size.features_of_place, static_cast<std::uint64_t>(i) + 1);
    }
    if (i % kPlacesOfDestination == 0) {
      place.label = "room " + std::to_string(i / kPlacesOfDestination + 1);
      const DestinationId id("d" + std::to_string(map.next_destination_number++));
      map.destinations.push_back({id, place.id, place.prototype, place.label, appearance});
    }
    place.appearances = {std::move(appearance)};
    map.places.push_back(std::move(place));
    if (i % kPlacesOfCorridor != 0) join(map, i - 1, i);
    if (i >= kPlacesOfCorridor && i % kPlacesBetweenCrossings == 0) join(map, i - kPlacesOfCorridor, i);
  }
  map.next_place_number = size.places + 1;
  return map;
}

}  // namespace homeward::bench
