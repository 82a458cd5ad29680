// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "camera/camera.hpp"
#include "core/ids.hpp"
#include "core/image.hpp"
#include "core/pose2.hpp"
#include "core/range_sweep.hpp"
#include "core/result.hpp"
#include "linemodel/local_fit.hpp"
#include "linemodel/plan_tracker.hpp"
#include "localisation/localiser.hpp"
#include "map/plan_tie.hpp"

namespace homeward::pipeline {

struct PlanWitnessConfig {
  linemodel::PlanTrackerConfig tracker;
  double said_spread_m = 0.7;          // of where the robot stands, of a place that somebody said
  std::size_t said_particles = 6'000;  // that begin there, facing anywhere
  double reach_m = 3.0;                // a place may be the robot's if it is within so much of a particle,
  double beyond_nearest_m = 1.5;       // or farther off than the nearest place by no more than this
  double least_share = 0.02;           // of the particles, for a place to be possible
  double all_there_share = 0.5;        // of them, for it to be impossible by what is seen there
  double confident = 0.9;              // probability of a belief from where on it is looked into
  double least_log_odds = 0.3;         // of a picture where the particles are: less, and they are silent
  int least_lines = 8;                 // expected in a picture: fewer say nothing
  double place_reach_m = 2.0;          // how far from a disputed place the robot is looked for
  double odds_share = 0.4;             // by which the mean of a dispute follows each picture
  double least_odds = 0.0;             // of that mean, against the place: less, and they are silent
  double beaten_odds = -0.3;           // less than this after
  int beaten_pictures = 4;             // so many pictures of a dispute, and they begin anew at the place
  int most_disputed = 8;        // pictures on end, and they do so too: a belief that stays sure so long is seldom wrong
  double most_spread_m = 0.15;  // of particles, for a picture to be judged by: farther apart their mean is off
  double least_agreement = 0.15;  // of plan and picture where the particles are, both ways: less, and the robot may
                                  // have been carried off, ...
  double agreement_again = 1.0;  // ... until the mean of late is this much; and until they have agreed with beliefs for
  int carried_pictures = 2;      // `agreement_m`, they begin anew at a place that is disputed for so many pictures
  double least_mean = 0.8;       // of that mean, to dispute a place
  double agreement_share = 0.4;  // by which it follows each picture
  double most_jump_m = 1.5;      // of the particles, off what odometry says: they are trusted no longer
  int most_off_plan = 10;        // pictures on end of another building, it seems: they are trusted no longer
  double agreement_m = 5.0;      // driven side by side with sure beliefs: what was found from anywhere is trusted,
                                 // and nobody carried the robot off
  double most_confidence = 0.5;  // that a belief keeps whose place is impossible: nobody drives on an even chance
};

/// What the particles on a plan say of the place of a belief.
enum class PlanWord {
  kSilent,      // they do not know where the robot is, or not surely enough, or not where the place is
  kPossible,    // some are there
  kImpossible,  // they know where the robot is, and it is not there; or most were there, and what is seen is not
};

/// A witness for the belief over the places of a map that lies on a drawn plan: particles on the plan (PlanTracker),
/// fed with the same pictures and the same odometry. A place that none of them is near, of a belief that is sure of it,
/// is looked into: it is impossible if the edges of late fit where the particles are better than they fit anywhere
/// around the place. So it takes confidence from a belief and never gives any. It is silent while it does not know
/// where the robot is, and until it can be trusted: somebody said where the robot is, or, begun anywhere, the particles
/// have agreed with sure beliefs for some metres, as in a building whose rooms look alike they may be found in the
/// wrong one. Where the edges fit a disputed place better, the robot was carried there, and the particles begin anew at
/// it. A place that most particles are at is impossible too while pictures fit it hardly better than by chance: the
/// robot was carried off, and neither has noticed; or both have come to look alike again, so that it disputes nothing
/// until they have agreed for some metres. Ours. Not thread-safe.
class PlanWitness {
 public:
  /// `places`: of map::lay_on_plan. Errors: those of PlanTracker::create.
  static Result<PlanWitness> create(const linemodel::Plan& plan, const camera::CameraConfig& camera,
                                    const std::vector<map::PlacedOnPlan>& places, const PlanWitnessConfig& config = {});

  /// Nothing is known of where the robot is. This is how it begins.
  void start_anywhere();
  /// A person says that the robot is at one of these places; anywhere where none of them lies on the plan.
  void start_at(std::span<const PlaceId> places);

  /// The map was changed: its places lie elsewhere, or are others. The particles stay.
  void set_places(const std::vector<map::PlacedOnPlan>& places);
  /// Odometry counts anew, see linemodel::PlanTracker::restart_odometry.
  void restart_odometry();

  /// The next picture, see linemodel::PlanTracker::update; errors are its.
  Result<linemodel::PlanEstimate> update(const Image& picture, const std::optional<Pose2>& odometry,
                                         const std::optional<RangeSweep>& sweep = std::nullopt);
  /// What it says of the belief after the same picture; call it once for each, as agreement counts.
  PlanWord hear(const localisation::Belief& belief);

  /// A belief as it may be told: less confident where its place is impossible, else as it is.
  [[nodiscard]] localisation::Belief told(localisation::Belief belief, PlanWord word) const;

  /// Whether what the particles say counts.
  [[nodiscard]] bool trusted() const { return trusted_; }
  /// Whether a picture did not fit where the particles were, and those of late do not fit well again.
  [[nodiscard]] bool may_be_carried() const { return may_be_carried_; }
  /// By how much better the edges of late fit where the particles are than around the place that they dispute, as mean
  /// log odds of a line both ways (linemodel::LocalFit::agreement); nothing: they dispute none.
  [[nodiscard]] const std::optional<double>& odds_against_place() const { return odds_; }
  [[nodiscard]] const linemodel::PlanTracker& tracker() const { return tracker_; }

 private:
  PlanWitness(linemodel::PlanTracker tracker, const std::vector<map::PlacedOnPlan>& places,
              const PlanWitnessConfig& config);
  /// Of the particles, those for which the place may be where the robot is.
  [[nodiscard]] double share_near(const Eigen::Vector2d& place_m) const;
  [[nodiscard]] bool knows() const;
  /// Whether the particles have gone where odometry did.
  void follow(const std::optional<Pose2>& odometry);
  /// Whether the last picture fits where the particles are at all.
  void look_for_misfit();
  /// How well it fits there.
  [[nodiscard]] double agreement_here();
  /// No particle is near the place of a sure belief.
  PlanWord dispute(const Pose2& place);

  PlanWitnessConfig config_;
  linemodel::PlanTracker tracker_;
  std::unordered_map<PlaceId, Pose2> plan_from_place_;
  linemodel::PlanEstimate estimate_;
  std::optional<double> odds_;  // against the places of a dispute, mean of late; nothing: there is none
  int disputed_pictures_ = 0;
  int pictures_off_plan_ = 0;        // on end
  std::optional<double> agreement_;  // of pictures where the particles were, mean of late
  bool may_be_carried_ = false;
  bool was_suspected_ = false;  // of being carried, and beliefs have not agreed for long enough since
  std::optional<Pose2> last_odometry_;
  std::optional<Pose2> expected_;  // where the particles were known to be last, moved by odometry
  double step_m_ = 0.0;            // driven since the picture before
  double agreed_m_ = 0.0;          // driven while beliefs and particles agreed
  bool trusted_ = false;
};

}  // namespace homeward::pipeline
