// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "core/pose2.hpp"
#include "driving/bearing_evidence.hpp"
#include "driving/pose_hypotheses.hpp"
#include "driving/view_track.hpp"
#include "homing/home_vector.hpp"
#include "homing/visual_homing.hpp"

namespace homeward::driving {

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
  double since_belief_m = 1e9;          // and since the belief was applied
  std::optional<Pose2> ways_seen_from;  // odometry, when a sweep was last compared with the ways of tours
  homing::VisualHoming visual;          // to the view homed to
  int visual_index = -1;                // which one that is
  int contradictions = 0;               // local maps in a row that said something else than the estimate
  bool measured = false;                // the latest picture says in metres where the view homed to is
  int behind = 0;                       // answers in a row that say that the destination's view lies behind
  double alike = 0.0;          // share of the features that agree with the view homed to, at the latest picture,
  double most_alike = 0.0;     // and the most since this view is homed to: people may stand before the camera
  BearingEvidence bearings;    // of one view alone: where it is, while nothing but bearings to it says so
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

}  // namespace homeward::driving
