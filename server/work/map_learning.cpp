// SPDX-License-Identifier: Apache-2.0
#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>

#include "pipeline/grow_map.hpp"
#include "pipeline/refine_map.hpp"
#include "server/work/build_jobs.hpp"
#include "server/work/job_notes.hpp"
#include "server/work/stored_drives.hpp"
#include "server/work/stored_tours.hpp"

namespace homeward::server {
namespace {

constexpr int kMostAttempts = 3;
constexpr std::int64_t kAddedBytesPerPlace = 18'000;  // on average: two appearances besides the prototype's

std::string where_of(const MapId& map) { return "maps/" + map.str(); }

pipeline::RefineOptions refine_options(const map::TopologicalMap& map, int threads) {
  pipeline::RefineOptions options;
  options.threads = threads;
  options.spare_bytes = kAddedBytesPerPlace * static_cast<std::int64_t>(map.places.size());
  for (const map::Place& place : map.places) {
    for (std::size_t i = 1; i < place.appearances.size(); ++i) {
      options.spare_bytes -= mapping::kept_bytes(place.appearances[i]);
    }
  }
  return options;
}

}  // namespace

Result<wire::JobView> BuildJobs::learn_from(const MapId& map, wire::JobKind kind, const std::vector<TourId>& tours) {
  const auto record = store_.map(map);
  if (!record) return pass_on(record);
  if (record->revision == 0) return fail(ErrorCode::kConflict, "The map has not been built yet.", where_of(map));
  std::vector<TourId> of_one_camera = tours;
  if (kind == wire::JobKind::kAdd) {
    for (const TourId& tour : tours) {
      if (std::find(record->tours.begin(), record->tours.end(), tour) != record->tours.end()) {
        return fail(ErrorCode::kConflict, "The map has this tour already.", "tours/" + tour.str());
      }
    }
    of_one_camera.insert(of_one_camera.begin(), record->tours.begin(), record->tours.end());
  }
  if (const Status status = check_tours(of_one_camera); !status) return pass_on(status);
  if (building(map)) return fail(ErrorCode::kConflict, "A job of this map is under way.", where_of(map));
  wire::JobView job;
  job.kind = kind;
  job.map = map;
  job.tours = tours;
  return queue(std::move(job));
}

Result<wire::JobState> BuildJobs::learn(wire::JobView& job, const std::stop_token& stop) {
  for (int attempt = 0; attempt < kMostAttempts; ++attempt) {
    auto result = job.kind == wire::JobKind::kAdd ? add_tours(job, stop)
                  : learns_from_drives(job)       ? refine_by_drives(job, stop)
                                                  : refine_by_tours(job, stop);
    if (result || result.error().code != ErrorCode::kStaleRevision) return result;
    spdlog::info("job {}: map {} was changed meanwhile; once more", job.id.str(), job.map.str());
  }
  return fail(ErrorCode::kConflict, "The map was changed again and again while it was to learn.", where_of(job.map));
}

Result<wire::JobState> BuildJobs::add_tours(wire::JobView& job, const std::stop_token& stop) {
  const auto begin = clock_.steady();
  const auto record = store_.map(job.map);
  if (!record) return pass_on(record);
  const auto tours = open_tours(store_, job.tours);
  if (!tours) return pass_on(tours);
  const auto loaded = maps_.load(job.map);
  if (!loaded) return pass_on(loaded);
  auto added = pipeline::add_tours((*loaded)->map, tours->views(), tours->camera, {record->name, threads_, 1},
                                   progress_of(job), stop);
  if (!added) return pass_on(added);
  map::TopologicalMap& map = added->grown.map;
  map.build_seconds += std::chrono::duration<double>(clock_.steady() - begin).count();
  db::Thumbnails thumbnails = (*loaded)->thumbnails;
  if (const Status made = add_thumbnails(map, *tours, stop, thumbnails); !made) return pass_on(made);
  job.skipped = static_cast<std::int64_t>(added->skipped.size());
  job.notes = notes_of(added->grown.added);
  for (wire::Reason& note : notes_of_skipped(added->skipped)) job.notes.push_back(std::move(note));
  return keep_learnt(job, map, thumbnails, (*loaded)->map.revision);
}

Result<wire::JobState> BuildJobs::refine_by_tours(wire::JobView& job, const std::stop_token& stop) {
  const auto tours = open_tours(store_, job.tours);
  if (!tours) return pass_on(tours);
  const auto loaded = maps_.load(job.map);
  if (!loaded) return pass_on(loaded);
  pipeline::RefineOptions options = refine_options((*loaded)->map, threads_);
  map::TopologicalMap map = (*loaded)->map;
  mapping::Refinement all;
  std::vector<Error> skipped;
  for (const auto& source : tours->sources) {
    auto refined = pipeline::refine_map(map, *source, tours->camera, options, progress_of(job), stop);
    if (!refined) return pass_on(refined);
    map = std::move(refined->map);
    options.spare_bytes -= refined->refinement.bytes;
    all.over_budget += refined->refinement.over_budget;
    all.gained.insert(all.gained.end(), refined->refinement.gained.begin(), refined->refinement.gained.end());
    skipped.insert(skipped.end(), refined->skipped.begin(), refined->skipped.end());
  }
  job.gained = static_cast<std::int64_t>(all.gained.size());
  job.skipped = static_cast<std::int64_t>(skipped.size());
  job.notes = notes_of(map, all, false);
  for (wire::Reason& note : notes_of_skipped(skipped)) job.notes.push_back(std::move(note));
  if (all.gained.empty()) {
    job.notes.insert(job.notes.begin(), wire::Reason{wire::ReasonCode::kNothingNew});
    return wire::JobState::kDone;
  }
  map.revision = (*loaded)->map.revision + 1;
  return keep_learnt(job, map, (*loaded)->thumbnails, (*loaded)->map.revision);
}

Result<wire::JobState> BuildJobs::refine_by_drives(wire::JobView& job, const std::stop_token& stop) {
  const auto record = store_.map(job.map);
  if (!record) return pass_on(record);
  const auto loaded = maps_.load(job.map);
  if (!loaded) return pass_on(loaded);
  if (!job.taken) {
    const auto drives = store_.drives(job.map);
    if (!drives) return pass_on(drives);
    job.drives = *drives;
  }
  job.stage = "places";
  job.share = 0.0;
  tell(job);
  const auto drives = drives_of(store_, job.drives, (*loaded)->map);
  if (!drives) return pass_on(drives);
  const std::vector<pipeline::DriveSight> sights = one_after_the_other(*drives);
  const auto refined =
      pipeline::refine_by_sights((*loaded)->map, sights, refine_options((*loaded)->map, threads_), stop);
  if (!refined) return pass_on(refined);
  const bool at_once = job.taken || record->refine == wire::RefineMode::kAuto;
  const mapping::Refinement& refinement = refined->refinement;
  job.gained = static_cast<std::int64_t>(refinement.gained.size());
  job.notes = notes_of(refined->map, refinement, !at_once);
  const auto certain =
      std::count_if(refined->sure.begin(), refined->sure.end(), [](const PlaceId& p) { return !p.empty(); });
  spdlog::info("job {}: {} sights of {} drives, {} at places that are certain, {} new appearances", job.id.str(),
               sights.size(), job.drives.size(), certain, job.gained);
  if (refinement.gained.empty()) {
    if (job.taken) job.notes.insert(job.notes.begin(), wire::Reason{wire::ReasonCode::kOfferOutdated});
    return wire::JobState::kDone;
  }
  if (!at_once) return wire::JobState::kOffered;
  return keep_learnt(job, refined->map, (*loaded)->thumbnails, (*loaded)->map.revision);
}

Result<wire::JobState> BuildJobs::keep_learnt(wire::JobView& job, const map::TopologicalMap& map,
                                              const db::Thumbnails& thumbnails, std::int64_t revision) {
  if (const auto before = maps_.load(job.map)) tell_lost_edits(job, (*before)->map.edits, map.edits);
  wire::JobView after = job;
  after.state = wire::JobState::kDone;
  after.share = 1.0;
  db::AlongWithContents along{{}, job.drives, after};
  if (job.kind == wire::JobKind::kAdd) along.new_tours = job.tours;
  const auto kept = maps_.keep_learnt(job.map, map, thumbnails, revision, along);
  if (!kept) return pass_on(kept);
  return wire::JobState::kDone;
}

void BuildJobs::add_drive(const db::Drive& drive) {
  const auto record = store_.map(drive.map);
  if (!record || record->refine == wire::RefineMode::kOff) return;
  if (const Status status = store_.add_drive(drive); !status) {
    spdlog::error("mission {} teaches nothing: {}", drive.mission.str(), status.error().message);
    return;
  }
  look_for_drives(drive.map);
}

void BuildJobs::look_for_drives(const MapId& map) {
  const std::scoped_lock lock(mutex_);
  const auto drives = store_.drives(map);
  const auto jobs = store_.jobs();
  if (!drives || !jobs) return;
  wire::JobView job;
  job.kind = wire::JobKind::kRefine;
  job.map = map;
  for (const wire::JobView& known : *jobs) {
    if (!learns_from_drives(known) || known.map != map) continue;
    if (known.state == wire::JobState::kQueued || known.state == wire::JobState::kRunning)
      return;  // looks when it ends
    if (known.state == wire::JobState::kOffered) job = known;
  }
  const bool fresh = std::any_of(drives->begin(), drives->end(), [&](const MissionId& drive) {
    return std::find(job.drives.begin(), job.drives.end(), drive) == job.drives.end();
  });
  if (!fresh) return;
  if (const auto queued = queue_locked(std::move(job)); !queued) {
    spdlog::warn("map {} learns later: {}", map.str(), queued.error().message);
  }
}

bool BuildJobs::forget_drives_of(const wire::JobView& job) {
  std::vector<MissionId> used = job.drives;
  if (used.empty()) {  // it had not begun
    if (const auto all = store_.drives(job.map)) used = *all;
  }
  const Status status = store_.use_drives(used);
  if (!status) spdlog::error("drives on map {} cannot be forgotten: {}", job.map.str(), status.error().message);
  return status.has_value();
}

Result<wire::JobView> BuildJobs::take(const JobId& id) {
  const std::scoped_lock lock(mutex_);
  auto job = store_.job(id);
  if (!job) return job;
  if (job->state != wire::JobState::kOffered) {
    return fail(ErrorCode::kConflict,
                "The job offers nothing: it is " + std::string(wire::job_state_name(job->state)) + ".",
                "jobs/" + id.str());
  }
  job->taken = true;
  return queue_locked(std::move(*job));
}

Result<db::MapRecord> BuildJobs::set_refine(const MapId& map, wire::RefineMode mode) {
  if (const Status status = store_.set_map_refine(map, mode); !status) return pass_on(status);
  if (mode == wire::RefineMode::kOff) {
    if (const auto jobs = store_.jobs()) {
      for (const wire::JobView& job : *jobs) {
        if (learns_from_drives(job) && job.map == map && job.state <= wire::JobState::kOffered) {
          static_cast<void>(cancel(job.id));  // it may just have ended
        }
      }
    }
  }
  auto record = store_.map(map);
  if (record) maps_.tell(*record);
  return record;
}

}  // namespace homeward::server
