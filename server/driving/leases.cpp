// SPDX-License-Identifier: Apache-2.0
#include "db/secrets.hpp"
#include "server/driving/driving.hpp"
#include "wire/lease_durations.hpp"

namespace homeward::server {
namespace {

constexpr std::chrono::milliseconds kLeaseFor{wire::kLease_ms};

Error held_by(const RobotUnit& unit) {
  return {ErrorCode::kLeaseHeld, unit.lease->holder + " is driving.", "robots/" + unit.id.str() + "/lease"};
}

Error not_yours(const RobotUnit& unit) {
  return {ErrorCode::kLeaseHeld, "This lease is over, or somebody else has taken it.",
          "robots/" + unit.id.str() + "/lease"};
}

}  // namespace

bool Driving::lease_lives(const RobotUnit& unit, SteadyTime now) const {
  return unit.lease.has_value() && now < unit.lease->expires;
}

Result<wire::LeaseView> Driving::take_lease(const RobotId& id, const Caller& caller, bool take_over) {
  const auto found = find(id);
  if (!found) return pass_on(found);
  RobotUnit& unit = **found;
  const auto refused_or_extended = [&](SteadyTime now) -> std::optional<Result<wire::LeaseView>> {
    if (!lease_lives(unit, now)) return std::nullopt;
    if (unit.lease->caller == caller.id) {  // the same person again, after a reload of the page
      unit.lease->expires = now + kLeaseFor;
      return Result<wire::LeaseView>(lease_view(unit, now));
    }
    if (!take_over) return Result<wire::LeaseView>(tl::unexpected<Error>(held_by(unit)));
    return std::nullopt;
  };
  {
    const std::scoped_lock lock(unit.mutex);
    if (const auto early = refused_or_extended(clock_.steady())) return *early;
  }
  // A hand-over begins a new epoch, which must be on disk before anybody hears of it.
  const auto epoch = store_.next_epoch(id);
  if (!epoch) return pass_on(epoch);
  const std::scoped_lock lock(unit.mutex);
  const auto now = clock_.steady();
  if (const auto late = refused_or_extended(now)) return *late;
  if (unit.under_way) stop_robot(unit, "", {wire::ReasonCode::kTakenOverBy, {{"by", caller.name}}}, caller.name);
  if (*epoch > unit.epoch) {
    unit.epoch = *epoch;
    unit.seq = 0;
  }
  unit.lease = Lease{db::random_secret(), caller.name, caller.id, now + kLeaseFor};
  tell(unit);
  return lease_view(unit, now);
}

Result<wire::LeaseView> Driving::keep_lease(const RobotId& id, const std::string& lease_id) {
  const auto found = find(id);
  if (!found) return pass_on(found);
  RobotUnit& unit = **found;
  const std::scoped_lock lock(unit.mutex);
  const auto now = clock_.steady();
  if (!lease_lives(unit, now) || unit.lease->id != lease_id) return tl::unexpected<Error>(not_yours(unit));
  unit.lease->expires = now + kLeaseFor;
  return lease_view(unit, now);
}

Status Driving::release_lease(const RobotId& id, const std::string& lease_id) {
  const auto found = find(id);
  if (!found) return pass_on(found);
  RobotUnit& unit = **found;
  const std::scoped_lock lock(unit.mutex);
  if (!lease_lives(unit, clock_.steady()) || unit.lease->id != lease_id) {
    return tl::unexpected<Error>(not_yours(unit));
  }
  if (unit.under_way) stop_robot(unit, "", {wire::ReasonCode::kDriverGaveBack}, unit.lease->holder);
  unit.lease.reset();
  tell(unit);
  return {};
}

}  // namespace homeward::server
