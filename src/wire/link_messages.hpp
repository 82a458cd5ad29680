// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "camera/camera_config.hpp"
#include "core/ids.hpp"
#include "core/pose2.hpp"
#include "core/result.hpp"
#include "core/time.hpp"
#include "wire/exploration_json.hpp"
#include "wire/kept_exploration_json.hpp"
#include "wire/lease_durations.hpp"
#include "wire/reason.hpp"

namespace homeward::wire {

/// The agent link (proto/asyncapi.yaml): each message one CBOR map in one binary WebSocket message, with "type" and
/// "v".
inline constexpr int kLinkVersion = 6;
/// Version 1, which older recordings hold, has words instead of reasons; version 2 knows no explorations, version 3 no
/// companions, version 4 nothing of how their floors lie to each other, version 5 no paths that were taught.
inline constexpr int kOldestLinkVersion = 1;
inline constexpr std::size_t kMaxLinkMessageBytes = 32UL * 1024 * 1024;

/// What a permit to drive is tied to. A later epoch (lease hand-over, server restart, reconnect) beats every earlier
/// one; within an epoch a later sequence number beats.
struct Order {
  std::int64_t epoch = 0;
  std::int64_t seq = 0;
  friend auto operator<=>(const Order&, const Order&) = default;
};

// From the agent.

inline constexpr double kMostRadius_m = 3.0;

struct Hello {
  std::string agent;  // "homeward-agent/" and its version
  std::string robot_name;
  std::string session;  // random for each start of the process
  camera::CameraConfig camera;
  double radius_m = 0.35;  // of the circle about its turning point that holds the whole body
  double max_speed_mps = 0.8;
  bool explores = false;  // it can map a building by itself
  bool repeats = false;   // it can follow a path that was taught (RepeatOrder)
};

struct Frame {
  std::int64_t seq = 0;
  TimeUs t_us = 0;
  std::vector<std::uint8_t> jpeg;
  std::optional<Pose2> odometry = std::nullopt;  // where it was taken, in a frame that stays as long as the session
};

/// "idle", "driving", "arrived", "stopped" (told to, or something went stale), "failed" (cannot go on).
enum class DriveState { kIdle, kDriving, kArrived, kStopped, kFailed };

struct HomeReport {
  double bearing_rad = 0.0;
  double confidence = 0.0;
  std::int64_t inliers = 0;
};

/// A place of the map and how probable it is by the robot's own estimate that it is there.
struct EstimateReport {
  PlaceId place;
  double probability = 0.0;
};

/// Whether this is the destination, which the robot stands beside and is not certain of.
struct QuestionReport {
  std::int64_t number = 1;  // what an answer names
  PlaceId place;
  std::string label;    // of the destination, for people
  double left_s = 0.0;  // so long it still waits
};

struct AgentStatus {
  std::int64_t seq = 0;
  TimeUs t_us = 0;
  DriveState state = DriveState::kIdle;
  std::optional<MissionId> mission;
  std::int64_t epoch = 0;
  std::int64_t path_index = 0;
  std::optional<Reason> reason;  // why it stopped or failed
  double speed_mps = 0.0;
  std::optional<HomeReport> home;
  std::optional<double> min_range_m;
  double vectors_per_s = 0.0;
  /// Of being within half a metre of the mission's destination, as of the latest picture of the drive. Nothing: not
  /// known.
  std::optional<double> arrival_probability = std::nullopt;
  std::optional<EstimateReport> estimate = std::nullopt;  // nothing: it is not sure enough to drive by it
  std::vector<EstimateReport> possible_places = {};       // where it may be, most probable first, at most 4
  std::optional<QuestionReport> question = std::nullopt;
  /// How often it noticed that it was moved without its wheels, since its program began.
  std::int64_t displaced = 0;
  /// The mission has failed because the robot was elsewhere than on its way, or not sure where it is; no part of the
  /// way is to blame.
  bool astray = false;
};

/// The driver was commanded to zero because of `stop_id`.
struct Stopped {
  std::string stop_id;
  TimeUs t_us = 0;
};

struct MissionRefused {
  MissionId mission;
  Order order;
  Reason reason;
};

/// How far an exploration is.
struct Explored {
  ExplorationReport exploration;
};

// From the agent of a robot to that of its companion: the server passes them on as they are.

inline constexpr std::size_t kMostCompanionBytes = 2UL * 1024 * 1024;  // of an appearance

/// A picture of the sender's exploration.
struct CompanionView {
  ExplorationId exploration;
  std::int64_t index = 0;  // in it, from 0
  KeptView view;
  std::vector<std::uint8_t> appearance;  // appearance_blob.hpp; empty: not told
};

inline constexpr std::size_t kMostCompanionAgreements = 32;

/// A picture of the sender's exploration and one of the receiver's, and how the places lie to each other.
struct CompanionAgreement {
  std::int64_t own = 0;     // the sender's, from 0
  std::int64_t others = 0;  // the receiver's
  Pose2 own_from_others;
  bool own_looked = false;  // the sender's was held against the receiver's earlier ones, else the other way round
};

/// Where the sender is, and what it has got.
struct CompanionState {
  ExplorationId exploration;
  std::int64_t pictures = 0;                   // that the sender has taken
  Pose2 odometry;                              // as that of its newest picture
  std::optional<Eigen::Vector2d> target_m;     // driven to, its own frame; nothing: none
  bool drives = false;                         // it explores, and has not ended
  std::int64_t has = 0;                        // of the receiver's pictures, from the first on without a gap
  std::vector<CompanionAgreement> agreements;  // that the sender has found, oldest first (from version 5 on)
};

// From the server.

struct Welcome {
  std::string server;
  RobotId robot;
  std::int64_t epoch = 0;
  std::int64_t frame_period_ms = kFrameEvery_ms;
};

/// The way from one place of a path to the next, as the map knows it; what is unknown is nothing.
struct PathEdge {
  std::optional<double> bearing_rad;  // of the next prototype in this prototype's frame
  std::optional<double> turn_rad;     // next heading minus this one
  std::optional<double> length_m;
  bool weak = false;      // homing along it is likely to fail
  bool shortcut = false;  // no tour drove it: slowly
};

struct PathPlace {
  PlaceId place;
  ImageId image;                         // its prototype
  std::vector<std::uint8_t> appearance;  // appearance_blob.hpp
  std::optional<PathEdge> next;          // nothing at the last place
};

/// A view of the map and where it was taken.
struct PlacedView {
  PlaceId place;
  ImageId image;
  Pose2 map_from_view;
  std::vector<std::uint8_t> appearance;  // appearance_blob.hpp
};

/// The part of the map around a path, for the robot to know by itself where it is: its frame is this message's own.
struct Surroundings {
  static constexpr std::size_t kMostWays = 8000;
  std::vector<Pose2> path;         // of the prototypes of the path, as many
  Pose2 final_pose;                // of the destination's own picture
  double spread_m = 0.15;          // standard deviation of where a view lies among those around it
  double start_probability = 1.0;  // that the robot is where the path begins
  std::vector<PlacedView> nearby;  // not on the path: beside it, or looking like a place of it
  // That a tour drove, straight from one view to another: their numbers, those of the path first, then the nearby ones.
  std::vector<std::array<int, 2>> ways;
};

struct MissionOrder {
  MissionId mission;
  Order order;
  MapId map;
  std::int64_t revision = 0;
  std::string feature_config_id;
  std::int64_t valid_for_ms = 0;
  double speed_limit_mps = 0.0;
  std::string label;            // of the destination, for people
  std::vector<PathPlace> path;  // from the robot's place to the last one
  ImageId final_image;
  std::vector<std::uint8_t> final_appearance;  // what arrival is measured to
  bool dock = false;                           // turn to the heading of final_image at the end
  std::optional<Surroundings> surroundings;    // nothing where the map does not know where its places lie
};

struct Permit {
  MissionId mission;
  Order order;
  std::int64_t valid_for_ms = 0;
};

struct StopOrder {
  std::string stop_id;
  std::int64_t epoch = 0;
  std::optional<Reason> reason;  // nothing: whoever stops it says none
  std::string by;
  std::int64_t seq = 0;  // orders up to this one are void: a stop overtakes those that wait to be sent
};

struct BeliefReport {
  std::int64_t frame_seq = 0;
  std::optional<PlaceId> place;
  double probability = 0.0;
  bool lost = true;
};

/// What somebody says to a robot's question: evidence, no command.
struct Answer {
  MissionId mission;
  std::int64_t question = 1;  // its number
  bool here = false;          // whether the robot is where it asks about
};

/// An order to map what is around the robot; a permit as well.
struct ExploreOrder {
  MissionId mission;
  Order order;
  std::int64_t valid_for_ms = 0;
  double speed_limit_mps = 0.0;
  ExplorationId exploration;
  bool goes_on = false;                // with the exploration of that id that the robot has
  std::optional<double> limit_m;       // driven altogether
  std::optional<double> limit_s;       // explored altogether
  std::optional<double> back_after_s;  // from now on, until it is back where it began
};

/// An order to follow the path of a map that was taught as one (map::MapPath), from wherever on it the robot is; a
/// permit as well. The robot fetches the map itself.
struct RepeatOrder {
  MissionId mission;
  Order order;
  MapId map;
  std::int64_t revision = 0;
  std::int64_t valid_for_ms = 0;
  double speed_limit_mps = 0.0;
  std::string label;        // of the destination, for people
  ImageId image;            // of the tour: where it was taken the robot stops
  std::int64_t rounds = 0;  // so often it passes there first, where the path is closed
};

/// All that an exploration keeps off from now on.
struct Fences {
  ExplorationId exploration;
  std::vector<Fence> fences_m;
};

/// A paused exploration ends with what it has.
struct Finish {
  ExplorationId exploration;
};

/// With whose exploration that of the robot is shared from now on.
struct Companion {
  ExplorationId exploration;
  std::optional<ExplorationId> with;  // nothing: with none
};

struct LinkError {
  std::string code;
  std::string message;
};

using AgentMessage =
    std::variant<Hello, Frame, AgentStatus, Stopped, MissionRefused, Explored, CompanionView, CompanionState>;
using ServerMessage = std::variant<Welcome, MissionOrder, Permit, StopOrder, BeliefReport, Answer, ExploreOrder,
                                   RepeatOrder, Fences, Finish, Companion, CompanionView, CompanionState, LinkError>;

std::vector<std::uint8_t> encode(const AgentMessage& message);
std::vector<std::uint8_t> encode(const ServerMessage& message);

/// Strict: unknown types, keys and versions, wrong kinds and ranges are errors that name the field.
/// Errors: kInvalidInput, kUnsupportedFormat, kTooLarge.
Result<AgentMessage> decode_agent_message(std::span<const std::uint8_t> cbor);
Result<ServerMessage> decode_server_message(std::span<const std::uint8_t> cbor);

/// The same as JSON values, in which bytes are nlohmann binaries (the schemas of proto/ describe them as base64 text).
nlohmann::json to_json(const AgentMessage& message);
nlohmann::json to_json(const ServerMessage& message);
Result<AgentMessage> agent_message_from_json(const nlohmann::json& value);
Result<ServerMessage> server_message_from_json(const nlohmann::json& value);

std::string_view drive_state_name(DriveState state);
nlohmann::json question_to_json(const QuestionReport& question);

}  // namespace homeward::wire
