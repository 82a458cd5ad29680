// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <random>
#include <string>
#include <utility>

#include "map/topological_map.hpp"

namespace homeward::testing {

/// An appearance of `count` random features; the same seed gives the same one.
inline features::Appearance random_appearance(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> uniform(-1.0F, 1.0F);
  std::uniform_int_distribution<int> byte(0, 255);
  features::Appearance appearance;
  features::FeatureSet& sift = appearance.sift;
  sift.bearings.resize(count, 3);
  sift.scales_rad.resize(count);
  sift.descriptors.resize(count, 128);
  sift.colours.resize(count, 3);
  for (int i = 0; i < count; ++i) {
    sift.bearings.row(i) = Eigen::Vector3f(uniform(random), uniform(random), uniform(random)).normalized();
    sift.scales_rad[i] = 0.01F + 0.1F * (1.0F + uniform(random));
    for (int d = 0; d < 128; ++d) sift.descriptors(i, d) = static_cast<std::uint8_t>(byte(random));
    for (int d = 0; d < 3; ++d) sift.colours(i, d) = static_cast<std::int8_t>(byte(random) - 128);
  }
  for (float& moment : appearance.colour_moments) moment = uniform(random);
  return appearance;
}

/// A place with one image.
inline map::Place place_of_image(const std::string& id, const ImageId& image, features::Appearance appearance) {
  map::Place place;
  place.id = PlaceId(id);
  place.prototype = image;
  place.members = {image};
  place.appearances.push_back(std::move(appearance));
  return place;
}

/// A small valid map with one of everything: 3 images, 2 places, 2 edges, a hypothesis, a rejected
/// shortcut, a destination, an edit.
inline map::TopologicalMap sample_map() {
  map::TopologicalMap map;
  map.name = "sample";
  map.revision = 4;
  map.camera.width_px = 1024;
  map.camera.height_px = 512;
  map.camera.model = camera::Equirectangular{};
  map.camera.robot_from_camera_translation_m = {0.0, 0.0, 1.2};
  map.camera.robot_from_camera_rotation = Eigen::Quaterniond(0.5, -0.5, 0.5, -0.5);
  map.feature_config_id = "hw1-sample";
  for (int i = 0; i < 3; ++i) {
    map::MapImage image{ImageId("tour/0000" + std::to_string(i) + ".jpg"), 1'000'000 * i, {}};
    if (i < 2) image.odometry = Pose2{0.4 * i, 0.1, -0.2 * i};
    map.images.push_back(image);
  }
  const auto place = [&](const char* id, int prototype, std::vector<int> members) {
    map::Place made;
    made.id = PlaceId(id);
    made.prototype = map.images[static_cast<std::size_t>(prototype)].id;
    for (const int member : members) made.members.push_back(map.images[static_cast<std::size_t>(member)].id);
    made.appearances.push_back(random_appearance(20, static_cast<unsigned>(prototype)));
    return made;
  };
  map.places = {place("p1", 0, {0, 1}), place("p2", 2, {2})};
  map.places[1].label = "kitchen";
  map.edges = {{PlaceId("p1"), PlaceId("p2"), 0.5, -0.25, 1.5, map::LengthSource::kOdometry, 0.9, 64, false, false,
                map::Decider::kMethod},
               {PlaceId("p2"), PlaceId("p1"), std::nullopt, std::nullopt, 1.5, map::LengthSource::kUnknown, 0.1, 0,
                true, true, map::Decider::kPerson}};
  map::Hypothesis hypothesis;
  hypothesis.prototype_a = map.images[0].id;
  hypothesis.prototype_b = map.images[2].id;
  hypothesis.similarity = 0.4;
  hypothesis.masses_before = {0.3, 0.45, 0.25};
  hypothesis.masses_after = {0.1, 0.8, 0.1};
  hypothesis.support = 0.1;
  hypothesis.plausibility = 0.2;
  hypothesis.decision = map::Decision::kRejected;
  map.hypotheses = {hypothesis};
  map::Shortcut shortcut;
  shortcut.image_a = map.images[0].id;
  shortcut.image_b = map.images[2].id;
  shortcut.bearing_rad = 0.5;
  shortcut.turn_rad = -0.25;
  shortcut.back_bearing_rad = -2.5;
  shortcut.length_m = 2.5;
  shortcut.way_m = 9.75;
  shortcut.clear_m = 1.25;
  shortcut.confidence = 0.875;
  shortcut.inliers = 48;
  shortcut.state = map::ShortcutState::kRejected;
  shortcut.by = "anna";
  map.shortcuts = {shortcut};
  map.destinations = {{DestinationId("d1"), PlaceId("p2"), map.images[2].id, "kitchen", random_appearance(15, 9)}};
  map::Edit edit;
  edit.kind = map::EditKind::kRename;
  edit.image_a = map.images[2].id;
  edit.text = "kitchen";
  edit.images = {map.images[2].id};
  edit.by = "anna";
  edit.t_us = 1'700'000'000'000'000;
  edit.change = 1;
  map.edits = {edit};
  map.settled_edits = 1;
  map.next_place_number = 3;
  map.next_destination_number = 2;
  map.build_seconds = 1.25;
  return map;
}

}  // namespace homeward::testing
