// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/ids.hpp"
#include "core/result.hpp"
#include "core/time.hpp"
#include "map/topological_map.hpp"

namespace homeward::wire {

using DraftId = Id<struct DraftTag>;

/// Another draft that changes the same places.
struct DraftOverlap {
  DraftId draft;
  std::string by;
  std::string name;
  std::vector<PlaceId> places;
};

/// The latest replay check of a draft, and of which version.
struct DraftCheck {
  JobId job;
  std::int64_t version = 0;
};

/// Edits of a map that are tried before they count (proto/schemas/draft.schema.json).
struct DraftView {
  DraftId id;
  MapId map;
  std::string name;  // empty: nobody named it
  std::string by;
  TimeUs created_us = 0;
  std::int64_t version = 1;   // of the draft
  std::int64_t revision = 0;  // of the map below
  std::vector<map::Edit> edits;
  std::vector<PlaceId> touches;
  std::vector<DraftOverlap> overlaps;
  std::optional<DraftCheck> check;
};

nlohmann::json draft_to_json(const DraftView& draft);

/// A draft was discarded or published.
struct DraftGone {
  MapId map;
  DraftId draft;
};

/// The entity tag of a version, with its quotes: "d4".
std::string draft_tag(std::int64_t version);

/// The version in an If-Match header, as revision_from_tag reads revisions. Errors: kInvalidInput.
Result<std::int64_t> draft_version_from_tag(const std::string& tag);

}  // namespace homeward::wire
