// SPDX-License-Identifier: Apache-2.0
#include <spdlog/spdlog.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "pipeline/replay_check.hpp"
#include "server/work/build_jobs.hpp"
#include "server/work/stored_drives.hpp"
#include "server/work/stored_tours.hpp"
#include "wire/replay_check_json.hpp"

namespace homeward::server {

Result<wire::JobView> BuildJobs::check_draft(const MapId& map, const wire::DraftId& draft) {
  const auto record = store_.draft(map, draft);
  if (!record) return pass_on(record);
  const auto of_map = store_.map(map);
  if (!of_map) return pass_on(of_map);
  const std::string where = "drafts/" + draft.str();
  if (of_map->tours.empty()) {
    return fail(ErrorCode::kConflict, "The map was imported; its pictures are not here to be tried.", where);
  }
  const std::scoped_lock lock(mutex_);
  const auto same = [&](const wire::JobView& job) { return job.draft == draft; };
  if ((running_ && same(*running_)) || std::ranges::any_of(queue_, same)) {
    return fail(ErrorCode::kConflict, "This draft is being checked already.", where);
  }
  wire::JobView asked;
  asked.kind = wire::JobKind::kCheck;
  asked.map = map;
  asked.draft = draft;
  auto job = queue_locked(std::move(asked));
  if (!job) return job;
  // Before the job can begin, which takes the same lock.
  const Status noted = store_.set_draft_check(draft, {job->id, record->version});
  if (!noted)
    spdlog::warn("the check {} of draft {} cannot be noted: {}", job->id.str(), draft.str(), noted.error().message);
  return job;
}

void BuildJobs::end_check(const wire::DraftId& draft) {
  std::optional<JobId> job;
  {
    const std::scoped_lock lock(mutex_);
    if (running_ && running_->draft == draft) job = running_->id;
    for (const wire::JobView& waiting : queue_) {
      if (waiting.draft == draft) job = waiting.id;
    }
  }
  if (job) cancel(*job);
}

Result<wire::JobState> BuildJobs::check(wire::JobView& job, const std::stop_token& stop) {
  drafts_.tell(job.map, job.draft);
  const auto draft = drafts_.state(job.map, job.draft);
  if (!draft) return pass_on(draft);
  const auto record = store_.map(job.map);
  if (!record) return pass_on(record);
  const auto tours = open_tours(store_, record->tours);
  if (!tours) return pass_on(tours);
  const map::TopologicalMap& before = draft->base->map;
  const map::TopologicalMap& after = draft->drafted->map;
  const auto missions = store_.kept_drives(job.map);
  if (!missions) return pass_on(missions);
  auto drives = drives_of(store_, *missions, before);
  if (!drives) {
    if (drives.error().code != ErrorCode::kFeatureConfigMismatch) return pass_on(drives);
    drives = std::vector<std::vector<pipeline::DriveSight>>();  // of before a rebuild
  }
  const auto checked =
      pipeline::check_by_replay(before, after, tours->views(), *drives, threads_, progress_of(job), stop);
  if (!checked) return pass_on(checked);
  nlohmann::json findings = wire::replay_check_to_json(*checked, before, after);
  findings["format"] = "homeward-replay-check";
  findings["version"] = 1;
  findings["map"] = job.map.str();
  findings["draft"] = job.draft.str();
  findings["draft_version"] = draft->record.version;
  findings["revision"] = before.revision;
  // It may have been edited between the request and now: what was tried is what counts.
  if (const Status noted = store_.set_draft_check(job.draft, {job.id, draft->record.version}); !noted) {
    return pass_on(noted);
  }
  if (const Status kept = store_.keep_draft_findings(job.draft, job.id, findings.dump()); !kept) return pass_on(kept);
  drafts_.tell(job.map, job.draft);
  return wire::JobState::kDone;
}

}  // namespace homeward::server
