// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <deque>
#include <map>
#include <mutex>
#include <stop_token>
#include <thread>

#include "db/store.hpp"
#include "server/services/maps.hpp"
#include "server/ws/event_hub.hpp"

namespace homeward::server {

/// Builds maps, one at a time, on a thread of its own (which uses several for the pictures). What was queued or running
/// when the server ended is begun again at its next start.
class BuildJobs {
 public:
  BuildJobs(db::Store& store, MapService& maps, EventHub& events, int threads);
  /// Ends the running build; its job stays unfinished and is taken up at the next start.
  ~BuildJobs();
  BuildJobs(const BuildJobs&) = delete;
  BuildJobs& operator=(const BuildJobs&) = delete;

  struct NewMap {
    db::MapRecord map;
    wire::JobView job;
  };
  /// Errors: kNotFound (a tour), kConflict (a tour is not complete, or the cameras differ), kOverloaded.
  Result<NewMap> add_map(const std::string& name, const std::vector<TourId>& tours);
  /// Errors: kNotFound, kConflict (a build is under way, or the map has no tours), kOverloaded.
  Result<wire::JobView> rebuild(const MapId& map);
  /// Errors: kNotFound, kConflict (it has ended).
  Result<wire::JobView> cancel(const JobId& id);
  Result<wire::JobView> get(const JobId& id);
  [[nodiscard]] bool building(const MapId& map);

 private:
  void work(const std::stop_token& stop);
  void run(wire::JobView job, const std::stop_token& stop);
  Result<db::MapRecord> build(wire::JobView& job, const std::stop_token& stop);
  Result<wire::JobView> queue(const MapId& map);
  Status check_tours(const std::vector<TourId>& tours);
  void tell(const wire::JobView& job);
  void finish(wire::JobView& job, const Result<db::MapRecord>& result);

  db::Store& store_;
  MapService& maps_;
  EventHub& events_;
  int threads_;
  std::mutex mutex_;
  std::condition_variable_any ready_;
  std::deque<wire::JobView> queue_;
  std::optional<wire::JobView> running_;
  std::stop_source stop_running_;
  bool cancelled_ = false;  // the running one, by a person
  std::jthread thread_;
};

}  // namespace homeward::server
