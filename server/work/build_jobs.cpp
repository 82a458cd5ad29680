// SPDX-License-Identifier: Apache-2.0
#include "server/work/build_jobs.hpp"

#include <spdlog/spdlog.h>
#include <sys/resource.h>

#include <chrono>
#include <nlohmann/json.hpp>

#include "pipeline/build_map.hpp"
#include "server/services/tours.hpp"
#include "server/work/build_record.hpp"
#include "server/work/job_notes.hpp"
#include "server/work/stored_tours.hpp"

namespace homeward::server {
namespace {

constexpr std::size_t kMostQueued = 16;
constexpr int kBuildNiceness = 10;   // robots that drive come first
constexpr double kBuildShare = 0.9;  // the rest: thumbnails, the report and writing
constexpr std::chrono::milliseconds kTellEvery{250};

}  // namespace

BuildJobs::BuildJobs(db::Store& store, MapService& maps, DraftService& drafts, EventHub& events, const Clock& clock,
                     int threads)
    : store_(store), maps_(maps), drafts_(drafts), events_(events), clock_(clock), threads_(threads) {
  if (const auto unfinished = store_.unfinished_jobs()) {
    queue_.assign(unfinished->begin(), unfinished->end());
  } else {
    spdlog::error("unfinished jobs cannot be read: {}", unfinished.error().message);
  }
  // Drives that were kept just before the server ended, and no job knew of.
  if (const auto known = store_.maps()) {
    for (const db::MapRecord& map : *known) look_for_drives(map.id);
  }
  thread_ = std::jthread([this](const std::stop_token& stop) {
    setpriority(PRIO_PROCESS, 0, kBuildNiceness);  // of this thread and of those that it starts
    work(stop);
  });
}

BuildJobs::~BuildJobs() {
  thread_.request_stop();
  {
    const std::scoped_lock lock(mutex_);
    stop_running_.request_stop();
  }
  thread_.join();
}

Status BuildJobs::check_tours(const std::vector<TourId>& tours) {
  nlohmann::json first_camera;
  for (const TourId& id : tours) {
    const auto tour = store_.tour(id);
    if (!tour) return pass_on(tour);
    const std::string where = "tours/" + id.str();
    if (!tour->complete) return fail(ErrorCode::kConflict, "The tour is not complete yet.", where);
    const nlohmann::json camera = nlohmann::json::parse(tour->camera);
    if (first_camera.is_null()) first_camera = camera;
    if (camera != first_camera) {
      return fail(ErrorCode::kConflict, "The tours of one map must be made with the same camera.", where);
    }
  }
  return {};
}

Result<BuildJobs::NewMap> BuildJobs::add_map(const std::string& name, const std::vector<TourId>& tours, bool path) {
  if (path && tours.size() != 1) return fail(ErrorCode::kInvalidInput, "A path is taught by one tour.", "body/tours");
  if (const Status status = check_tours(tours); !status) return pass_on(status);
  db::MapRecord record;
  record.path = path;
  record.name = name;
  record.tours = tours;
  record.created_us = clock_.wall_us();
  const auto map = store_.add_map(record);
  if (!map) return pass_on(map);
  maps_.tell(*map);
  wire::JobView asked;
  asked.map = map->id;
  const auto job = queue(std::move(asked));
  if (!job) {
    if (const Status removed = store_.remove_map(map->id); !removed) {
      spdlog::error("map {} cannot be removed: {}", map->id.str(), removed.error().message);
    }
    return pass_on(job);
  }
  return NewMap{*map, *job};
}

Result<wire::JobView> BuildJobs::rebuild(const MapId& map) {
  const auto record = store_.map(map);
  if (!record) return pass_on(record);
  const std::string where = "maps/" + map.str();
  const auto imported = [&] {
    return fail(ErrorCode::kConflict, "The map was imported; its pictures are not here.", where);
  };
  if (record->tours.empty()) return imported();
  if (record->path && record->revision > 0) {
    return fail(ErrorCode::kConflict, "A path is taught once; make a new map of its tour to teach it anew.", where);
  }
  const auto loaded = maps_.to_build_on(map);
  if (!loaded) return pass_on(loaded);
  if (*loaded) {
    // An imported map may have gained tours of this server since.
    for (const auto& image : (*loaded)->map.images) {
      const TourId tour(image.id.str().substr(0, image.id.str().find('/')));
      if (std::find(record->tours.begin(), record->tours.end(), tour) == record->tours.end()) return imported();
    }
  }
  if (building(map)) return fail(ErrorCode::kConflict, "A job of this map is under way.", where);
  wire::JobView job;
  job.map = map;
  return queue(std::move(job));
}

Result<wire::JobView> BuildJobs::queue(wire::JobView job) {
  const std::scoped_lock lock(mutex_);
  return queue_locked(std::move(job));
}

Result<wire::JobView> BuildJobs::queue_locked(wire::JobView job) {
  if (queue_.size() >= kMostQueued) {
    return fail(ErrorCode::kOverloaded, "Too many jobs are waiting already.", "maps/" + job.map.str());
  }
  job.state = wire::JobState::kQueued;
  job.share = 0.0;
  if (job.id.empty()) {
    job.created_us = clock_.wall_us();
    auto added = store_.add_job(job);
    if (!added) return added;
    job = std::move(*added);
  } else if (const Status status = store_.update_job(job); !status) {
    return pass_on(status);
  }
  queue_.push_back(job);
  events_.publish(job);
  ready_.notify_one();
  return job;
}

bool BuildJobs::building(const MapId& map) {
  const std::scoped_lock lock(mutex_);
  const auto of_map = [&](const wire::JobView& job) { return job.map == map; };
  return (running_ && of_map(*running_)) || std::any_of(queue_.begin(), queue_.end(), of_map);
}

Result<wire::JobView> BuildJobs::get(const JobId& id) {
  {
    const std::scoped_lock lock(mutex_);
    if (running_ && running_->id == id) return *running_;
  }
  return store_.job(id);
}

Result<wire::JobView> BuildJobs::cancel(const JobId& id) {
  const auto known = store_.job(id);
  if (!known) return known;
  std::optional<wire::JobView> waiting;
  {
    const std::scoped_lock lock(mutex_);
    if (running_ && running_->id == id) {
      cancelled_ = true;
      stop_running_.request_stop();
      return *running_;
    }
    const auto found = std::find_if(queue_.begin(), queue_.end(), [&](const auto& job) { return job.id == id; });
    if (found != queue_.end()) {
      waiting = *found;
      queue_.erase(found);
      idle_.notify_all();
    } else if (auto now = store_.job(id); now && now->state == wire::JobState::kOffered) {
      // At once, so that nobody can take it in between.
      now->state = wire::JobState::kCancelled;
      forget_drives_of(*now);
      if (const Status status = store_.update_job(*now); !status) return pass_on(status);
      waiting = *now;
    }
  }
  if (!waiting) {
    return fail(ErrorCode::kConflict, "The job has ended: " + std::string(wire::job_state_name(known->state)) + ".",
                "jobs/" + id.str());
  }
  finish(*waiting, fail(ErrorCode::kCancelled, "The job was cancelled.", "jobs/" + id.str()));
  return *waiting;
}

void BuildJobs::work(const std::stop_token& stop) {
  while (true) {
    wire::JobView job;
    std::stop_token stop_build;
    {
      std::unique_lock lock(mutex_);
      if (!ready_.wait(lock, stop, [&] { return !queue_.empty(); })) return;
      if (stop.stop_requested()) return;
      job = queue_.front();
      queue_.pop_front();
      job.state = wire::JobState::kRunning;
      running_ = job;
      at_work_ = true;
      cancelled_ = false;
      stop_running_ = std::stop_source();
      stop_build = stop_running_.get_token();
    }
    run(job, stop_build);
    {
      const std::scoped_lock lock(mutex_);
      at_work_ = false;
    }
    idle_.notify_all();
    if (stop.stop_requested()) return;
  }
}

void BuildJobs::work_off() {
  std::unique_lock lock(mutex_);
  idle_.wait(lock, [&] { return queue_.empty() && !at_work_; });
}

void BuildJobs::run(wire::JobView job, const std::stop_token& stop) {
  tell(job);
  Result<wire::JobState> result = fail(ErrorCode::kInternal, "The job did not run.", "jobs/" + job.id.str());
  try {
    switch (job.kind) {
      case wire::JobKind::kBuild:
        result = build(job, stop);
        break;
      case wire::JobKind::kCheck:
        result = check(job, stop);
        break;
      case wire::JobKind::kAdd:
      case wire::JobKind::kRefine:
        result = learn(job, stop);
        break;
    }
  } catch (const std::exception& exception) {
    result = fail(ErrorCode::kInternal, std::string("The job failed: ") + exception.what(), "jobs/" + job.id.str());
  }
  bool by_person = false;
  {
    const std::scoped_lock lock(mutex_);
    by_person = cancelled_;
    running_.reset();
  }
  // The server ends: the job stays as it is in the store and is taken up at the next start.
  if (!result && result.error().code == ErrorCode::kCancelled && !by_person) return;
  finish(job, result);
}

Result<wire::JobState> BuildJobs::build(wire::JobView& job, const std::stop_token& stop) {
  const auto record = store_.map(job.map);
  if (!record) return pass_on(record);
  if (record->path) return teach(job, *record, stop);
  const auto tours = open_tours(store_, record->tours);
  if (!tours) return pass_on(tours);
  const auto previous = maps_.to_build_on(job.map);
  if (!previous) return pass_on(previous);
  pipeline::BuildOptions options;
  options.name = record->name;
  options.threads = threads_;
  auto built = pipeline::build_noted_map(tours->views(), tours->camera, options,
                                         *previous ? &(*previous)->map : nullptr, progress_of(job), stop);
  if (!built) return pass_on(built);
  std::vector<wire::Reason> notes = notes_of(built->notes);
  job.skipped = static_cast<std::int64_t>(built->notes.skipped.size());
  for (const wire::Reason& note : notes) spdlog::warn("job {}: {}", job.id.str(), wire::english(note));
  job.stage = "thumbnails";
  job.share = kBuildShare;
  tell(job);
  db::Thumbnails thumbnails;
  if (const Status made = add_thumbnails(built->map, *tours, stop, thumbnails); !made) return pass_on(made);
  job.stage = "report";
  tell(job);
  const auto revision = store_.map(job.map);
  if (revision) built->map.revision = revision->revision + 1;
  auto beside = build_record(*built, *tours, options, clock_.wall_us(), stop);
  if (!beside) return pass_on(beside);
  const auto kept = maps_.keep_build(job.map, std::move(built->map), thumbnails, std::move(*beside));
  if (!kept) return pass_on(kept);
  job.notes = std::move(notes);  // they are about a map that is there
  // With the edits that people made while it was built.
  if (const auto now = maps_.load(job.map)) {
    tell_lost_edits(job, *previous ? (*previous)->map.edits : std::vector<map::Edit>(), (*now)->map.edits);
  }
  spdlog::info("job {}: map {} has {} places from {} pictures", job.id.str(), job.map.str(), kept->places,
               kept->images);
  return wire::JobState::kDone;
}

void BuildJobs::tell_lost_edits(wire::JobView& job, const std::vector<map::Edit>& before,
                                const std::vector<map::Edit>& after) {
  for (wire::Reason& note : notes_of_lost_edits(before, after)) {
    spdlog::warn("job {}: {}", job.id.str(), wire::english(note));
    job.notes.push_back(std::move(note));
  }
}

pipeline::ProgressSink BuildJobs::progress_of(wire::JobView& job) {
  return [this, &job, reported_at = clock_.steady() - kTellEvery](const pipeline::BuildProgress& now) mutable {
    const auto time = clock_.steady();
    const bool next_stage = now.stage != job.stage;
    if (!next_stage && time - reported_at < kTellEvery) return;
    reported_at = time;
    job.stage = now.stage;
    job.share = kBuildShare * std::clamp(now.share, 0.0, 1.0);
    tell(job);
  };
}

void BuildJobs::finish(wire::JobView& job, const Result<wire::JobState>& result) {
  if (result) {
    job.state = *result;
    job.share = 1.0;
    spdlog::info("job {} {}", job.id.str(), wire::job_state_name(job.state));
  } else {
    const bool cancelled = result.error().code == ErrorCode::kCancelled;
    job.state = cancelled ? wire::JobState::kCancelled : wire::JobState::kFailed;
    job.error = result.error();
    spdlog::warn("job {} {}: {}", job.id.str(), wire::job_state_name(job.state), result.error().message);
    const auto record = store_.map(job.map);
    if (record && record->revision == 0) {
      if (store_.set_map_state(job.map, wire::MapState::kFailed)) {
        if (const auto after = store_.map(job.map)) maps_.tell(*after);
      }
    }
  }
  const bool from_drives = learns_from_drives(job);
  const bool forgotten = !from_drives || job.state == wire::JobState::kOffered || forget_drives_of(job);
  tell(job);
  if (from_drives && forgotten) look_for_drives(job.map);  // others may have come meanwhile
}

void BuildJobs::tell(const wire::JobView& job) {
  {
    const std::scoped_lock lock(mutex_);
    if (running_ && running_->id == job.id) running_ = job;
  }
  if (const Status status = store_.update_job(job); !status) {
    spdlog::error("job {} cannot be kept: {}", job.id.str(), status.error().message);
  }
  events_.publish(job);
}

}  // namespace homeward::server
