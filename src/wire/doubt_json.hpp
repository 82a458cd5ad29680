// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/enum_names.hpp"
#include "core/ids.hpp"
#include "map/doubt.hpp"
#include "map/topological_map.hpp"

namespace homeward::wire {

/// Which doubts somebody asks for.
enum class DoubtsAbout {
  kAsked,      // all but what a person decided
  kUndecided,  // of these, what the map leaves open
  kClose,      // of these, what it has decided, and may be wrong about
  kDecided,    // what a person decided
  kAll,
};

inline constexpr EnumNames<DoubtsAbout, 5> kDoubtsAboutNames({"asked", "undecided", "close", "decided", "all"});

/// A page of doubts.
struct DoubtFilter {
  DoubtsAbout about = DoubtsAbout::kAsked;
  std::optional<map::DoubtKind> kind;
  std::optional<PlaceId> place;  // that they are about
  std::size_t offset = 0;
  std::size_t limit = 20;
};

inline constexpr std::size_t kMaxDoubts = 1000;  // on a page

/// proto/schemas/doubts.schema.json: of the doubts that the filter leaves, in their order, those on its page.
/// `id`: of the map, or the name of its file. Precondition: `doubts` are of this map.
nlohmann::json doubts_to_json(const std::vector<map::Doubt>& doubts, const map::TopologicalMap& map,
                              const std::string& id, const DoubtFilter& filter);

}  // namespace homeward::wire
