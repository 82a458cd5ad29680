// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "camera/camera_config.hpp"
#include "core/enum_names.hpp"
#include "core/ids.hpp"
#include "core/pose2.hpp"
#include "core/time.hpp"
#include "features/appearance.hpp"
#include "map/appearance_list.hpp"

namespace homeward::map {

/// One picture of a tour, in tour order. Its pixels live elsewhere.
struct MapImage {
  ImageId id;
  std::optional<TimeUs> t_us;
  std::optional<Pose2> odometry;  // tour frame, drifts
};

/// A distinct place: images that show it, one of them the prototype.
struct Place {
  PlaceId id;
  std::string label;  // empty unless a person named it or a tour mark did
  ImageId prototype;
  std::vector<ImageId> members;  // tour order, the prototype among them
  AppearanceList appearances;    // the prototype's first; later: by night, ...
};

/// What an edge's length was taken from.
enum class LengthSource {
  kUnknown,     // nobody measured it: an edge that a person drew
  kOdometry,    // metres
  kTourTime,    // how long the tour took for it, at the pace at which people are guided
  kTourImages,  // how many pictures the tour took for it
};

/// Who made an edge, or decided on a hypothesis.
enum class Decider { kMethod, kPerson };

inline constexpr EnumNames<Decider, 2> kDeciderNames({"method", "person"});

/// A drivable transition seen on a tour or added by a person.
struct Edge {
  PlaceId from;
  PlaceId to;
  std::optional<double> bearing_rad;  // direction of `to` in `from`'s prototype frame
  std::optional<double> turn_rad;     // prototype heading of `to` minus that of `from`
  double length_m = 1.0;              // rough; how rough, `length_from` says
  LengthSource length_from = LengthSource::kUnknown;
  double confidence = 0.0;  // that the bearing is right within 15 degrees
  int inliers = 0;          // features that both prototypes see and that one motion explains
  bool weak = false;        // homing along it is likely to fail
  bool blocked = false;     // by a person or because driving failed
  Decider by = Decider::kMethod;
  bool shortcut = false;  // no tour drove it: an accepted Shortcut
};

enum class ShortcutState { kProposed, kAccepted, kRejected };

/// A straight way that no tour drove, between the prototypes of two places, with what speaks for it. Driven only once a
/// person has accepted it: then both directions are edges of the map.
struct Shortcut {
  ImageId image_a;
  ImageId image_b;
  double bearing_rad = 0.0;       // of the second viewpoint in the first picture's frame, as the two pictures say
  double turn_rad = 0.0;          // second heading minus first
  double back_bearing_rad = 0.0;  // of the first viewpoint in the second picture's frame
  double length_m = 0.0;          // by the map's metric layout
  double way_m = 0.0;             // the shortest way over the map's edges when it was proposed
  double clear_m = 0.0;           // width that the sweeps of the tour saw free all along it
  double confidence = 0.0;        // that the pictures' bearings are right within 15 degrees
  int inliers = 0;                // features that both pictures see and that one motion explains
  ShortcutState state = ShortcutState::kProposed;
  std::string by = "method";  // or the person who decided
};

/// Dempster-Shafer masses over {true, false, unknown}; they sum to 1.
struct Masses {
  double is_true = 0.0;
  double is_false = 0.0;
  double unknown = 1.0;
};

enum class Decision { kAccepted, kRejected, kUndecided };

/// "These two subclusters are one place": a loop-closing hypothesis with all its evidence (Goedemé 2006 §3.4-3.6).
struct Hypothesis {
  ImageId prototype_a;
  ImageId prototype_b;
  double similarity = 0.0;  // s_V in [0,1]
  Masses masses_before;
  Masses masses_after;
  double support = 0.0;
  double plausibility = 1.0;
  Decision decision = Decision::kUndecided;
  Decider by = Decider::kMethod;
};

/// What a person picks and what arrival is measured to. Docking heading = the heading of `image`.
struct Destination {
  DestinationId id;
  PlaceId place;
  ImageId image;
  std::string label;
  features::Appearance appearance;
  std::string pictogram = {};  // by which its card is known, one of kPictograms; empty: as its label suggests
};

/// Spreads measured on the map, used by localisation (Goedemé 2007 §5).
struct MotionStatistics {
  double hop_spread = 1.0;       // graph distance between consecutive tour images, root mean square, >= 0.5
  double distance_spread = 1.0;  // of the visual distance D within a place
  double distance_scale = 1.0;   // D0 in s = 1/(1 + D/D0)
};

/// How the share of a belief that a place and its neighbours hold becomes the probability of being there: a logistic
/// function of its log odds. Learnt on the map's own tours; the defaults take the share as it is.
struct BeliefCalibration {
  double offset = 0.0;
  double slope = 1.0;
};

/// Their numbers are kept in files: new ones come last.
enum class EditKind {
  kRename,
  kMerge,
  kSplit,
  kDelete,
  kMove,
  kAddEdge,
  kRemoveEdge,
  kBlockEdge,
  kDecide,
  kDecideShortcut,
  kAddDestination,
  kRemoveDestination,
  kNameDestination,
  kSetPictogram,
  kSetDestinationPicture,
  kSetAside
};
inline constexpr std::size_t kEditKinds = 16;

/// What two pictures told of the way between the places whose prototypes they are; each found it for itself.
struct SeenWay {
  ImageId from;
  ImageId to;
  std::optional<double> bearing_rad;  // nothing: no motion explains what both see
  double turn_rad = 0.0;
  double confidence = 0.0;
  int inliers = 0;
  bool operator==(const SeenWay&) const = default;
};

/// What came of an edit when it was first applied. Applied again to the same map it gives the same, without pictures.
struct EditFindings {
  std::string made;                 // id of the place or destination that it made
  std::vector<ImageId> prototypes;  // that it chose for what is left of a place and for what became one
  AppearanceList appearances;       // of the pictures that it looked at, which became prototypes or destinations
  AppearanceList learnt;            // since then, by the place that it made
  std::vector<SeenWay> ways;
  bool operator==(const EditFindings&) const = default;
};

/// One edit by a person, keyed to images so that it outlives a rebuild.
struct Edit {
  EditKind kind = EditKind::kRename;
  ImageId image_a;   // any image of the first place concerned (or the first prototype of a hypothesis, or the image of
                     // the destination)
  ImageId image_b;   // of the second one, where there is one; the new image of a destination
  std::string text;  // the new label for kRename, kAddDestination and kNameDestination, the new pictogram, "accept" or
                     // "reject" for kDecide and kDecideShortcut, "true" or "false" for kBlockEdge, the kind of doubt
                     // for kSetAside
  std::vector<ImageId> images;  // for kSplit and kMove: the images that go
  std::string by;               // user name
  TimeUs t_us = 0;
  bool undone = false;
  std::int64_t change = 0;  // edits of one request have the same, from 1: they are undone and redone together
  bool redoable = false;    // undone, and nothing was edited since
  std::string lost = {};    // why the map could not keep it when it was last rebuilt; empty: it has it
  EditFindings found = {};

  bool operator==(const Edit&) const = default;
};

struct MapPath;  // taught_path.hpp

/// A map: places joined by drivable edges, and why it is so. Plain data; algorithms are in graph.hpp.
struct TopologicalMap {
  int version = 1;  // of this structure
  std::string name;
  std::int64_t revision = 1;  // rises with every change; missions and paths name it
  camera::CameraConfig camera;
  features::FeatureConfig feature_config;
  std::string feature_config_id;
  std::vector<MapImage> images;  // all images of all tours, tour order
  std::vector<Place> places;
  std::vector<Edge> edges;  // directed
  std::vector<Hypothesis> hypotheses;
  std::vector<Shortcut> shortcuts;
  std::vector<Destination> destinations;
  MotionStatistics motion;
  BeliefCalibration calibration;
  std::vector<Edit> edits;             // oldest first
  std::int64_t next_place_number = 1;  // ids are never reused
  std::int64_t next_destination_number = 1;
  double build_seconds = 0.0;
  /// Places, edges, hypotheses, shortcuts and destinations as they were without the edits of the log, from
  /// `settled_edits` on: what the map is comes of applying those that stand to this (mapping/edit_log.hpp). Null where
  /// nothing was edited. Of its other members none counts.
  std::shared_ptr<const TopologicalMap> unedited = nullptr;
  std::size_t settled_edits = 0;  // how many of the log, the oldest, cannot be told from what was built any more
  /// Where the map was taught as a path for an ordinary camera: how it is repeated from key image to key image. Null
  /// elsewhere.
  std::shared_ptr<const MapPath> path = nullptr;
};

}  // namespace homeward::map
