// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "db/store.hpp"
#include "linemodel/plan_outline.hpp"
#include "server/services/maps.hpp"
#include "server/time/clock.hpp"
#include "server/ws/event_hub.hpp"
#include "wire/plan_json.hpp"

namespace homeward::server {

/// A file of a plan as somebody sends it.
struct PlanUpload {
  std::string format;                     // how its name ends, in lower case: "wrl"
  std::optional<double> metres_per_unit;  // nothing: 1, or as the file itself says
  std::optional<wire::PlanUp> up;         // nothing: as is usual in its format
  double wall_height_m = 2.5;             // of a flat drawing
  std::string by;
  std::span<const std::uint8_t> file;
};

/// Drawn plans of the building, and which maps are tied to them. Thread-safe. Errors of all: those of the store.
class PlanService {
 public:
  PlanService(db::Store& store, MapService& maps, EventHub& events, const Clock& clock)
      : store_(store), maps_(maps), events_(events), clock_(clock) {}

  /// Reads the file, a wrl or svg, before it keeps it. Errors: kUnsupportedFormat, those of linemodel::read_plan;
  /// `where` names the line of the file.
  Result<wire::PlanView> add(const std::string& name, const PlanUpload& upload);
  /// The same. Errors: also kNotFound, kConflict (too many versions).
  Result<wire::PlanView> add_version(const wire::PlanId& id, const PlanUpload& upload);
  /// The version, or the newest one. Errors: kNotFound (plan or version).
  Result<wire::PlanVersionView> version(const wire::PlanId& id, const std::optional<std::int64_t>& version);
  /// All of it, read anew from what was uploaded. Errors: kNotFound, kCorruptFile.
  Result<linemodel::Plan> read(const wire::PlanId& id, const wire::PlanVersionView& version);
  /// What it looks like from above. Errors: kNotFound (plan or version).
  Result<linemodel::PlanOutline> outline(const wire::PlanId& id, const wire::PlanVersionView& version,
                                         const linemodel::HeightRange& heights);

  /// Ties a map to a plan, in place of what it was tied to, and tells dashboards. Pins of places are tied to the
  /// pictures that these are known by now. Errors: kNotFound, kUnknownPlace, kConflict (the map was not built yet),
  /// those of map::check_pins.
  Result<wire::MapPlanView> tie(const MapId& map, const wire::PlanTieRequest& request, const std::string& by);
  /// Errors: kNotFound (the map, or it is tied to none).
  Result<wire::MapPlanView> map_plan(const MapId& map);
  /// Success also where it is tied to none. Errors: kNotFound.
  Status untie(const MapId& map);

 private:
  using Lines = std::shared_ptr<const std::vector<linemodel::PlanLine>>;
  struct Kept {
    wire::PlanId plan;
    std::int64_t version = 0;
    Lines lines;
  };
  Result<Lines> lines_of(const wire::PlanId& id, const wire::PlanVersionView& version);
  Result<wire::MapPlanView> view_of(const db::MapPlanRecord& record, const LoadedMap& loaded);
  void tell(const MapId& map);

  db::Store& store_;
  MapService& maps_;
  EventHub& events_;
  const Clock& clock_;
  std::mutex mutex_;       // of kept_
  std::deque<Kept> kept_;  // what was asked for last comes last
};

}  // namespace homeward::server
