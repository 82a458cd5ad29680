// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "server/auth/authenticator.hpp"
#include "server/front/compressed_answers.hpp"
#include "server/front/idempotency.hpp"
#include "server/http/access.hpp"
#include "server/http/front.hpp"
#include "server/http/metrics.hpp"
#include "server/http/router.hpp"
#include "server/http/static_files.hpp"
#include "server/time/clock.hpp"
#include "server/work/password_queue.hpp"
#include "server/work/work_pool.hpp"

namespace homeward::server {

/// What the front needs of the application.
struct FrontParts {
  const Router& router;
  const AccessPolicy& access;
  const StaticFiles& files;
  Authenticator& authenticator;
  Idempotency& idempotency;
  Metrics& metrics;
  WorkPool& workers;
  WorkPool& heavy;
  WorkPool& slow;
  WorkPool& bulk;
  PasswordQueue& passwords;
  const Clock& clock;
};

/// Checks who asks, from where and for what, and hands the request to its handler in the right lane.
class AppFront : public Front {
 public:
  explicit AppFront(FrontParts parts) : parts_(std::move(parts)) {}

  std::variant<std::size_t, Response> admit(Request& request) override;
  void answer(std::shared_ptr<Request> request, Reply reply) override;
  void upgrade(std::shared_ptr<Request> request, std::function<void(Upgrade)> reply) override;
  [[nodiscard]] bool still_welcome(const Request& handshake) const override;

 private:
  Response checked(Request& request, const Route& route, const std::optional<Caller>& caller);
  [[nodiscard]] bool queue(Lane lane, const std::string& address, WorkPool::Task task);
  static std::optional<Response> refusal(const Request& request, const AllowedRoles& roles,
                                         const std::optional<Caller>& caller);

  FrontParts parts_;
  CompressedAnswers compressed_;
};

}  // namespace homeward::server
