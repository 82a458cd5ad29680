// SPDX-License-Identifier: Apache-2.0
#include "wire/job_json.hpp"

#include "wire/json_write.hpp"
#include "wire/problem_json.hpp"
#include "wire/reason_json.hpp"

namespace homeward::wire {
namespace {

constexpr EnumNames<JobState, 6> kJobStates({"queued", "running", "offered", "done", "failed", "cancelled"});

}  // namespace

std::string_view job_state_name(JobState state) { return kJobStates.name(state); }

std::optional<JobState> job_state(std::string_view name) { return kJobStates.find(name); }

nlohmann::json job_to_json(const JobView& job) {
  nlohmann::json value = {{"id", job.id.str()},
                          {"kind", kJobKindNames.name(job.kind)},
                          {"map", job.map.str()},
                          {"state", job_state_name(job.state)},
                          {"progress", {{"stage", job.stage}, {"share", finite_or_null(job.share)}}},
                          {"error", nullptr},
                          {"skipped", job.skipped},
                          {"gained", job.gained},
                          {"notes", reasons_to_json(job.notes)},
                          {"created_us", job.created_us}};
  if (job.error) value["error"] = problem_to_json(*job.error);
  return value;
}

}  // namespace homeward::wire
