// SPDX-License-Identifier: Apache-2.0
#include "server/work/job_notes.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "map/lookup.hpp"
#include "wire/edit_json.hpp"
#include "wire/map_reasons.hpp"

namespace homeward::server {
namespace {

using wire::Reason;
using wire::ReasonCode;

constexpr std::size_t kMostPlacesNamed = 20;

std::int64_t count(std::size_t number) { return static_cast<std::int64_t>(number); }

Reason name_of(const map::TopologicalMap& map, const PlaceId& id) {
  const map::Place* place = map::find_place(map, id);
  if (place != nullptr && !place->label.empty()) return {ReasonCode::kPlaceNamed, {{"label", place->label}}};
  return {ReasonCode::kPlaceNumbered, {{"place", id.str()}}};
}

struct Gain {
  std::size_t appearances = 0;
  std::size_t replaced = 0;
};

Reason note_of(Reason place, const Gain& gain, bool offered) {
  Reason note{offered ? ReasonCode::kPlaceWouldGain : ReasonCode::kPlaceGained,
              {{"place", std::vector{std::move(place)}}, {"appearances", count(gain.appearances)}}};
  if (gain.replaced == 0) return note;
  note.code = offered ? ReasonCode::kPlaceWouldGainReplacing : ReasonCode::kPlaceGainedReplacing;
  note.parameters["replaced"] = count(gain.replaced);
  return note;
}

}  // namespace

std::vector<Reason> notes_of(const pipeline::BuildNotes& build) {
  std::vector<Reason> notes;
  if (!build.skipped.empty()) {
    notes.push_back({ReasonCode::kPicturesLeftOutOf,
                     {{"left_out", count(build.skipped.size())},
                      {"all", count(build.skipped.size() + build.appearances.size())},
                      {"first", std::vector{wire::reason_at(build.skipped.front())}}}});
  }
  for (const map::TourWarning& warning : build.warnings) {
    notes.push_back(
        {ReasonCode::kWarningAt, {{"warning", std::vector{wire::reason_of(warning)}}, {"image", warning.image.str()}}});
  }
  return notes;
}

std::vector<Reason> notes_of(const map::TopologicalMap& map, const mapping::Refinement& refinement, bool offered) {
  std::map<PlaceId, Gain> gains;
  for (const mapping::GainedAppearance& one : refinement.gained) {
    Gain& gain = gains[one.place];
    ++gain.appearances;
    if (one.replaced) ++gain.replaced;
  }
  std::vector<Reason> notes;
  for (const auto& [place, gain] : gains) {
    if (notes.size() == kMostPlacesNamed) {
      notes.push_back({offered ? ReasonCode::kMorePlacesWouldGain : ReasonCode::kMorePlacesGained,
                       {{"places", count(gains.size() - kMostPlacesNamed)}}});
      break;
    }
    notes.push_back(note_of(name_of(map, place), gain, offered));
  }
  if (refinement.over_budget > 0) {
    notes.push_back({ReasonCode::kMapFull, {{"appearances", std::int64_t{refinement.over_budget}}}});
  }
  return notes;
}

std::vector<Reason> notes_of(const mapping::GrowthCounts& added) {
  return {{ReasonCode::kToursAdded,
           {{"images", std::int64_t{added.images}},
            {"joined_images", std::int64_t{added.joined_images}},
            {"joined_places", std::int64_t{added.joined_places}},
            {"places", std::int64_t{added.places}},
            {"destinations", std::int64_t{added.destinations}}}}};
}

std::vector<Reason> notes_of_lost_edits(const std::vector<map::Edit>& before, const std::vector<map::Edit>& after) {
  std::vector<Reason> notes;
  for (std::size_t i = 0; i < after.size(); ++i) {
    const map::Edit& edit = after[i];
    const bool known = i < before.size() && before[i].lost == edit.lost;
    if (edit.undone || edit.lost.empty() || known) continue;
    std::string words(wire::edit_kind_name(edit.kind));
    std::ranges::replace(words, '_', ' ');
    notes.push_back({ReasonCode::kEditLost, {{"edit", std::move(words)}, {"by", edit.by}, {"why", edit.lost}}});
  }
  return notes;
}

std::vector<Reason> notes_of_skipped(const std::vector<Error>& skipped) {
  if (skipped.empty()) return {};
  return {{ReasonCode::kPicturesLeftOut,
           {{"left_out", count(skipped.size())}, {"first", std::vector{wire::reason_at(skipped.front())}}}}};
}

}  // namespace homeward::server
