// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/enum_names.hpp"
#include "core/ids.hpp"
#include "core/result.hpp"
#include "core/time.hpp"
#include "wire/draft_json.hpp"
#include "wire/reason.hpp"

namespace homeward::wire {

/// The last three are final; an offer waits for a person to take or discard it.
enum class JobState { kQueued, kRunning, kOffered, kDone, kFailed, kCancelled };

/// "queued", "running", "offered", "done", "failed", "cancelled".
std::string_view job_state_name(JobState state);
std::optional<JobState> job_state(std::string_view name);

/// What a job does with a map: build it from its tours, add tours to it, give its places new appearances, or try a
/// draft of it on its tours.
enum class JobKind { kBuild, kAdd, kRefine, kCheck };

inline constexpr EnumNames<JobKind, 4> kJobKindNames({"build", "add", "refine", "check"});

/// Work that the server does in the background (proto/schemas/job.schema.json).
struct JobView {
  JobId id;
  JobKind kind = JobKind::kBuild;
  MapId map;
  JobState state = JobState::kQueued;
  std::string stage;   // what it is doing, for people
  double share = 0.0;  // of the whole work done, in [0,1]
  std::optional<Error> error;
  TimeUs created_us = 0;
  std::int64_t skipped = 0;   // pictures that cannot be read and that the map does without
  std::vector<Reason> notes;  // what a person should know of a job that is done or offered
  std::int64_t gained = 0;    // new appearances that places gained, or would gain
  // What the server remembers and nobody is told:
  bool taken = false;                  // what it offers is wanted
  std::vector<TourId> tours = {};      // that it adds or refines by
  std::vector<MissionId> drives = {};  // that its offer comes from
  DraftId draft = {};                  // that it tries
};

nlohmann::json job_to_json(const JobView& job);

}  // namespace homeward::wire
