// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mutex>
#include <set>
#include <string>

#include "db/store.hpp"
#include "server/http/message.hpp"
#include "server/time/clock.hpp"

namespace homeward::server {

/// A POST that is sent again with the same Idempotency-Key by the same caller gets the answer of the first one; with
/// another body it is refused.
class Idempotency {
 public:
  Idempotency(db::Store& store, const Clock& clock) : store_(store), clock_(clock) {}

  /// Answers by what was kept, or runs `handler` and keeps its answer. Refusals that may be different the next time
  /// (busy, not allowed now) are not kept, nor are answers with a secret in them.
  Response run(Request& request, bool secret, const std::function<Response(Request&)>& handler);

 private:
  db::Store& store_;
  const Clock& clock_;
  std::mutex mutex_;
  std::set<std::string> running_;
};

}  // namespace homeward::server
