// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <deque>
#include <map>
#include <mutex>
#include <stop_token>
#include <thread>

#include "db/store.hpp"
#include "pipeline/build_map.hpp"
#include "server/services/drafts.hpp"
#include "server/services/maps.hpp"
#include "server/time/clock.hpp"
#include "server/ws/event_hub.hpp"

namespace homeward::server {

/// Builds maps, lets them learn and tries drafts of them, one job at a time, on a thread of its own (which uses several
/// for the pictures). What was queued or running when the server ended is begun again at its next start. A job `refine`
/// without tours learns from what drives saw: it works out what the map would gain and offers that, or keeps it at once
/// where the map is set so. There is one of them for each map; a new drive sets it to work again.
class BuildJobs {
 public:
  BuildJobs(db::Store& store, MapService& maps, DraftService& drafts, EventHub& events, const Clock& clock,
            int threads);
  /// Ends the running build; its job stays unfinished and is taken up at the next start.
  ~BuildJobs();
  BuildJobs(const BuildJobs&) = delete;
  BuildJobs& operator=(const BuildJobs&) = delete;

  struct NewMap {
    db::MapRecord map;
    wire::JobView job;
  };
  /// `path`: taught as a path, by one tour. Errors: kNotFound (a tour), kConflict (a tour is not complete, or the
  /// cameras differ), kInvalidInput (a path of several tours), kOverloaded.
  Result<NewMap> add_map(const std::string& name, const std::vector<TourId>& tours, bool path);
  /// Errors: kNotFound, kConflict (a job of the map is under way, its pictures are not here, or it is a path),
  /// kOverloaded.
  Result<wire::JobView> rebuild(const MapId& map);
  /// `kind`: kAdd or kRefine, by tours. Errors: kNotFound (map or tour), kConflict (not built yet, a job of the map
  /// is under way, a tour is not complete or in the map already, or the cameras differ), kOverloaded.
  Result<wire::JobView> learn_from(const MapId& map, wire::JobKind kind, const std::vector<TourId>& tours);
  /// Tries a draft on the tours of its map. Errors: kNotFound, kConflict (the same is under way, or no tour of the map
  /// is kept), kOverloaded.
  Result<wire::JobView> check_draft(const MapId& map, const wire::DraftId& draft);
  /// Ends the check of a draft that is gone, where one waits or runs.
  void end_check(const wire::DraftId& draft);
  /// Keeps what a mission saw, unless the map is set not to learn by itself, and sets its job to work.
  void add_drive(const db::Drive& drive);
  /// The map is to have what the job offers. Errors: kNotFound, kConflict (it offers nothing), kOverloaded.
  Result<wire::JobView> take(const JobId& id);
  /// kOff also withdraws what waits. Errors: kNotFound.
  Result<db::MapRecord> set_refine(const MapId& map, wire::RefineMode mode);
  /// An offer is discarded. Errors: kNotFound, kConflict (it has ended).
  Result<wire::JobView> cancel(const JobId& id);
  Result<wire::JobView> get(const JobId& id);
  /// Whether a job of the map waits or runs.
  [[nodiscard]] bool building(const MapId& map);
  /// Returns once no job waits or runs.
  void work_off();

 private:
  void work(const std::stop_token& stop);
  void run(wire::JobView job, const std::stop_token& stop);
  Result<wire::JobState> build(wire::JobView& job, const std::stop_token& stop);
  Result<wire::JobState> teach(wire::JobView& job, const db::MapRecord& record, const std::stop_token& stop);
  Result<wire::JobState> learn(wire::JobView& job, const std::stop_token& stop);
  Result<wire::JobState> check(wire::JobView& job, const std::stop_token& stop);
  // One attempt each; the map may have changed meanwhile (kStaleRevision).
  Result<wire::JobState> add_tours(wire::JobView& job, const std::stop_token& stop);
  Result<wire::JobState> refine_by_tours(wire::JobView& job, const std::stop_token& stop);
  Result<wire::JobState> refine_by_drives(wire::JobView& job, const std::stop_token& stop);
  static bool learns_from_drives(const wire::JobView& job) {
    return job.kind == wire::JobKind::kRefine && job.tours.empty();
  }
  void look_for_drives(const MapId& map);
  bool forget_drives_of(const wire::JobView& job);
  Result<wire::JobState> keep_learnt(wire::JobView& job, const map::TopologicalMap& map,
                                     const db::Thumbnails& thumbnails, std::int64_t revision);
  /// Adds to a job's notes which edits the map could not keep.
  static void tell_lost_edits(wire::JobView& job, const std::vector<map::Edit>& before,
                              const std::vector<map::Edit>& after);
  pipeline::ProgressSink progress_of(wire::JobView& job);
  Result<wire::JobView> queue(wire::JobView job);
  Result<wire::JobView> queue_locked(wire::JobView job);
  Status check_tours(const std::vector<TourId>& tours);
  void tell(const wire::JobView& job);
  void finish(wire::JobView& job, const Result<wire::JobState>& result);

  db::Store& store_;
  MapService& maps_;
  DraftService& drafts_;
  EventHub& events_;
  const Clock& clock_;
  int threads_;
  std::mutex mutex_;
  std::condition_variable_any ready_;
  std::condition_variable idle_;
  std::deque<wire::JobView> queue_;
  std::optional<wire::JobView> running_;
  bool at_work_ = false;  // from before a job runs until after what follows from its end
  std::stop_source stop_running_;
  bool cancelled_ = false;  // the running one, by a person
  std::jthread thread_;
};

}  // namespace homeward::server
