// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "camera/camera_config.hpp"
#include "core/image.hpp"
#include "db/store.hpp"
#include "localisation/localiser.hpp"
#include "pipeline/plan_witness.hpp"
#include "server/driving/plan_record.hpp"
#include "server/services/maps.hpp"
#include "server/services/plans.hpp"
#include "server/time/clock.hpp"
#include "server/work/work_pool.hpp"
#include "server/ws/event_hub.hpp"

namespace homeward::server {

/// A picture that the belief of a robot has looked at.
struct SeenPicture {
  RobotId robot;
  MapId map;  // that the belief is of
  camera::CameraConfig camera;
  std::shared_ptr<const Image> picture;
  std::optional<Pose2> odometry;
  TimeUs t_us = 0;                   // when it was taken
  localisation::Belief belief;       // after it
  std::optional<MissionId> mission;  // that it was on
  bool anew = false;                 // what was seen before says nothing of where the robot is
  bool odometry_anew = false;        // odometry was begun anew since the picture before
  std::vector<PlaceId> said;         // where the robot is, as somebody has said since the picture before
};

/// Follows robots on the drawn plans that their maps are tied to (pipeline::PlanWitness), by the pictures that their
/// beliefs look at, and tells dashboards where it finds them. It is shown and acts on nothing. On a pool of its own, so
/// that it holds up no belief: of each robot one picture is in hand and one waits, in whose place the next one comes.
/// Thread-safe.
class PlanFollower {
 public:
  static constexpr std::chrono::milliseconds kToldEvery{500};  // of each robot, at most
  static constexpr std::chrono::seconds kKept{60};             // a robot that sends no pictures, as its belief is
  static constexpr std::chrono::seconds kLooksAgain{5};        // where a robot stands: it sees the same
  static constexpr int kMostRobots = 8;                    // that are followed at a time: each has its own particles
  static constexpr std::int64_t kMostLines = 10'000;       // of a plan,
  static constexpr std::int64_t kMostTriangles = 100'000;  // that hide them,
  static constexpr std::size_t kMostKept_bytes = 128U << 20U;  // and of what is visible from where, of each robot

  /// All have to outlive it.
  PlanFollower(db::Store& store, MapService& maps, PlanService& plans, EventHub& events, WorkPool& pool,
               WorkPool& journal, const Clock& clock)
      : store_(store),
        maps_(maps),
        plans_(plans),
        events_(events),
        pool_(pool),
        clock_(clock),
        record_(store, journal) {}

  /// Takes a picture up, and does not wait for what comes of it.
  void look(SeenPicture seen);
  /// The robot is gone, or on another map. What is in hand of it is not told any more.
  void forget(const RobotId& robot);
  /// Every now and then: forgets robots that have sent no picture for kKept.
  void tick(SteadyTime now);
  /// At the end: hands to the journal what was said and is not kept yet. Once the pool has stopped.
  void keep_what_is_left() { record_.keep_what_is_left(); }

 private:
  /// What a witness is of; another one: another witness.
  struct Subject {
    MapId map;
    wire::PlanId plan;
    std::int64_t version = 0;
    TimeUs tied_us = 0;
    std::string camera;
    bool operator==(const Subject&) const = default;
  };
  using Told = std::shared_ptr<const wire::PlanPoseView>;
  struct Followed {
    // Guarded by mutex_:
    std::optional<SeenPicture> waiting;
    bool in_hand = false;
    SteadyTime seen_at;
    std::optional<SteadyTime> told_at;
    // The worker's while a picture is in hand:
    Subject subject;
    std::int64_t revision = 0;  // of the map, whose places the witness knows
    std::shared_ptr<pipeline::PlanWitness> witness;
    Told told;                         // of the last picture that it was shown,
    std::optional<Pose2> looked_from;  // and where that was taken, by odometry
    SteadyTime looked_at;
    std::string problem;  // why it is not followed, as it was logged last
  };
  using Robot = std::shared_ptr<Followed>;

  /// With mutex_ held: hands what waits to the pool.
  void begin(const RobotId& id, const Robot& robot);
  void work(const RobotId& id, const Robot& robot);
  /// Nothing where the map is tied to no plan, or the robot cannot be followed on it.
  Told follow(Followed& robot, const SeenPicture& seen);
  /// The witness of the map's present tie; none where one could not be made before. Errors: why there can be none.
  Status make_ready(Followed& robot, const SeenPicture& seen, const db::MapPlanRecord& tie);
  using Witness = Result<std::shared_ptr<pipeline::PlanWitness>>;
  Witness new_witness(const SeenPicture& seen, const db::MapPlanRecord& tie,
                      const std::vector<map::PlacedOnPlan>& places);
  /// A picture from where the last one was taken, soon after it.
  [[nodiscard]] bool stands(const Followed& robot, const SeenPicture& seen) const;
  /// Shows it the picture. Null where that cannot be.
  Told show(Followed& robot, const SeenPicture& seen, const db::MapPlanRecord& tie);
  /// Logs why a robot is not followed, once.
  static void note_problem(Followed& robot, const SeenPicture& seen, const std::string& why);
  /// Frees a witness, whose particles and lines are many, on the pool.
  void drop(Robot robot);

  db::Store& store_;
  MapService& maps_;
  PlanService& plans_;
  EventHub& events_;
  WorkPool& pool_;
  const Clock& clock_;
  PlanRecord record_;
  std::mutex mutex_;
  std::map<RobotId, Robot> robots_;
  std::vector<std::weak_ptr<const pipeline::PlanWitness>> witnesses_;  // those that live
};

}  // namespace homeward::server
