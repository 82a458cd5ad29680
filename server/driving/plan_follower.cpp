// SPDX-License-Identifier: Apache-2.0
#include "server/driving/plan_follower.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "linemodel/resample.hpp"
#include "map/plan_tie.hpp"
#include "wire/camera_json.hpp"

namespace homeward::server {
namespace {

/// `newer` takes the place of a picture that nobody has looked at: what that would have begun with is its own now.
SeenPicture in_place_of(SeenPicture older, SeenPicture newer) {
  if (newer.anew) return newer;
  newer.anew = older.anew;
  newer.odometry_anew = newer.odometry_anew || older.odometry_anew;
  if (newer.said.empty()) newer.said = std::move(older.said);
  return newer;
}

std::optional<wire::PlanLoss> loss_of(linemodel::PlanLost lost) {
  switch (lost) {
    case linemodel::PlanLost::kSearching:
      return wire::PlanLoss::kSearching;
    case linemodel::PlanLost::kAmbiguous:
      return wire::PlanLoss::kAmbiguous;
    case linemodel::PlanLost::kNotInPlan:
      return wire::PlanLoss::kNotInPlan;
    case linemodel::PlanLost::kNo:
      break;
  }
  return std::nullopt;
}

wire::PlaceOnPlan word_of(pipeline::PlanWord word) {
  switch (word) {
    case pipeline::PlanWord::kPossible:
      return wire::PlaceOnPlan::kPossible;
    case pipeline::PlanWord::kImpossible:
      return wire::PlaceOnPlan::kImpossible;
    case pipeline::PlanWord::kSilent:
      break;
  }
  return wire::PlaceOnPlan::kSilent;
}

/// As many as are told, each as often as its weight says.
std::vector<Pose2> even_choice(const std::vector<linemodel::Particle>& particles) {
  std::vector<Pose2> poses;
  const bool weighed = std::ranges::any_of(particles, [](const auto& one) { return one.weight > 0.0; });
  if (!weighed) return poses;
  const auto count = std::min(particles.size(), wire::kMaxPlanParticles);
  for (const linemodel::Particle& one : linemodel::low_variance_resample(particles, count, 0.5)) {
    poses.push_back(one.pose);
  }
  return poses;
}

}  // namespace

void PlanFollower::look(SeenPicture seen) {
  const std::scoped_lock lock(mutex_);
  const RobotId id = seen.robot;
  Robot& robot = robots_[id];
  if (!robot) robot = std::make_shared<Followed>();
  robot->seen_at = clock_.steady();
  robot->waiting = robot->waiting ? in_place_of(std::move(*robot->waiting), std::move(seen)) : std::move(seen);
  begin(id, robot);
}

void PlanFollower::begin(const RobotId& id, const Robot& robot) {
  if (robot->in_hand || !robot->waiting) return;
  // When the pool is full it goes on waiting; the next picture takes its place.
  robot->in_hand = pool_.try_run([this, id, robot] { work(id, robot); });
}

void PlanFollower::forget(const RobotId& robot) {
  record_.note(robot, std::nullopt, nullptr);
  Robot gone;
  {
    const std::scoped_lock lock(mutex_);
    const auto found = robots_.find(robot);
    if (found == robots_.end()) return;
    gone = std::move(found->second);
    gone->waiting.reset();
    robots_.erase(found);
  }
  drop(std::move(gone));
}

void PlanFollower::tick(SteadyTime now) {
  std::vector<Robot> gone;
  {
    const std::scoped_lock lock(mutex_);
    std::erase_if(robots_, [&](auto& one) {
      if (one.second->in_hand || now - one.second->seen_at <= kKept) return false;
      record_.note(one.first, std::nullopt, nullptr);
      gone.push_back(std::move(one.second));
      return true;
    });
  }
  for (Robot& one : gone) drop(std::move(one));
}

void PlanFollower::drop(Robot robot) {
  static_cast<void>(pool_.try_run([robot = std::move(robot)] {}));
}

void PlanFollower::work(const RobotId& id, const Robot& robot) {
  std::optional<SeenPicture> seen;
  {
    const std::scoped_lock lock(mutex_);
    seen = std::exchange(robot->waiting, std::nullopt);
  }
  Told told;
  if (seen) {
    try {
      told = follow(*robot, *seen);
    } catch (const std::exception& exception) {
      robot->witness.reset();
      note_problem(*robot, *seen, exception.what());
    }
  }
  const std::scoped_lock lock(mutex_);
  robot->in_hand = false;
  const auto present = robots_.find(id);
  if (present == robots_.end() || present->second != robot) return;  // forgotten meanwhile
  const SteadyTime now = clock_.steady();
  if (told && (!robot->told_at || now - *robot->told_at >= kToldEvery)) {
    robot->told_at = now;
    events_.publish(wire::PlanPoseTold{told});
  }
  begin(id, robot);
}

PlanFollower::Told PlanFollower::follow(Followed& robot, const SeenPicture& seen) {
  record_.note(seen.robot, seen.mission, nullptr);  // the mission before this one may be over
  const auto tie = store_.map_plan(seen.map);
  if (!tie) {
    if (tie.error().code != ErrorCode::kNotFound) {
      note_problem(robot, seen, tie.error().message);
    } else {
      robot.witness.reset();
      robot.subject = {};
    }
    return nullptr;
  }
  if (const Status ready = make_ready(robot, seen, *tie); !ready) {
    robot.witness.reset();
    note_problem(robot, seen, ready.error().message);
    return nullptr;
  }
  if (!robot.witness) return nullptr;
  if (stands(robot, seen)) return robot.told;
  robot.told = show(robot, seen, *tie);
  record_.note(seen.robot, seen.mission, robot.told.get());
  return robot.told;
}

bool PlanFollower::stands(const Followed& robot, const SeenPicture& seen) const {
  constexpr double kMoved_m = 0.03;
  constexpr double kTurned_rad = 0.03;
  if (!robot.told || seen.anew || seen.odometry_anew || !seen.said.empty()) return false;
  if (!robot.looked_from || !seen.odometry || clock_.steady() - robot.looked_at >= kLooksAgain) return false;
  const Pose2 moved = inverse(*robot.looked_from) * *seen.odometry;
  return position_m(moved).norm() < kMoved_m && std::abs(moved.theta_rad) < kTurned_rad;
}

PlanFollower::Told PlanFollower::show(Followed& robot, const SeenPicture& seen, const db::MapPlanRecord& tie) {
  pipeline::PlanWitness& witness = *robot.witness;
  if (seen.anew) witness.start_anywhere();
  if (seen.odometry_anew) witness.restart_odometry();
  if (!seen.said.empty()) witness.start_at(seen.said);
  const auto estimate = witness.update(*seen.picture, seen.odometry);
  if (!estimate) {
    note_problem(robot, seen, estimate.error().message);
    return nullptr;
  }
  robot.problem.clear();
  robot.looked_from = seen.odometry;
  robot.looked_at = clock_.steady();
  auto view = std::make_shared<wire::PlanPoseView>();
  view->robot = seen.robot;
  view->map = seen.map;
  view->plan = tie.plan;
  view->version = tie.version;
  view->tied_us = tie.tied_us;
  view->t_us = seen.t_us;
  view->pose = estimate->pose;
  view->spread_m = estimate->spread_m;
  view->lost = loss_of(estimate->lost);
  if (!seen.belief.lost && !seen.belief.top.empty()) view->place = seen.belief.top.front().place;
  view->word = word_of(witness.hear(seen.belief));
  view->lines_expected = estimate->lines_expected;
  view->lines_confirmed = estimate->lines_confirmed;
  view->particles = even_choice(witness.tracker().particles());
  return view;
}

Status PlanFollower::make_ready(Followed& robot, const SeenPicture& seen, const db::MapPlanRecord& tie) {
  const auto loaded = maps_.load(seen.map);
  if (!loaded) {
    robot.subject = {};
    return pass_on(loaded);
  }
  const std::int64_t revision = (*loaded)->map.revision;
  Subject subject{seen.map, tie.plan, tie.version, tie.tied_us, wire::camera_to_json(seen.camera).dump()};
  const bool known = robot.subject == subject;
  if (known && (!robot.witness || robot.revision == revision)) return {};  // what cannot be followed is not tried again
  const auto places = map::lay_on_plan((*loaded)->map, *maps_.layout(*loaded), tie.pins).places;
  robot.revision = revision;
  if (known) {
    robot.witness->set_places(places);
    return {};
  }
  robot.witness.reset();
  robot.told.reset();
  robot.subject = std::move(subject);
  auto witness = new_witness(seen, tie, places);
  if (!witness) {
    const bool may_pass = witness.error().code == ErrorCode::kOverloaded || witness.error().code == ErrorCode::kIo;
    if (may_pass) robot.subject = {};
    return pass_on(witness);
  }
  robot.witness = std::move(*witness);
  return {};
}

PlanFollower::Witness PlanFollower::new_witness(const SeenPicture& seen, const db::MapPlanRecord& tie,
                                                const std::vector<map::PlacedOnPlan>& places) {
  {
    const std::scoped_lock lock(mutex_);
    std::erase_if(witnesses_, [](const auto& one) { return one.expired(); });
    if (witnesses_.size() >= kMostRobots) {
      return fail(ErrorCode::kOverloaded, "As many robots are followed on plans as may be.",
                  "robots/" + seen.robot.str());
    }
  }
  const std::string where = "plans/" + tie.plan.str();
  const auto version = plans_.version(tie.plan, tie.version);
  if (!version) return pass_on(version);
  if (version->lines > kMostLines || version->triangles > kMostTriangles) {
    return fail(ErrorCode::kInvalidInput, "The plan has too many lines to follow a robot by.", where);
  }
  auto plan = plans_.read(tie.plan, *version);
  if (!plan) return pass_on(plan);
  pipeline::PlanWitnessConfig config;
  config.tracker.visibility.most_kept_bytes = kMostKept_bytes;
  auto made = pipeline::PlanWitness::create(*plan, seen.camera, places, config);
  if (!made) return pass_on(made);
  auto witness = std::make_shared<pipeline::PlanWitness>(std::move(*made));
  const std::scoped_lock lock(mutex_);
  witnesses_.push_back(witness);
  return witness;
}

void PlanFollower::note_problem(Followed& robot, const SeenPicture& seen, const std::string& why) {
  if (robot.problem == why) return;
  robot.problem = why;
  spdlog::warn("robot {} is not followed on the plan of map {}: {}", seen.robot.str(), seen.map.str(), why);
}

}  // namespace homeward::server
