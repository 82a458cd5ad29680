// SPDX-License-Identifier: Apache-2.0
#include "server/routes/job_routes.hpp"

#include "server/routes/operation_roles.hpp"
#include "wire/job_json.hpp"

namespace homeward::server {
namespace {

Response job_response(int status, const Result<wire::JobView>& job) {
  return job ? json_response(status, wire::job_to_json(*job)) : problem_of(job);
}

}  // namespace

void add_job_routes(Router& router, BuildJobs& jobs) {
  BuildJobs* j = &jobs;
  router.add({operation("get_job"),
              [j](Request& request) { return job_response(200, j->get(JobId(request.parameter("job")))); }});
  router.add({operation("take_job"),
              [j](Request& request) { return job_response(202, j->take(JobId(request.parameter("job")))); }});
  router.add({operation("cancel_job"),
              [j](Request& request) { return job_response(202, j->cancel(JobId(request.parameter("job")))); }});
}

}  // namespace homeward::server
