// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "camera/camera.hpp"
#include "core/image.hpp"
#include "core/pose2.hpp"
#include "core/range_sweep.hpp"
#include "core/result.hpp"
#include "linemodel/expected_view.hpp"
#include "linemodel/image_line.hpp"
#include "linemodel/monte_carlo.hpp"
#include "linemodel/picture_lines.hpp"
#include "linemodel/place_hypotheses.hpp"
#include "linemodel/plan.hpp"
#include "linemodel/plan_floor.hpp"
#include "linemodel/visible_lines.hpp"

namespace homeward::linemodel {

struct PlanTrackerConfig {
  MeasureConfig measure;
  LineDetection detection;
  VisibilityConfig visibility;
  MonteCarloConfig monte_carlo;
  PlaceConfig places;
  double gain = 20.0;               // of the score in a weight's logarithm
  double independent_m = 0.3;       // after so much driving a picture counts as much; before, in proportion
  double wide_gain = 9.0;           // the same while it is not known where the robot is, ...
  double wide_independent_m = 0.6;  // ... as neighbouring pictures err alike where furniture is not where it is drawn
  double wide = 2.5;                // times as tolerant is the measure meanwhile
  double doubted_lines = 15.0;      // a score counts as if so many lines more were expected, ...
  double doubted_score = 0.5;       // ... confirmed by this share: few lines say little
  double known_spread_m = 0.6;      // less spread than this: it is known where the robot is
  double still_share = 0.6;         // of the weight at one place keeps it known; to become so again it takes
  double known_share = 0.9;         // of the weight there, not far from where it was known to be
  double most_doubted_m = 3.0;      // driven without that: it is looked for everywhere;
  double most_unfound_m = 12.0;     // so much after a start so wide that it was not known at first
  std::size_t most_places = 100;    // that are told apart ...
  double places_share = 0.75;       // ... once particles that were everywhere are so many in them, ...
  double least_search_m = 2.0;      // ... not before so much driving, and after
  double most_search_m = 8.0;       // so much however many they are
  double evidence_share = 0.07;     // by which the mean of the log odds at the estimate follows each picture
  double still_evidence = 0.45;     // less than this mean, and of agreement than `still_agreement`: the robot is not
                                    // said to be on this plan any more; ...
  double least_evidence = 0.55;     // ... to be so again it takes this
  double still_agreement = 0.9;     // of plan and pictures both ways
  double least_judged_m = 3.0;      // driven at the best of several places with less agreement than ...
  double still_at_places = 1.05;    // ... this: it is said to be another plan; to be this one again takes a place
  double least_at_places = 1.1;     // with so much, ...
  double least_again_m = 6.0;       // ... after so much driving, or one that is ahead of all others;
  double least_at_place = 1.0;      // for that, it has to agree so itself; with less at the best, others are looked for
  double in_wall_evidence = 0.3;    // times that of a place where a robot cannot be
  double wrong_evidence = 0.4;      // less, though it seems known where it is: it is looked for anew
  int most_wrong_pictures = 20;     // before that
  int doubtful_lines = 8;           // fewer expected lines say nothing of whether it is this plan
  double sweep_height_m = 0.3;      // of the range sensor over the floor
};

/// Settings for one measure, by which gains its scores tell poses apart best (docs/experiments/plan_localisation.md).
PlanTrackerConfig tracker_config(LineMeasure measure);

/// Why a tracker does not say where the robot is.
enum class PlanLost { kNo, kSearching, kAmbiguous, kNotInPlan };

/// Where on the plan one picture was taken.
struct PlanEstimate {
  Pose2 pose;  // of the robot, in the plan's frame; the best guess where it is lost
  double spread_m = 0.0;
  double spread_rad = 0.0;
  double share = 0.0;               // of the belief that is there
  std::vector<PoseCluster> others;  // where it may be as well, most probable first
  std::size_t particles = 0;
  int lines_seen = 0;       // in the picture
  int lines_expected = 0;   // by the plan, from `pose`
  int lines_confirmed = 0;  // of these, by the picture
  double log_odds = 0.0;    // of the picture at `pose` (PictureLines::log_odds)
  double evidence = 0.0;    // their mean of late: whether it is this plan at all; 0 until
                            // places are told apart
  double explained = 0.0;   // of the picture's lines at `pose`, of being drawn (PlanTracker::explained)
  PlanLost lost = PlanLost::kSearching;
};

/// A line of the plan that should be in the last picture.
struct JudgedLine {
  PlanLine line;           // what of it is visible around there
  bool confirmed = false;  // by an edge of the picture
};

/// Where a robot is on a drawn plan, picture by picture (Fichtner & Grossmann 2003): Monte Carlo localisation whose
/// particles are weighed by how well the lines of the picture confirm those that the plan lets expect, and by a sweep
/// of ranges where there is one (likelihood field; Thrun, Burgard & Fox 2005, section 6.4). Started anywhere, particles
/// come down to some places first, which are then followed apart until one is ahead of all others
/// (PlaceHypotheses); while none of them agrees with what is seen, searches go on beside them, and what these find
/// joins them. Not thread-safe.
class PlanTracker {
 public:
  /// Errors: kEmptyInput (a plan without lines, or without floor to be on), kInvalidInput (a camera that is not above
  /// the floor), those of Camera::create and PlanFloor::of.
  static Result<PlanTracker> create(const Plan& plan, const camera::CameraConfig& camera,
                                    const PlanTrackerConfig& config);

  /// It may be anywhere on the plan. This is how it begins.
  void start_anywhere();
  /// It is about there. With a wide spread it is not yet known where.
  void start_at(const Pose2& pose, double spread_m, double spread_rad);

  /// Odometry counts anew: until the next picture the robot is taken to have moved anywhere within half a metre.
  void restart_odometry();

  /// The next picture, where odometry says it was taken (any frame, the same for all), and the sweep taken there.
  /// Without odometry the robot is taken to have moved anywhere within half a metre. Errors: those of detect_lines.
  Result<PlanEstimate> update(const Image& picture, const std::optional<Pose2>& odometry,
                              const std::optional<RangeSweep>& sweep);

  [[nodiscard]] const std::vector<Particle>& particles() const {
    return places_.empty() ? monte_carlo_.particles() : places_.particles();
  }
  /// The places that are told apart; none while particles are everywhere, or at one place.
  [[nodiscard]] const PlaceHypotheses& places() const { return places_; }
  /// The lines of the last picture, and those expected from a pose.
  [[nodiscard]] const std::vector<ImageLine>& picture_lines() const { return lines_; }
  /// How many of them reach above the horizon.
  [[nodiscard]] std::size_t lines_above() const { return above_.size(); }
  /// What should be in the last picture if it was taken at `pose`.
  std::vector<JudgedLine> judged(const Pose2& pose);
  [[nodiscard]] const Expectation& expectation() const { return expectation_; }
  ExpectedView expected(const Pose2& pose);
  /// The other way about: the mean over the lines of the last picture that reach above the horizon of the logarithm of
  /// how much likelier it is that each is drawn, or is not, if it was taken at `pose` than by chance; 0 where there is
  /// none. On the plan of another building enough of what is drawn is met by chance, but little of what is seen is
  /// drawn. Of floors no plan shows the pattern. Ours.
  double explained(const Pose2& pose);
  [[nodiscard]] const PlanFloor& floor() const { return floor_; }

 private:
  PlanTracker(const Plan& plan, const camera::Camera& camera, PlanFloor floor, const PlanTrackerConfig& config);

  /// Moves the particles; how far the robot drove and turned since the last picture, as metres.
  double move(const std::optional<Pose2>& odometry);
  /// It may have moved anywhere within half a metre.
  void spread_particles();
  [[nodiscard]] MonteCarlo::Fit fit(const PictureLines& lines, double gain, const RangeSweep* sweep, const Pose2& pose);
  [[nodiscard]] double sweep_log_weight(const RangeSweep& sweep, const Pose2& pose) const;
  void weigh_everywhere(double driven_m, const RangeSweep* sweep);
  void weigh_places(const PictureLines& lines, double driven_m, const RangeSweep* sweep);
  void look_above();
  [[nodiscard]] double explained(const ExpectedView& view) const;
  [[nodiscard]] PlaceHypotheses::Evidence evidence_at(const Pose2& pose, const PictureLines& lines);
  [[nodiscard]] PlanEstimate estimate(const PictureLines& lines, double driven_m);
  [[nodiscard]] PlanEstimate estimate_places(const PictureLines& lines, double driven_m);
  /// What is said of the first of these places, and of the others that are believed.
  [[nodiscard]] PlanEstimate said_of(std::span<const PoseCluster> places, double least_share,
                                     const PictureLines& lines);
  void take_up_places(double driven_m);
  /// The places to which particles that were everywhere have come down; none yet where they have not.
  [[nodiscard]] std::vector<PoseCluster> places_to_take_up(double searched_m) const;
  /// Goes on with a search beside the places; what it finds joins them.
  void search_beside(double driven_m);
  void follow(const PoseCluster& place, double evidence);
  void keep_known(const PlanEstimate& said, double driven_m);
  void follow_evidence(double log_odds, const PlanEstimate& said);

  PlanTrackerConfig config_;
  LineViews views_;
  Expectation expectation_;
  VisibleLines visible_;
  PlanFloor floor_;
  PlanSlice at_sweep_;
  MonteCarlo monte_carlo_;
  PlaceHypotheses places_;
  float built_height_m_;
  std::optional<Pose2> last_odometry_;
  bool searching_ = true;          // particles were everywhere, or are at places told apart
  bool of_this_plan_ = true;       // as far as has been seen
  bool searching_beside_ = false;  // a search goes on beside the places that are told apart
  double searched_m_ = 0.0;        // driven since it began
  double unknown_m_ = 0.0;         // driven since it was known where the robot is
  double most_unknown_m_ = 0.0;    // of it; then it is looked for everywhere
  bool known_ = false;
  Pose2 known_at_;       // there it was when that was known last, and moved since
  double jump_m_ = 0.0;  // so far from there is another place
  double jump_rad_ = 0.0;
  double evidence_ = 0.0;
  double agreement_ = 0.0;  // of plan and pictures both ways at the estimate, mean of late
  int wrong_pictures_ = 0;
  std::vector<ImageLine> lines_;
  std::vector<HoughPoint> above_;  // of those that reach above the horizon
  ExpectedView view_;
};

}  // namespace homeward::linemodel
