// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "core/pose2.hpp"
#include "driving/bearing_votes.hpp"
#include "driving/pose_hypotheses.hpp"
#include "driving/view_track.hpp"
#include "driving/visual_path.hpp"
#include "features/appearance.hpp"
#include "homing/home_vector.hpp"
#include "homing/visual_homing.hpp"
#include "tracking/tracking_frame.hpp"

namespace homeward::driving {

/// No more probable than that is where the robot is by what others say alone: they have seen the same pictures, and two
/// halves of a building may look alike.
inline constexpr double kMostOfOthersWord = 0.85;

struct FollowConfig {
  homing::HomingConfig homing;
  homing::VisualHomingConfig visual;
  ViewTrackConfig track;
  PoseHypothesesConfig pose;
  double pass_m = 0.5;     // a view on the way is passed within this distance
  double abreast_m = 1.1;  // or when the robot is level with it within this one
  // A view that the robot is believed to be near to: what stands against its being another place that looks alike.
  double path_odds = 4.0;  // the odds of an answer's confidence are multiplied by these
  double believe = 0.5;    // below that an answer says nothing
  double sure = 0.8;       // confidence of a clear answer, after that
  int sure_inliers = 24;
  int look_along = 3;         // views of the path that the robot may be at, before and after the one homed to
  int most_compared = 10;     // views that one picture is compared with
  double blind_m = 1.6;       // so far the robot drives on by odometry when no view answers
  double reached_m = 0.03;    // the destination's view is reached within this distance, where it is measured
  double nearby_m = 1.0;      // the destination's view counts as reached or left behind only when it must be so near
  double alike_share = 0.35;  // of the features that agree where two views coincide
  double drive_above = 0.7;   // probability of where the robot is below which it looks around,
  double likelier = 0.5;      // and, where it has looked around in vain, below which it goes on looking
  double leap_above = 0.9;    // and from which on it goes on from quite another piece of its path
  double arrived_within_m = 0.5;      // of the destination the robot is when it says that it has arrived,
  double arrived_probability = 0.97;  // with at least this probability
};

/// What the server's belief names, which is of all pictures since long before the mission.
struct BelievedView {
  std::optional<int> view;  // of the place that it names; nothing: it is none that the mission tells of
  double probability = 0.0;
};

/// Where the robot is on its path, and where the view that it homes to lies in the frame of odometry.
struct FollowState {
  int index = 0;                       // of the view homed to
  std::optional<BelievedView> belief;  // the server's latest word,
  bool belief_lost = false;            // or that it does not know the robot's place in this map
  int furthest = 0;                    // and the last one that it was so far
  PoseHypotheses hypotheses;           // where the robot is on the map
  ViewTrack view;                      // where the view homed to lies
  Pose2 odometry;                      // at the latest picture
  bool begun = false;
  double blind_m = 0.0;                 // driven since the last answer that was believed
  double unheard_m = 1e9;               // and since the belief was heard
  std::optional<Pose2> ways_seen_from;  // odometry, when a sweep was last compared with the ways of tours
  homing::VisualHoming visual;          // to the view homed to
  int visual_index = -1;                // which one that is
  int contradictions = 0;               // local maps in a row that said something else than the estimate
  bool measured = false;                // the latest picture says in metres where the view homed to is
  int behind = 0;                       // answers in a row that say that the destination's view lies behind
  double alike = 0.0;          // share of the features that agree with the view homed to, at the latest picture,
  double most_alike = 0.0;     // and the most since this view is homed to: people may stand before the camera
  BearingVotes votes;          // of one view alone: where it is, while nothing but bearings to it says so
  bool looked_around = false;  // in vain: it goes on from where it is more probably than anywhere else
  int undecided = 0;           // pictures in a row that they were too few or too divided to say so
  int given_up = 0;            // how often what they said was followed as far as odometry alone, in vain
};

struct FollowResult {
  std::optional<homing::HomeVector> vector;  // the fresh answer of the view homed to, when there is one
  homing::TrackCounts tracks;                // of its features
  bool answered = false;                     // some view answered
  bool recognised = false;                   // something in the picture is of some view, wherever that is
  bool at_end = false;                       // the destination's view is reached
};

/// One picture further along a path of views: estimates where the robot is on the map (PoseHypotheses), homes to the
/// view of the path that comes next there (Goedemé 2007 §7), and says when the destination's own is reached. No picture
/// moves the robot along its path but through the estimate. A path of one view and no map is homed to by itself
/// (single_view.hpp).
FollowResult follow(FollowState& state, const VisualPath& path, const features::Appearance& seen,
                    const tracking::TrackingFrame& frame, const Pose2& odometry, const FollowConfig& config,
                    std::uint64_t seed);

/// One picture further by the tracked features of the view homed to alone.
FollowResult track(FollowState& state, const VisualPath& path, const tracking::TrackingFrame& frame,
                   const Pose2& odometry, const FollowConfig& config, std::uint64_t seed);

/// One sweep, of `odometry`: whether it shows something on ways that a tour drove, were the robot where it takes itself
/// to be. Only the way driven between two sweeps makes the second one say something new.
/// Ours: tour_ways.hpp.
void see_ways(FollowState& state, const VisualPath& path, std::span<const Eigen::Vector2d> points_m,
              const Pose2& odometry);

/// The probability of where the robot is from which on it drives along its path.
double drives_above(const FollowState& state, const FollowConfig& config);

/// The share of the destination's features that must have been recognised for it to be right here, whatever the
/// geometry says: more where no map says how far it is, less where the estimate is certain that the robot is there.
double share_when_here(const FollowState& state, const VisualPath& path, const FollowConfig& config);

/// Whether the next picture is better recognised (`follow`) than tracked (`track`).
bool wants_features(const FollowState& state);

/// Whether nothing but bearings, by what little is recognised of it, says where the view homed to lies.
bool is_unsure(const FollowState& state);

/// Where to drive now, robot frame: the view homed to, or nothing when too little is known of it.
std::optional<Eigen::Vector2d> goal(const FollowState& state, const Pose2& odometry, const FollowConfig& config);

}  // namespace homeward::driving
