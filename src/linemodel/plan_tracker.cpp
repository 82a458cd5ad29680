// SPDX-License-Identifier: Apache-2.0
#include "linemodel/plan_tracker.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "core/angles.hpp"

namespace homeward::linemodel {
namespace {

constexpr double kReach_m = 0.5;  // of one place where the robot may be
constexpr double kReach_rad = 0.35;
constexpr std::size_t kMostPlaces = 4;
constexpr double kLeastHeight_m = 0.05;  // of the camera: lower, the floor hides everything
constexpr double kOther = 0.15;          // share of the belief that makes another place worth saying
constexpr double kInWall = 0.1;          // times the weight of a pose where a robot cannot be
constexpr double kMetresPerTurn = 0.3;   // a turn shows something new too
constexpr double kWithoutOdometry_m = 0.25;
constexpr double kNewSight_m = 0.5;     // a picture of which nothing is known in common with the last one
constexpr double kPlaceReach_m = 0.75;  // of a place that is taken up
constexpr double kPlaceReach_rad = 0.5;
constexpr std::size_t kFewParticles = 45'000;  // more of them are still everywhere
constexpr double kLeastSpread_m = 0.1;         // of a start at a place that has been found
constexpr double kLeastSpread_rad = 0.05;
constexpr double kJump_m = 1.5;  // from where the robot was known to be: another place
constexpr double kJump_rad = 0.8;
constexpr double kFacesAbout_rad = 0.5;  // a start with a wider spread of headings does not say where the robot faces
constexpr double kSaidAgreement = 1.5;   // of plan and pictures, of a start
constexpr double kAbove = 0.1;           // sine of an elevation: what reaches above it is no pattern of a floor
constexpr int kBeams = 60;
constexpr double kBeamSpread_m = 0.12;
constexpr double kBeamRandom = 0.15;  // share of ranges to what no plan shows
constexpr double kUnmet = 10.0;       // spreads off whatever is drawn
constexpr double kBeamsAlike = 0.15;  // of the beams' evidence counts, as neighbours hit the same

/// Lines that reach so high are of what is built: walls, beams, ceilings.
float built_height_m(const Plan& plan) {
  constexpr float kAboveFurniture_m = 2.15F;
  constexpr float kOfHighest = 0.85F;  // in a low building
  float highest_m = 0.0F;
  for (const PlanLine& line : plan.lines) highest_m = std::max({highest_m, line.from_m.z(), line.to_m.z()});
  return std::min(kAboveFurniture_m, kOfHighest * highest_m);
}

/// Of the places that were followed for so much, the best agreement; nothing where there is none.
std::optional<double> best_agreement(std::span<const PlaceHypothesis> places, double least_m) {
  std::optional<double> best;
  for (const PlaceHypothesis& place : places) {
    if (place.followed_m >= least_m) best = std::max(best.value_or(place.agreement), place.agreement);
  }
  return best;
}

}  // namespace

PlanTrackerConfig tracker_config(LineMeasure measure) {
  PlanTrackerConfig config;
  config.measure.measure = measure;
  if (measure == LineMeasure::kMatchOdds) {
    config.gain = 10.0;
    config.wide_gain = 5.0;
    config.doubted_score = 0.0;
  }
  return config;
}

Result<PlanTracker> PlanTracker::create(const Plan& plan, const camera::CameraConfig& config,
                                        const PlanTrackerConfig& tracking) {
  const auto camera = camera::Camera::create(config);
  if (!camera) return pass_on(camera);
  if (!(config.robot_from_camera_translation_m.z() > kLeastHeight_m)) {
    return fail(ErrorCode::kInvalidInput,
                "The camera has to be above the floor: say how high in robot_from_camera of its camera.json.",
                "robot_from_camera/translation_m");
  }
  if (plan.lines.empty()) return fail(ErrorCode::kEmptyInput, "The plan has no lines.");
  auto floor = PlanFloor::of(plan);
  if (!floor) return pass_on(floor);
  if (floor->free_points_m().empty()) {
    return fail(ErrorCode::kEmptyInput, "The plan has no floor that a robot could stand on.");
  }
  PlanTracker tracker(plan, **camera, std::move(*floor), tracking);
  tracker.start_anywhere();
  return tracker;
}

PlanTracker::PlanTracker(const Plan& plan, const camera::Camera& camera, PlanFloor floor,
                         const PlanTrackerConfig& config)
    : config_(config),
      views_(camera),
      expectation_(camera),
      visible_(plan, camera.config().robot_from_camera_translation_m.z(), config.visibility),
      floor_(std::move(floor)),
      at_sweep_(plan, config.sweep_height_m - 0.03, config.sweep_height_m + 0.03),
      monte_carlo_(floor_.free_points_m(), PlanFloor::kSpacing_m, config.monte_carlo),
      places_(config.places),
      built_height_m_(built_height_m(plan)) {}

void PlanTracker::start_anywhere() {
  of_this_plan_ = true;
  monte_carlo_.start_anywhere();
  places_.clear();
  searching_beside_ = false;
  searching_ = true;
  unknown_m_ = 0.0;
  known_ = false;
  evidence_ = 0.0;
  wrong_pictures_ = 0;
}

void PlanTracker::start_at(const Pose2& pose, double spread_m, double spread_rad) {
  monte_carlo_.start_at(pose, spread_m, spread_rad);
  places_.clear();
  searching_beside_ = false;
  searching_ = false;
  of_this_plan_ = true;
  unknown_m_ = 0.0;
  known_ = spread_m <= config_.known_spread_m && spread_rad <= kFacesAbout_rad;
  most_unknown_m_ = known_ ? config_.most_doubted_m : config_.most_unfound_m;
  known_at_ = pose;
  // Moved by odometry, a start that faces anywhere goes anywhere.
  jump_m_ = known_ ? kJump_m + 3.0 * spread_m : std::numeric_limits<double>::infinity();
  jump_rad_ = known_ ? kJump_rad + 3.0 * spread_rad : std::numeric_limits<double>::infinity();
  evidence_ = 1.5 * config_.least_evidence;  // somebody has said so
  agreement_ = kSaidAgreement;
  wrong_pictures_ = 0;
}

ExpectedView PlanTracker::expected(const Pose2& pose) {
  ExpectedView view;
  expectation_.expect(pose, visible_.around(expectation_.eye_m(pose).head<2>()), view);
  return view;
}

std::vector<JudgedLine> PlanTracker::judged(const Pose2& pose) {
  const PictureLines seen(lines_, expectation_.space(), config_.measure);
  const std::span<const PlanLine> around = visible_.around(expectation_.eye_m(pose).head<2>());
  std::vector<JudgedLine> judged;
  for (const ExpectedLine& line : expected(pose).lines) {
    judged.push_back({around[static_cast<std::size_t>(line.index)], seen.confirmed(line)});
  }
  return judged;
}

void PlanTracker::restart_odometry() {
  if (!last_odometry_) return;
  spread_particles();
  last_odometry_.reset();
}

void PlanTracker::spread_particles() {
  if (places_.empty() || searching_beside_) monte_carlo_.spread(kWithoutOdometry_m);
  if (!places_.empty()) places_.spread(kWithoutOdometry_m);
}

double PlanTracker::move(const std::optional<Pose2>& odometry) {
  double driven_m = kNewSight_m;
  if (odometry && last_odometry_) {
    const Pose2 moved = inverse(*last_odometry_) * *odometry;
    driven_m = std::hypot(moved.x_m, moved.y_m) + kMetresPerTurn * std::abs(moved.theta_rad);
    if (places_.empty() || searching_beside_) monte_carlo_.move(moved);
    if (!places_.empty()) places_.move(moved);
    known_at_ = known_at_ * moved;
  } else if (!odometry) {
    spread_particles();
  }
  last_odometry_ = odometry;
  return driven_m;
}

double PlanTracker::sweep_log_weight(const RangeSweep& sweep, const Pose2& pose) const {
  const Pose2 scan = pose * sweep.robot_from_scan;
  const auto step = std::max<std::size_t>(1, sweep.ranges_m.size() / kBeams);
  double sum = 0.0;
  for (std::size_t i = 0; i < sweep.ranges_m.size(); i += step) {
    const double range_m = sweep.ranges_m[i];
    if (!(range_m > 0.0 && range_m < sweep.range_max_m)) continue;
    const double turn = scan.theta_rad + sweep.angle_min_rad + static_cast<double>(i) * sweep.angle_step_rad;
    const Eigen::Vector2d end_m(scan.x_m + range_m * std::cos(turn), scan.y_m + range_m * std::sin(turn));
    // A ray that ends beyond the plan met nothing that is drawn.
    const double spreads = at_sweep_.covers(end_m) ? at_sweep_.clearance_m(end_m) / kBeamSpread_m : kUnmet;
    sum += std::log((1.0 - kBeamRandom) * std::exp(-0.5 * spreads * spreads) + kBeamRandom);
  }
  return kBeamsAlike * sum;
}

MonteCarlo::Fit PlanTracker::fit(const PictureLines& lines, double gain, const RangeSweep* sweep, const Pose2& pose) {
  const Eigen::Vector3d eye_m = expectation_.eye_m(pose);
  expectation_.expect(pose, visible_.around(eye_m.head<2>()), view_,
                      config_.measure.measure == LineMeasure::kDistanceTransform);
  MonteCarlo::Fit fit;
  const auto count = static_cast<double>(view_.lines.size());
  fit.score =
      (count * lines.score(view_) + config_.doubted_lines * config_.doubted_score) / (count + config_.doubted_lines);
  double log_weight = gain * fit.score;
  if (sweep != nullptr) log_weight += sweep_log_weight(*sweep, pose);
  fit.weight = std::exp(log_weight);
  if (!floor_.free(position_m(pose))) fit.weight *= kInWall;
  return fit;
}

Result<PlanEstimate> PlanTracker::update(const Image& picture, const std::optional<Pose2>& odometry,
                                         const std::optional<RangeSweep>& sweep) {
  auto lines = detect_lines(picture, views_, config_.detection);
  if (!lines) return pass_on(lines);
  lines_ = std::move(*lines);
  look_above();
  const double driven_m = move(odometry);
  const RangeSweep* ranges = sweep ? &*sweep : nullptr;
  const PictureLines seen(lines_, expectation_.space(), config_.measure);
  if (!places_.empty()) {
    weigh_places(seen, driven_m, ranges);
    if (searching_beside_) weigh_everywhere(driven_m, ranges);
    return estimate_places(seen, driven_m);
  }
  weigh_everywhere(driven_m, ranges);
  return estimate(seen, driven_m);
}

void PlanTracker::look_above() {
  std::vector<ImageLine> above;
  for (const ImageLine& line : lines_) {
    if (std::max(line.from.z(), line.to.z()) > kAbove) above.push_back(line);
  }
  above_ = hough_points(above, expectation_.space());
}

void PlanTracker::weigh_everywhere(double driven_m, const RangeSweep* sweep) {
  MeasureConfig measure = config_.measure;
  if (!known_) {
    measure.tolerance_rad *= config_.wide;
    measure.cell_rad *= config_.wide;
    measure.spread_rad *= config_.wide;
  }
  const PictureLines seen(lines_, expectation_.space(), measure);
  const double independent_m = known_ ? config_.independent_m : config_.wide_independent_m;
  const double gain = (known_ ? config_.gain : config_.wide_gain) * std::min(1.0, driven_m / independent_m);
  monte_carlo_.weigh([&](const Pose2& pose) { return fit(seen, gain, sweep, pose); });
}

void PlanTracker::weigh_places(const PictureLines& lines, double driven_m, const RangeSweep* sweep) {
  const double gain = config_.gain * std::min(1.0, driven_m / config_.independent_m);
  places_.weigh([&](const Pose2& pose) { return fit(lines, gain, sweep, pose); },
                [&](const Pose2& pose) { return evidence_at(pose, lines); }, driven_m);
}

double PlanTracker::explained(const ExpectedView& view) const {
  std::vector<HoughPoint> drawn;
  for (const ExpectedLine& line : view.lines) drawn.push_back(line.point);
  return PictureLines(drawn, expectation_.space(), config_.measure).log_odds(above_);
}

double PlanTracker::explained(const Pose2& pose) { return explained(expected(pose)); }

PlaceHypotheses::Evidence PlanTracker::evidence_at(const Pose2& pose, const PictureLines& lines) {
  const std::span<const PlanLine> around = visible_.around(expectation_.eye_m(pose).head<2>());
  ExpectedView view = expected(pose);
  PlaceHypotheses::Evidence evidence;
  evidence.all = lines.log_odds(view);
  evidence.explained = explained(view);
  std::erase_if(view.lines, [&](const ExpectedLine& line) {
    const PlanLine& of_plan = around[static_cast<std::size_t>(line.index)];
    return std::max(of_plan.from_m.z(), of_plan.to_m.z()) < built_height_m_;
  });
  evidence.built = lines.log_odds(view);
  if (!floor_.free(position_m(pose))) {
    evidence.all *= config_.in_wall_evidence;
    evidence.built *= config_.in_wall_evidence;
  }
  return evidence;
}

PlanEstimate PlanTracker::said_of(std::span<const PoseCluster> places, double least_share, const PictureLines& lines) {
  PlanEstimate said;
  said.particles = particles().size();
  said.lines_seen = static_cast<int>(lines_.size());
  if (places.empty()) return said;
  said.pose = places.front().pose;
  said.spread_m = places.front().spread_m;
  said.spread_rad = places.front().spread_rad;
  said.share = places.front().share;
  for (std::size_t i = 1; i < places.size() && i < kMostPlaces; ++i) {
    if (places[i].share >= least_share) said.others.push_back(places[i]);
  }
  const ExpectedView view = expected(said.pose);
  said.lines_expected = static_cast<int>(view.lines.size());
  said.lines_confirmed = lines.confirmed_count(view);
  said.log_odds = lines.log_odds(view);
  said.explained = explained(view);
  return said;
}

PlanEstimate PlanTracker::estimate(const PictureLines& lines, double driven_m) {
  PlanEstimate said = said_of(monte_carlo_.clusters(kReach_m, kReach_rad, kMostPlaces), kOther, lines);
  if (searching_) {
    said.lost = of_this_plan_ ? PlanLost::kSearching : PlanLost::kNotInPlan;
    take_up_places(driven_m);
    return said;
  }
  if (said.share == 0.0) return said;
  keep_known(said, driven_m);
  follow_evidence(said.log_odds, said);
  said.evidence = evidence_;
  of_this_plan_ = of_this_plan_ ? evidence_ >= config_.still_evidence || agreement_ >= config_.still_agreement
                                : evidence_ >= config_.least_evidence;
  said.lost = !of_this_plan_        ? PlanLost::kNotInPlan
              : known_              ? PlanLost::kNo
              : said.others.empty() ? PlanLost::kSearching
                                    : PlanLost::kAmbiguous;
  if (wrong_pictures_ > config_.most_wrong_pictures || unknown_m_ > most_unknown_m_) start_anywhere();
  return said;
}

void PlanTracker::keep_known(const PlanEstimate& said, double driven_m) {
  const bool at_one = said.share >= (known_ ? config_.still_share : config_.known_share);
  const bool jumped = (position_m(said.pose) - position_m(known_at_)).norm() > jump_m_ ||
                      std::abs(wrap_angle(said.pose.theta_rad - known_at_.theta_rad)) > jump_rad_;
  known_ = at_one && !jumped && said.spread_m <= config_.known_spread_m;
  unknown_m_ = known_ ? 0.0 : unknown_m_ + driven_m;
  if (!known_) return;
  most_unknown_m_ = config_.most_doubted_m;
  known_at_ = said.pose;
  jump_m_ = kJump_m;
  jump_rad_ = kJump_rad;
}

std::vector<PoseCluster> PlanTracker::places_to_take_up(double searched_m) const {
  const bool must = searched_m >= config_.most_search_m;
  if (!must && (searched_m < config_.least_search_m || monte_carlo_.particles().size() > kFewParticles)) return {};
  std::vector<PoseCluster> places = monte_carlo_.clusters(kPlaceReach_m, kPlaceReach_rad, config_.most_places);
  double share = 0.0;
  for (const PoseCluster& place : places) share += place.share;
  if (!must && share < config_.places_share) places.clear();
  return places;
}

void PlanTracker::take_up_places(double driven_m) {
  unknown_m_ += driven_m;
  const std::vector<PoseCluster> places = places_to_take_up(unknown_m_);
  if (!places.empty()) places_.begin(monte_carlo_, config_.monte_carlo, places);
}

void PlanTracker::search_beside(double driven_m) {
  searched_m_ += driven_m;
  if (searching_beside_) {
    const std::vector<PoseCluster> places = places_to_take_up(searched_m_);
    if (places.empty()) return;
    places_.join(monte_carlo_, config_.monte_carlo, places);
  }
  monte_carlo_.start_anywhere();
  searching_beside_ = true;
  searched_m_ = 0.0;
}

PlanEstimate PlanTracker::estimate_places(const PictureLines& lines, double driven_m) {
  const std::vector<PlaceHypothesis> places = places_.places();
  const PlaceHypothesis& first = places.front();
  std::vector<PoseCluster> at;
  for (const PlaceHypothesis& place : places) at.push_back(place.at);
  PlanEstimate said = said_of(at, kOther, lines);
  said.evidence = first.evidence;
  if (of_this_plan_) {
    const auto agreement = best_agreement(places, config_.least_judged_m);
    of_this_plan_ = !agreement || *agreement >= config_.still_at_places;
  } else {
    of_this_plan_ = best_agreement(places, config_.least_again_m).value_or(0.0) >= config_.least_at_places;
  }
  said.lost = !of_this_plan_ ? PlanLost::kNotInPlan : at.size() > 1 ? PlanLost::kAmbiguous : PlanLost::kSearching;
  const bool agrees = first.followed_m >= config_.least_judged_m && first.agreement >= config_.least_at_place;
  if (agrees && places_.decided()) {
    said.lost = PlanLost::kNo;
    follow(at.front(), said.evidence);
  } else if (best_agreement(places, config_.least_judged_m).value_or(0.0) < config_.least_at_place) {
    search_beside(driven_m);  // it may be at a place that is not among these
  } else {
    searching_beside_ = false;
  }
  return said;
}

void PlanTracker::follow(const PoseCluster& place, double evidence) {
  start_at(place.pose, std::max(kLeastSpread_m, place.spread_m), std::max(kLeastSpread_rad, place.spread_rad));
  evidence_ = std::max(evidence, config_.least_evidence);
}

void PlanTracker::follow_evidence(double log_odds, const PlanEstimate& said) {
  if (said.lines_expected >= config_.doubtful_lines) {
    evidence_ += config_.evidence_share * (log_odds - evidence_);
    agreement_ += config_.evidence_share * (log_odds + said.explained - agreement_);
  }
  wrong_pictures_ = known_ && evidence_ < config_.wrong_evidence ? wrong_pictures_ + 1 : 0;
}

}  // namespace homeward::linemodel
