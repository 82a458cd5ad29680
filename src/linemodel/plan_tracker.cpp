// SPDX-License-Identifier: Apache-2.0
#include "linemodel/plan_tracker.hpp"

#include <cmath>
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
constexpr double kNewSight_m = 1e3;      // a picture of which nothing is known in common with the last one
constexpr double kMetresPerTurn = 0.3;   // a turn shows something new too
constexpr double kWithoutOdometry_m = 0.25;
constexpr double kFacesAbout_rad = 0.5;  // a start with a wider spread of headings does not say where the robot faces
constexpr int kBeams = 60;
constexpr double kBeamSpread_m = 0.12;
constexpr double kBeamRandom = 0.15;  // share of ranges to what no plan shows
constexpr double kUnmet = 10.0;       // spreads off whatever is drawn
constexpr double kBeamsAlike = 0.15;  // of the beams' evidence counts, as neighbours hit the same

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

Result<PlanTracker> PlanTracker::create(Plan plan, const camera::CameraConfig& config,
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
  PlanTracker tracker(std::move(plan), **camera, std::move(*floor), tracking);
  tracker.start_anywhere();
  return tracker;
}

PlanTracker::PlanTracker(Plan plan, const camera::Camera& camera, PlanFloor floor, const PlanTrackerConfig& config)
    : config_(config),
      views_(camera),
      expectation_(camera),
      visible_(plan, camera.config().robot_from_camera_translation_m.z(), config.visibility),
      floor_(std::move(floor)),
      at_sweep_(plan, config.sweep_height_m - 0.03, config.sweep_height_m + 0.03),
      monte_carlo_(floor_.free_points_m(), PlanFloor::kSpacing_m, config.monte_carlo) {}

void PlanTracker::start_anywhere() {
  monte_carlo_.start_anywhere();
  known_ = false;
  evidence_ = 0.0;
  wrong_pictures_ = 0;
}

void PlanTracker::start_at(const Pose2& pose, double spread_m, double spread_rad) {
  monte_carlo_.start_at(pose, spread_m, spread_rad);
  known_ = spread_m <= config_.known_spread_m && spread_rad <= kFacesAbout_rad;
  evidence_ = 1.5 * config_.least_evidence;  // somebody has said so
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

double PlanTracker::move(const std::optional<Pose2>& odometry) {
  double driven_m = kNewSight_m;
  if (odometry && last_odometry_) {
    const Pose2 moved = inverse(*last_odometry_) * *odometry;
    driven_m = std::hypot(moved.x_m, moved.y_m) + kMetresPerTurn * std::abs(moved.theta_rad);
    monte_carlo_.move(moved);
  } else if (!odometry) {
    monte_carlo_.spread(kWithoutOdometry_m);
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
  expectation_.expect(pose, visible_.around(eye_m.head<2>()), view_);
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
  const double driven_m = move(odometry);
  MeasureConfig measure = config_.measure;
  if (!known_) {
    measure.tolerance_rad *= config_.wide;
    measure.cell_rad *= config_.wide;
    measure.spread_rad *= config_.wide;
  }
  const PictureLines seen(lines_, expectation_.space(), measure);
  const double independent_m = known_ ? config_.independent_m : config_.wide_independent_m;
  const double gain = (known_ ? config_.gain : config_.wide_gain) * std::min(1.0, driven_m / independent_m);
  const RangeSweep* ranges = sweep ? &*sweep : nullptr;
  monte_carlo_.weigh([&](const Pose2& pose) { return fit(seen, gain, ranges, pose); });
  return estimate(PictureLines(lines_, expectation_.space(), config_.measure));
}

PlanEstimate PlanTracker::estimate(const PictureLines& lines) {
  const std::vector<PoseCluster> places = monte_carlo_.clusters(kReach_m, kReach_rad, kMostPlaces);
  PlanEstimate said;
  said.particles = monte_carlo_.particles().size();
  said.lines_seen = static_cast<int>(lines_.size());
  if (places.empty()) return said;
  said.pose = places.front().pose;
  said.spread_m = places.front().spread_m;
  said.spread_rad = places.front().spread_rad;
  said.share = places.front().share;
  for (std::size_t i = 1; i < places.size(); ++i) {
    if (places[i].share >= kOther) said.others.push_back(places[i]);
  }
  const ExpectedView view = expected(said.pose);
  said.lines_expected = static_cast<int>(view.lines.size());
  said.lines_confirmed = lines.confirmed_count(view);
  known_ =
      said.share >= (known_ ? config_.still_share : config_.known_share) && said.spread_m <= config_.known_spread_m;
  said.log_odds = lines.log_odds(view);
  follow_evidence(said.log_odds, said);
  said.evidence = evidence_;
  said.lost = evidence_ < config_.least_evidence ? PlanLost::kNotInPlan
              : known_                           ? PlanLost::kNo
              : said.others.empty()              ? PlanLost::kSearching
                                                 : PlanLost::kAmbiguous;
  if (wrong_pictures_ > config_.most_wrong_pictures) start_anywhere();
  return said;
}

void PlanTracker::follow_evidence(double log_odds, const PlanEstimate& said) {
  if (said.lines_expected < config_.doubtful_lines) return;
  evidence_ += config_.evidence_share * (log_odds - evidence_);
  wrong_pictures_ = known_ && evidence_ < config_.wrong_evidence ? wrong_pictures_ + 1 : 0;
}

}  // namespace homeward::linemodel
