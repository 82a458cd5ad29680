// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/ids.hpp"
#include "core/pose2.hpp"
#include "core/range_sweep.hpp"
#include "core/result.hpp"
#include "core/time.hpp"
#include "map/plan_tie.hpp"
#include "wire/draft_json.hpp"
#include "wire/job_json.hpp"
#include "wire/map_info_json.hpp"
#include "wire/mission_json.hpp"
#include "wire/plan_json.hpp"
#include "wire/plan_pose_json.hpp"
#include "wire/role.hpp"
#include "wire/tour_json.hpp"

namespace homeward::db {

struct User {
  UserId id;
  std::string name;
  wire::Role role = wire::Role::kViewer;
  std::string password_hash;  // Argon2id, as libsodium writes it
  TimeUs created_us = 0;
};

/// A signed-in browser.
struct Session {
  std::string hash;  // of the secret in the cookie
  UserId user;
  TimeUs created_us = 0;
  TimeUs expires_us = 0;
};

/// What a program signs in with.
struct Token {
  std::string id;
  std::string name;
  std::string hash;  // of the secret
  wire::Role role = wire::Role::kRobot;
  std::optional<RobotId> robot;  // the one that it speaks for
  TimeUs created_us = 0;
  std::optional<TimeUs> expires_us;  // nothing: never
};

struct Tour {
  TourId id;
  std::string name;
  std::string camera;  // camera.json
  bool complete = false;
  TimeUs created_us = 0;
  std::int64_t images = 0;
  std::vector<std::int64_t> missing;    // numbers below the highest one that no picture has; the first 100
  std::optional<std::string> uploader;  // a program: the robot that its token is for, or the token; nothing: a person
};

enum class ImageType { kJpeg, kPng };

struct TourImage {
  std::int64_t number = 0;  // place in the tour, from 0
  std::string file;         // name within the tour
  ImageType type = ImageType::kJpeg;
  std::optional<TimeUs> t_us;
  std::optional<Pose2> odometry;
  std::string sha256;  // hexadecimal
  std::int64_t size = 0;
};

/// What a range sensor saw with an image of a tour.
struct TourSweep {
  std::int64_t number = 0;  // of the image
  std::string file;         // its name within the tour; empty: not checked
  RangeSweep sweep;
};

enum class PutImage { kNew, kSame, kConflict };

struct MapRecord {
  MapId id;
  std::string name;
  wire::MapState state = wire::MapState::kBuilding;
  std::int64_t revision = 0;  // 0 until there are contents
  std::int64_t places = 0;
  std::int64_t images = 0;
  std::vector<TourId> tours;  // in the order given
  std::optional<std::string> feature_config_id;
  TimeUs created_us = 0;
  wire::RefineMode refine = wire::RefineMode::kAsk;
  bool path = false;                           // taught as a path, by one tour (pipeline/teach_path.hpp)
  std::optional<wire::MapPlanInfo> plan = {};  // that it is tied to
};

/// Which version of a plan a map is tied to, and where.
struct MapPlanRecord {
  MapId map;
  wire::PlanId plan;
  std::int64_t version = 1;
  TimeUs tied_us = 0;
  std::string author;
  std::vector<map::PlanPin> pins;
};

struct DriveSight {
  PlaceId place;                         // that the robot was sure of; empty: of none, and nothing else is kept
  std::vector<std::uint8_t> appearance;  // wire/appearance_blob.hpp
};

/// What the map of a mission that arrived may learn from, in driving order.
struct Drive {
  MissionId mission;
  MapId map;
  std::string feature_config_id;
  TimeUs created_us = 0;
  std::vector<DriveSight> sights;
};

/// How missions fared on a way of a map.
struct WayDrives {
  PlaceId from;
  PlaceId to;
  std::int64_t driven = 0;
  std::int64_t failed = 0;
  TimeUs last_driven_us = 0;  // 0: never
  TimeUs last_failed_us = 0;
};

/// From one place to the next.
struct DrivenWay {
  PlaceId from;
  PlaceId to;
};

/// Edits of a map that are tried before they count.
struct DraftRecord {
  wire::DraftId id;
  MapId map;
  std::string name;    // empty: nobody named it
  std::string author;  // who began it
  TimeUs created_us = 0;
  std::int64_t version = 1;
  std::vector<map::Edit> edits;           // changes numbered from 1; without what came of them
  std::optional<wire::DraftCheck> check;  // the latest
  bool checked = false;                   // it has ended, and its findings are kept
};

/// What a build leaves beside its map.
struct MapBuild {
  std::string report;                    // HTML; empty: it could not be drawn
  std::vector<std::uint8_t> similarity;  // wire/similarity_blob.hpp
};

/// How alike the pictures of a map are, as its latest build compared them.
struct BuildSimilarity {
  std::int64_t revision = 0;        // that the build made
  std::vector<std::uint8_t> bytes;  // wire/similarity_blob.hpp
};

/// What changes in one step with a map's contents.
struct AlongWithContents {
  std::vector<TourId> new_tours;            // that the map is made from as well from now on
  std::vector<MissionId> used_drives;       // that the map has learnt from
  std::optional<wire::JobView> job = {};    // as it is afterwards
  std::optional<wire::DraftId> draft = {};  // that was published and is none any more
  std::optional<MapBuild> build = {};       // in place of that of an earlier build
};

/// Whether the store can keep what it is given, and has what it was given.
struct StoreCondition {
  std::optional<Error> database;         // why it does not answer
  std::int64_t free_bytes = 0;           // on its disk, for this process
  std::int64_t missing_files = 0;        // map files and pictures that rows name and that are not there
  std::vector<std::string> missing;      // the first of them, by their names in the data folder
  std::vector<std::string> quarantined;  // what was there at the start and no row names, where it is now
};

struct RobotRecord {
  RobotId id;
  std::string name;
  std::optional<MapId> map;
  std::int64_t epoch = 0;
  TimeUs created_us = 0;
};

/// Who asked for what, under which Idempotency-Key.
struct RequestKey {
  std::string caller;
  std::string route;  // method and path
  std::string key;
};

struct StoredAnswer {
  int status = 0;
  std::string body;
  std::string request_hash = {};  // of the request's body; empty: not known
};

}  // namespace homeward::db
