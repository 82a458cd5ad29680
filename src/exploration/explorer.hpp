// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/pose2.hpp"
#include "core/range_sweep.hpp"
#include "exploration/companion.hpp"
#include "exploration/explored_floor.hpp"
#include "exploration/next_view.hpp"
#include "exploration/pose_graph.hpp"
#include "exploration/reach.hpp"
#include "features/appearance.hpp"
#include "geometry/sweep_alignment.hpp"

namespace homeward::exploration {

struct ExplorerConfig {
  geometry::SweepFilter filter;
  geometry::AlignmentConfig alignment;
  FloorConfig floor;
  ReachConfig reach;
  ViewConfig view;
  CompanionConfig companion;
  double picture_every_m = 0.38;    // driven on by so much, it takes the next picture
  double aligned_every_m = 0.2;     // and puts its sweep onto those before,
  double aligned_every_rad = 0.35;  // or turned by so much
  int standing_every = 10;          // where it stands, every so many sweeps count: who stood in the way may have gone
  int recent = 12;                  // so many key views before are what a sweep is put onto
  double least_agreement = 0.35;    // with less the wheels are believed
  // Of the wheels, for each metre or radian since the last time:
  double odometry_spread = 0.03;
  double odometry_spread_rad_per_m = 0.04;
  double odometry_spread_rad_per_rad = 0.05;
  // A loop is looked for where the robot may be near to where it was so many key views ago,
  int loop_gap = 15;
  double loop_within_m = 1.2;   // so near, by what it takes itself to be,
  double loop_drift = 0.015;    // and for each metre driven between
  double loop_agreement = 0.6;  // of its sweep with those, at least
};

/// A picture with what was known where it was taken: a vertex of the pose graph.
struct KeyView {
  Pose2 odometry;
  RangeSweep sweep;
  std::vector<geometry::SurfacePoint> surface;
  std::shared_ptr<const features::Appearance> appearance;  // null: it was not looked at
  double driven_m = 0.0;                                   // up to there
};

/// A place that is known already, seen again: a link of the pose graph. It may be wrong, and is taken back then; what
/// was taken back may turn out right.
struct KnownAgain {
  int now = 0;  // key views
  int then = 0;
  double agreement = 0.0;  // share of the sweep that agrees with those around the old one
  bool taken_back = false;
};

/// Explores a building: puts sweeps and pictures together, and says where to go next. Plain data, no clock.
/// The whole is ours; what it grew from is Ferdaus 2008, chapter 4 (docs/experiments/exploration.md).
class Explorer {
 public:
  /// A point of the floor that moves with the key view beside which it was given.
  struct Spot {
    std::size_t view = 0;
    Eigen::Vector2d seen_from_view_m = Eigen::Vector2d::Zero();
    friend bool operator==(const Spot&, const Spot&) = default;
  };

  explicit Explorer(const ExplorerConfig& config) : config_(config), floor_(config.floor) {}

  /// A new sweep and the odometry of its moment.
  void see(const RangeSweep& sweep, const Pose2& odometry);
  /// Whether it is time for a picture.
  [[nodiscard]] bool wants_picture(const Pose2& odometry) const;
  /// From where the last picture was taken to here, as the crow flies; far where there is none.
  [[nodiscard]] double since_picture_m(const Pose2& odometry) const;
  /// The picture that was taken there, with a sweep of the same moment. `appearance` may be null: then no place is
  /// known again by sight.
  void take(const RangeSweep& sweep, const Pose2& odometry, std::shared_ptr<const features::Appearance> appearance);

  /// Where the robot is now on the floor.
  [[nodiscard]] Pose2 floor_from_robot(const Pose2& odometry) const;
  /// What it reaches from there.
  [[nodiscard]] Reach reach(const Pose2& odometry) const;
  /// Where to take a picture next; nothing: all is explored. `driven_to`: where the robot drives now, if it does.
  [[nodiscard]] std::optional<NextView> next(const Reach& reach, const std::optional<DrivenTo>& driven_to) const;
  /// That place is not wanted again, as long as the loops stand by which it was placed.
  void give_up(const Eigen::Vector2d& at_m);
  /// The same place of an exploration that is taken up again: once its key view, and before the next one, was taken.
  void give_up_again(const Spot& spot) { given_up_.push_back(spot); }
  /// What is given up, in the order in which it was.
  [[nodiscard]] const std::vector<Spot>& given_up() const { return given_up_; }
  /// The way to that place is blocked at a point: the place is not wanted, and no way leads past that point, until
  /// `try_blocked_again`.
  void put_off(const Eigen::Vector2d& at_m, const Eigen::Vector2d& blocked_at_m);
  /// Whoever stood in the way may have gone. False: no way was blocked.
  bool try_blocked_again();
  /// So many places are put off.
  [[nodiscard]] std::size_t put_off() const { return put_off_.size(); }
  /// No way leads over these polygons of the floor, nor so near to one that the body would be over it, in place of
  /// those before. Fewer than three corners fence nothing. What drives the way keeps to it as far as nothing stands
  /// there: it goes round things, and makes room for people.
  void set_fences(std::vector<std::vector<Eigen::Vector2d>> fences_m) { fences_m_ = std::move(fences_m); }
  /// What another robot knows that explores the same building, and how its floor lies in ours, in place of what was
  /// known of it before: ways lead over its floor as well, and what is left to it is not wanted (companion.hpp).
  /// Nothing: this one explores for itself.
  void set_companion(std::optional<Companion> companion) { companion_ = std::move(companion); }
  /// Whether anything is wanted but for the other robot, which is at it: while that drives on, this one is not done.
  [[nodiscard]] bool waits_for_companion(const Reach& reach) const;
  /// The robot's odometry has begun anew, or the robot was moved without it: `now_from_before` takes what it said
  /// before to what it would say of the same place now.
  void move_odometry(const Pose2& now_from_before);
  /// How often poses, floor and coverage were put together anew: points of the floor given before that have moved.
  [[nodiscard]] int layouts() const { return layouts_; }

  [[nodiscard]] const ExploredFloor& floor() const { return floor_; }
  [[nodiscard]] const Coverage& coverage() const { return coverage_; }
  [[nodiscard]] const std::vector<KeyView>& views() const { return views_; }
  [[nodiscard]] const std::vector<Pose2>& poses() const { return poses_; }
  [[nodiscard]] const std::vector<KnownAgain>& known_again() const { return known_again_; }
  [[nodiscard]] const ExplorerConfig& config() const { return config_; }

 private:
  [[nodiscard]] geometry::PosePrior prior(const Pose2& odometry) const;
  /// Whether the sweeps agree; else the wheels are believed.
  bool align_to_recent(std::span<const geometry::SurfacePoint> surface, const Pose2& odometry);
  void look_for_loop();
  /// How the newest key view lies to an old one.
  struct Loop {
    PoseLink link;
    double agreement = 0.0;
  };
  [[nodiscard]] std::optional<Loop> loop_with(int then) const;
  void lay_out_again();
  [[nodiscard]] std::vector<std::uint8_t> given_up_cells(const FloorFrame& frame) const;
  [[nodiscard]] std::vector<std::uint8_t> barred_cells(const FloorFrame& frame) const;
  /// The next view where a companion has its share.
  [[nodiscard]] std::optional<NextView> next_beside(const Companion& companion, const Reach& reach,
                                                    const std::optional<DrivenTo>& driven_to,
                                                    std::span<const LeftToCompanion> shares) const;

  ExplorerConfig config_;
  ExploredFloor floor_;
  Coverage coverage_;
  std::vector<KeyView> views_;
  std::vector<Pose2> poses_;     // of the key views
  std::vector<PoseLink> steps_;  // from key view to key view
  std::vector<PoseLink> loops_;
  std::vector<KnownAgain> known_again_;  // one for each loop
  [[nodiscard]] Spot spot_at(const Eigen::Vector2d& at_m) const;
  [[nodiscard]] Eigen::Vector2d position_of(const Spot& spot) const;
  void mark_around(const Spot& spot, double within_m, const FloorFrame& frame, std::vector<std::uint8_t>& cells) const;

  std::vector<Spot> given_up_;
  std::vector<Spot> put_off_;
  std::vector<Spot> blocked_;
  std::vector<std::vector<Eigen::Vector2d>> fences_m_;
  std::optional<Companion> companion_;
  std::vector<Pose2> laid_out_;  // the poses that the floor was put together with
  int layouts_ = 0;
  int standing_sweeps_ = 0;
  // The latest alignment: where the robot was then, and its odometry.
  Pose2 aligned_;
  Pose2 aligned_odometry_;
};

}  // namespace homeward::exploration
