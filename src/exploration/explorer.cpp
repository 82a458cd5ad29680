// SPDX-License-Identifier: Apache-2.0
#include "exploration/explorer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "core/angles.hpp"
#include "exploration/believed_loops.hpp"
#include "matching/verify.hpp"

namespace homeward::exploration {
namespace {

/// What is left to another robot is less and less, until there is something to do.
constexpr std::array kSharesInTurn = {LeftToCompanion::kNearer, LeftToCompanion::kTarget};

double length_m(const Pose2& moved) { return std::hypot(moved.x_m, moved.y_m); }

}  // namespace

Pose2 Explorer::floor_from_robot(const Pose2& odometry) const {
  return aligned_ * inverse(aligned_odometry_) * odometry;
}

geometry::PosePrior Explorer::prior(const Pose2& odometry) const {
  const Pose2 moved = inverse(aligned_odometry_) * odometry;
  const double driven_m = length_m(moved);
  return {aligned_ * moved, 0.02 + config_.odometry_spread * driven_m,
          0.01 + config_.odometry_spread_rad_per_m * driven_m +
              config_.odometry_spread_rad_per_rad * std::abs(moved.theta_rad)};
}

bool Explorer::align_to_recent(std::span<const geometry::SurfacePoint> surface, const Pose2& odometry) {
  const geometry::PosePrior before = prior(odometry);
  geometry::ReferenceSurface reference;
  const std::size_t first = views_.size() > static_cast<std::size_t>(config_.recent)
                                ? views_.size() - static_cast<std::size_t>(config_.recent)
                                : 0;
  for (std::size_t i = first; i < views_.size(); ++i) reference.add(views_[i].surface, poses_[i]);
  const auto aligned = geometry::align(reference, surface, before, config_.alignment);
  const bool agrees = aligned && aligned->agreement >= config_.least_agreement;
  aligned_ = agrees ? aligned->reference_from_robot : before.reference_from_robot;
  aligned_odometry_ = odometry;
  return agrees;
}

void Explorer::see(const RangeSweep& sweep, const Pose2& odometry) {
  if (views_.empty()) return;
  const Pose2 moved = inverse(aligned_odometry_) * odometry;
  const bool is_due =
      length_m(moved) >= config_.aligned_every_m || std::abs(moved.theta_rad) >= config_.aligned_every_rad;
  if (!is_due && ++standing_sweeps_ < config_.standing_every) return;
  standing_sweeps_ = 0;
  const std::vector<geometry::SurfacePoint> surface = geometry::surface_of(sweep, config_.filter);
  align_to_recent(surface, odometry);
  floor_.see(sweep, surface, aligned_);
  coverage_.follow(floor_.frame());
}

bool Explorer::wants_picture(const Pose2& odometry) const {
  return since_picture_m(odometry) >= config_.picture_every_m;
}

double Explorer::since_picture_m(const Pose2& odometry) const {
  constexpr double kFar_m = 1e9;
  return views_.empty() ? kFar_m : length_m(inverse(views_.back().odometry) * odometry);
}

void Explorer::take(const RangeSweep& sweep, const Pose2& odometry,
                    std::shared_ptr<const features::Appearance> appearance) {
  KeyView view{odometry, sweep, geometry::surface_of(sweep, config_.filter), std::move(appearance), 0.0};
  if (views_.empty()) {
    aligned_odometry_ = odometry;
  } else {
    const geometry::PosePrior wheels = prior(odometry);
    const bool agrees = align_to_recent(view.surface, odometry);
    view.driven_m = views_.back().driven_m + length_m(inverse(views_.back().odometry) * odometry);
    const int last = static_cast<int>(views_.size()) - 1;
    steps_.push_back({last, last + 1, inverse(poses_.back()) * aligned_, agrees ? 0.01 : wheels.spread_m,
                      agrees ? radians(0.3) : wheels.spread_rad, false});
  }
  views_.push_back(std::move(view));
  poses_.push_back(aligned_);
  laid_out_.push_back(aligned_);
  floor_.see(sweep, views_.back().surface, aligned_);
  coverage_.add(floor_, position_m(aligned_), config_.view);
  look_for_loop();
}

Reach Explorer::reach(const Pose2& odometry) const {
  const Eigen::Vector2d at_m = position_m(floor_from_robot(odometry));
  if (companion_) {
    const ExploredFloor joint = joint_floor(floor_, *companion_);
    const std::vector<std::uint8_t> barred = barred_cells(joint.frame());
    return Reach::from(joint, at_m, config_.reach, &barred);
  }
  const std::vector<std::uint8_t> barred = barred_cells(floor_.frame());
  return Reach::from(floor_, at_m, config_.reach, &barred);
}

Explorer::Spot Explorer::spot_at(const Eigen::Vector2d& at_m) const {
  if (views_.empty()) return {0, at_m};
  const std::size_t view = views_.size() - 1;
  return {view, position_m(inverse(poses_[view]) * Pose2{at_m.x(), at_m.y(), 0.0})};
}

Eigen::Vector2d Explorer::position_of(const Spot& spot) const {
  if (spot.view >= poses_.size()) return spot.seen_from_view_m;
  return position_m(poses_[spot.view] * Pose2{spot.seen_from_view_m.x(), spot.seen_from_view_m.y(), 0.0});
}

void Explorer::mark_around(const Spot& spot, double within_m, const FloorFrame& frame,
                           std::vector<std::uint8_t>& cells) const {
  const int around = static_cast<int>(within_m / frame.cell_m);
  const FloorCell middle = frame.cell(position_of(spot));
  for (int row = middle.row - around; row <= middle.row + around; ++row) {
    for (int column = middle.column - around; column <= middle.column + around; ++column)
      if (frame.holds({column, row})) cells[frame.index({column, row})] = 1;
  }
}

/// Fences, as much wider as the body wants, and where ways were blocked.
std::vector<std::uint8_t> Explorer::barred_cells(const FloorFrame& frame) const {
  constexpr double kAroundBlocked_m = 0.2;
  std::vector<std::uint8_t> cells(frame.size(), 0);
  if (cells.empty()) return cells;
  cv::Mat canvas(frame.rows, frame.columns, CV_8UC1, cells.data());
  constexpr std::size_t kLeastCorners = 3;
  for (const std::vector<Eigen::Vector2d>& corners_m : fences_m_) {
    if (corners_m.size() < kLeastCorners) continue;
    std::vector<cv::Point> corners;
    for (const Eigen::Vector2d& corner_m : corners_m) {
      const FloorCell cell = frame.cell(corner_m);
      corners.emplace_back(cell.column, cell.row);
    }
    cv::fillPoly(canvas, std::vector{corners}, cv::Scalar(1));
  }
  if (!fences_m_.empty()) {
    const int wider = static_cast<int>(std::ceil((config_.reach.radius_m + config_.reach.margin_m) / frame.cell_m));
    const cv::Size size(2 * wider + 1, 2 * wider + 1);
    cv::dilate(canvas, canvas, cv::getStructuringElement(cv::MORPH_ELLIPSE, size));
  }
  for (const Spot& spot : blocked_) mark_around(spot, kAroundBlocked_m, frame, cells);
  return cells;
}

std::vector<std::uint8_t> Explorer::given_up_cells(const FloorFrame& frame) const {
  constexpr double kAround_m = 0.3;
  std::vector<std::uint8_t> cells(frame.size(), 0);
  for (const auto* spots : {&given_up_, &put_off_}) {
    for (const Spot& spot : *spots) mark_around(spot, kAround_m, frame, cells);
  }
  return cells;
}

std::optional<NextView> Explorer::next(const Reach& reach, const std::optional<DrivenTo>& driven_to) const {
  if (companion_) return next_beside(*companion_, reach, driven_to, kSharesInTurn);
  return next_view(floor_, reach, coverage_, given_up_cells(floor_.frame()), driven_to, config_.view);
}

std::optional<NextView> Explorer::next_beside(const Companion& companion, const Reach& reach,
                                              const std::optional<DrivenTo>& driven_to,
                                              std::span<const LeftToCompanion> shares) const {
  const ExploredFloor joint = joint_floor(floor_, companion);
  Coverage coverage = coverage_;
  coverage.follow(joint.frame());
  const std::vector<std::uint8_t> given_up = given_up_cells(joint.frame());
  for (const LeftToCompanion share : shares) {
    std::vector<std::uint8_t> unwanted = given_up;
    mark_left(companion, share, joint, reach, config_.reach, config_.companion, unwanted);
    if (const auto next = next_view(joint, reach, coverage, unwanted, driven_to, config_.view)) return next;
  }
  return std::nullopt;
}

bool Explorer::waits_for_companion(const Reach& reach) const {
  constexpr std::array kCovered = {LeftToCompanion::kCovered};
  if (!companion_ || !companion_->report.drives) return false;
  // While the other drives somewhere, what it finds may be ours to see: it may stand in the only way there.
  return companion_->report.target_m.has_value() || next_beside(*companion_, reach, std::nullopt, kCovered).has_value();
}

void Explorer::give_up(const Eigen::Vector2d& at_m) { given_up_.push_back(spot_at(at_m)); }

void Explorer::put_off(const Eigen::Vector2d& at_m, const Eigen::Vector2d& blocked_at_m) {
  put_off_.push_back(spot_at(at_m));
  blocked_.push_back(spot_at(blocked_at_m));
}

bool Explorer::try_blocked_again() {
  const bool any = !put_off_.empty();
  put_off_.clear();
  blocked_.clear();
  return any;
}

void Explorer::move_odometry(const Pose2& now_from_before) {
  for (KeyView& view : views_) view.odometry = now_from_before * view.odometry;
  aligned_odometry_ = now_from_before * aligned_odometry_;
}

/// How the newest key view lies to an old one, if their sweeps and their pictures agree on it.
std::optional<Explorer::Loop> Explorer::loop_with(int then) const {
  const auto old = static_cast<std::size_t>(then);
  const KeyView& now = views_.back();
  geometry::ReferenceSurface reference;
  const std::size_t first = old >= 3 ? old - 3 : 0;
  const std::size_t last = std::min(old + 3, views_.size() - 1 - static_cast<std::size_t>(config_.loop_gap));
  for (std::size_t i = first; i <= last; ++i) reference.add(views_[i].surface, poses_[i]);
  const double driven_m = now.driven_m - views_[old].driven_m;
  const double doubt_m = 0.1 + config_.loop_drift * driven_m;
  const double doubt_rad = radians(1.0) + radians(0.1) * driven_m;
  // From several starts, as far as the drift may have got; the best few by a look are worked out.
  struct Start {
    Pose2 pose;
    double agreement;
  };
  std::vector<Start> starts;
  const int steps = std::min(3, static_cast<int>(std::ceil(doubt_m / 0.25)));
  for (int right = -steps; right <= steps; ++right) {
    for (int up = -steps; up <= steps; ++up) {
      for (int turn = -2; turn <= 2; ++turn) {
        Pose2 pose = poses_.back();
        pose.x_m += right * 0.25;
        pose.y_m += up * 0.25;
        pose.theta_rad = wrap_angle(pose.theta_rad + turn * 0.5 * std::min(doubt_rad, radians(10.0)));
        starts.push_back({pose, geometry::agreement(reference, now.surface, pose, 0.15)});
      }
    }
  }
  std::ranges::stable_sort(starts, std::greater<>(), &Start::agreement);
  std::optional<geometry::Alignment> best;
  for (std::size_t i = 0; i < std::min<std::size_t>(3, starts.size()); ++i) {
    const auto aligned = geometry::align(reference, now.surface, {starts[i].pose, 0.5, 0.2}, config_.alignment);
    if (aligned && (!best || aligned->agreement > best->agreement)) best = aligned;
  }
  if (!best || best->agreement < config_.loop_agreement) return std::nullopt;
  const Pose2 then_from_now = inverse(poses_[old]) * best->reference_from_robot;
  const Pose2 off = inverse(poses_.back()) * best->reference_from_robot;
  if (length_m(off) > 3.0 * doubt_m + 0.2) return std::nullopt;
  if (now.appearance && views_[old].appearance) {
    const auto seen = matching::verify(*now.appearance, *views_[old].appearance, {}, 1);
    constexpr double kSameTurn_rad = 0.12;
    if (!seen || std::abs(wrap_angle(seen->pose.motion.turn_rad + then_from_now.theta_rad)) > kSameTurn_rad)
      return std::nullopt;
  }
  const PoseLink link{then, static_cast<int>(views_.size()) - 1, then_from_now, 0.03, radians(0.6), true};
  return Loop{link, best->agreement};
}

void Explorer::look_for_loop() {
  const int newest = static_cast<int>(views_.size()) - 1;
  // The nearest of the old ones, by what is known.
  int then = -1;
  double nearest_m = 1e9;
  for (int i = 0; i + config_.loop_gap <= newest; ++i) {
    const auto old = static_cast<std::size_t>(i);
    const double apart_m = (position_m(poses_[old]) - position_m(poses_.back())).norm();
    const double driven_m = views_.back().driven_m - views_[old].driven_m;
    const double within_m = config_.loop_within_m + config_.loop_drift * driven_m;
    if (apart_m > within_m || apart_m >= nearest_m) continue;
    if (!floor_.in_sight(position_m(poses_[old]), position_m(poses_.back()))) continue;
    nearest_m = apart_m;
    then = i;
  }
  if (then < 0) return;
  const auto loop = loop_with(then);
  if (!loop) return;
  loops_.push_back(loop->link);
  known_again_.push_back({newest, then, loop->agreement, false});
  // What fits already need not be laid out again.
  constexpr double kFits = 1.5;
  if (strain(poses_, loop->link) < kFits) return;
  lay_out_again();
}

/// Settles the poses by all links and puts the floor together anew. A loop that the others contradict is taken back,
/// and with it the places that were given up since.
void Explorer::lay_out_again() {
  constexpr int kLatest = 30;  // key views
  std::vector<std::uint8_t> believed;
  for (const KnownAgain& known : known_again_) believed.push_back(known.taken_back ? 0 : 1);
  const int since = static_cast<int>(views_.size()) - kLatest;
  SettledLoops settled = settle_loops(poses_, steps_, loops_, std::move(believed), since);
  poses_ = std::move(settled.poses);
  for (std::size_t i = 0; i < loops_.size(); ++i) {
    KnownAgain& known = known_again_[i];
    const bool was_believed = !std::exchange(known.taken_back, settled.believed[i] == 0);
    if (!was_believed || !known.taken_back) continue;
    std::erase_if(given_up_, [&](const Spot& spot) { return spot.view >= static_cast<std::size_t>(known.now); });
  }
  aligned_ = poses_.back();
  aligned_odometry_ = views_.back().odometry;
  // The floor of cells does not show less than about a cell.
  double moved_m = 0.0;
  for (std::size_t i = 0; i < poses_.size(); ++i)
    moved_m = std::max(moved_m, (position_m(poses_[i]) - position_m(laid_out_[i])).norm());
  if (moved_m < config_.floor.cell_m) return;
  ++layouts_;
  laid_out_ = poses_;
  floor_.forget();
  coverage_.forget();
  for (std::size_t i = 0; i < views_.size(); ++i) floor_.see(views_[i].sweep, views_[i].surface, poses_[i]);
  for (const Pose2& pose : poses_) coverage_.add(floor_, position_m(pose), config_.view);
}

}  // namespace homeward::exploration
