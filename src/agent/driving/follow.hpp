// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "agent/driving/bearing_votes.hpp"
#include "agent/driving/view_track.hpp"
#include "core/pose2.hpp"
#include "features/appearance.hpp"
#include "homing/home_vector.hpp"
#include "homing/visual_homing.hpp"
#include "tracking/tracking_frame.hpp"
#include "wire/link_messages.hpp"

namespace homeward::agent {

/// The views to pass one after the other; the last one is the destination's own.
struct VisualPath {
  std::vector<features::Appearance> views;
  std::vector<std::optional<wire::PathEdge>> edges;  // from each view to the next; as many as views
};

struct FollowConfig {
  homing::HomingConfig homing;
  homing::VisualHomingConfig visual;
  ViewTrackConfig track;
  double pass_m = 0.5;     // a view on the way is passed within this distance
  double abreast_m = 1.1;  // or when the robot is level with it within this one
  // A view of the path is met where the path leads: what stands against its being another place that looks alike.
  double path_odds = 4.0;  // the odds of an answer's confidence are multiplied by these
  double sure = 0.8;       // confidence of a clear answer, after that
  int sure_inliers = 24;
  double believe = 0.5;       // below that an answer says nothing
  int look_ahead = 3;         // views tried beyond the present one
  int look_back = 3;          // and before it, when none of these answers
  double blind_m = 1.6;       // so far the robot drives on by odometry when no view answers
  double reached_m = 0.03;    // the destination's view is reached within this distance, where it is measured
  double nearby_m = 1.0;      // the destination's view counts as reached or left behind only when it must be so near
  double alike_share = 0.35;  // of the features that agree where two views coincide
};

/// Which view the robot homes to, and where the views lie in the frame of odometry.
struct FollowState {
  int index = 0;                  // of the view homed to
  int furthest = 0;               // and the last one that it was so far
  std::vector<ViewTrack> tracks;  // one for each view
  Pose2 odometry;                 // at the latest picture
  double blind_m = 0.0;           // driven since the last answer that was believed
  homing::VisualHoming visual;    // to the view homed to
  int visual_index = -1;          // which one that is
  BearingVotes votes;             // where it is, while nothing but bearings to it says so
  int undecided = 0;              // pictures in a row that they were too few or too divided to say so
  int given_up = 0;               // how often what they said was followed as far as odometry alone, in vain
  bool measured = false;          // the latest picture says in metres where the view homed to is
  double heading_left_rad = 0.0;  // from the heading at `odometry` to that of the destination's view
  int behind = 0;                 // answers in a row that say that the destination's view lies behind
  double alike = 0.0;             // share of the features that agree with the view homed to, at the latest picture,
  double most_alike = 0.0;        // and the most since this view is homed to: people may stand before the camera
};

struct FollowResult {
  std::optional<homing::HomeVector> vector;  // the fresh answer of the view homed to, when there is one
  homing::TrackCounts tracks;                // of its features
  bool answered = false;                     // some view answered
  bool at_end = false;                       // the destination's view is reached
};

/// One picture further along a path of views: takes the answers of the view homed to and of those after it, keeps where
/// they lie, and passes on to the next view when one is reached or left behind (Goedemé 2007 §7, with the home vector
/// of each picture alone and its distance triangulated over odometry). A robot that went back, to make room for
/// somebody, and recognises none of them any more homes to one before them again.
FollowResult follow(FollowState& state, const VisualPath& path, const features::Appearance& seen,
                    const tracking::TrackingFrame& frame, const Pose2& odometry, const FollowConfig& config,
                    std::uint64_t seed);

/// One picture further by the tracked features of the view homed to alone.
FollowResult track(FollowState& state, const VisualPath& path, const tracking::TrackingFrame& frame,
                   const Pose2& odometry, const FollowConfig& config, std::uint64_t seed);

/// The share of the destination's features that must have been recognised for it to be right here, whatever the
/// geometry says: more where no map says how far it is.
double share_when_here(const VisualPath& path);

/// Whether the next picture is better recognised (`follow`) than tracked (`track`).
bool wants_features(const FollowState& state);

/// Whether nothing but bearings, by what little is recognised of it, says where the view homed to lies.
bool is_unsure(const FollowState& state);

/// Where to drive now, robot frame: the view homed to, or nothing when too little is known of it.
std::optional<Eigen::Vector2d> goal(const FollowState& state, const Pose2& odometry, const FollowConfig& config);

}  // namespace homeward::agent
