// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <memory>
#include <set>
#include <unordered_map>
#include <utility>

#include "map/lookup.hpp"
#include "mapping/edit_log.hpp"
#include "mapping/shortcut_edges.hpp"

namespace homeward::mapping {
namespace {

using map::AppearanceList;
using map::Edit;
using map::Place;
using map::TopologicalMap;

/// Puts what a map gained, in the terms of its unedited state, into that and into the log.
class Gains {
 public:
  Gains(const TopologicalMap& before, TopologicalMap& after) : before_(before), after_(after), base_(*before.unedited) {
    for (const Place& place : base_.places) {
      for (const ImageId& image : place.members) base_of_.emplace(image, place.id);
    }
    for (const Place& place : before.places) {
      for (const ImageId& image : place.members) known_.insert(image);
    }
  }

  TopologicalMap put() {
    for (const Place& place : after_.places) {
      if (const Place* old = map::find_place(before_, place.id)) {
        put_images(place);
        put_label(*old, place);
        put_appearances(*old, place);
      } else {
        base_.places.push_back(place);
      }
    }
    put_renewed_appearances();
    put_destinations();
    put_edges();
    put_hypotheses();
    put_shortcuts();
    return std::move(base_);
  }

 private:
  /// The standing edit that made a place; null where tours did.
  Edit* maker_of(const PlaceId& place) {
    if (map::find_place(base_, place) != nullptr) return nullptr;
    const auto found = std::ranges::find_if(after_.edits, [&](const Edit& edit) {
      const bool parts = edit.kind == map::EditKind::kSplit || edit.kind == map::EditKind::kDecide;
      return parts && !edit.undone && edit.lost.empty() && edit.found.made == place.str();
    });
    return found == after_.edits.end() ? nullptr : &*found;
  }

  /// The unedited place that a place of the map was made of.
  PlaceId base_place(const PlaceId& id) {
    const Place* place = map::find_place(before_, id);
    if (place == nullptr) return id;  // new in both
    const auto found = base_of_.find(place->prototype);
    return found == base_of_.end() ? PlaceId() : found->second;
  }

  void put_images(const Place& place) {
    for (const ImageId& image : place.members) {
      if (known_.contains(image)) continue;
      Place* base = map::find_place(base_, base_place(place.id));
      if (base == nullptr) continue;
      base->members.push_back(image);
      // It goes where the prototype goes.
      for (Edit& edit : after_.edits) {
        const bool carries = edit.kind == map::EditKind::kSplit || edit.kind == map::EditKind::kMove ||
                             edit.kind == map::EditKind::kDecide;
        if (!carries || edit.undone || !edit.lost.empty()) continue;
        if (std::ranges::find(edit.images, place.prototype) != edit.images.end()) edit.images.push_back(image);
      }
    }
  }

  void put_label(const Place& old, const Place& place) {
    Place* base = map::find_place(base_, base_place(place.id));
    const bool same_place = base != nullptr && base->id == place.id;
    if (same_place && place.label != old.label && base->label == old.label) base->label = place.label;
  }

  void put_appearances(const Place& old, const Place& place) {
    const auto& was = old.appearances.entries();
    const auto& is = place.appearances.entries();
    for (std::size_t i = 0; i < is.size(); ++i) {
      if (i < was.size()) {
        renewed_.insert_or_assign(was[i].appearance.get(), is[i]);
      } else if (Edit* maker = maker_of(place.id)) {
        maker->found.learnt.push_back(is[i]);
      } else if (Place* base = map::find_place(base_, base_place(place.id))) {
        base->appearances.push_back(is[i]);
      }
    }
  }

  void renew(AppearanceList& list) {
    for (std::size_t i = 0; i < list.size(); ++i) {
      const auto found = renewed_.find(list.entries()[i].appearance.get());
      if (found != renewed_.end()) list.replace(i, found->second);
    }
  }

  void put_renewed_appearances() {
    for (Place& place : base_.places) renew(place.appearances);
    for (Edit& edit : after_.edits) {
      renew(edit.found.appearances);
      renew(edit.found.learnt);
    }
  }

  void put_destinations() {
    for (const map::Destination& destination : after_.destinations) {
      const auto same = std::ranges::find(base_.destinations, destination.id, &map::Destination::id);
      if (same != base_.destinations.end()) {
        if (same->image == destination.image) same->appearance = destination.appearance;
      } else if (map::find_destination(before_, destination.id) == nullptr) {
        base_.destinations.push_back(destination);
        base_.destinations.back().place = base_place(destination.place);
      }
      for (Edit& edit : after_.edits) {
        for (std::size_t i = 0; i < edit.found.appearances.size(); ++i) {
          if (edit.found.appearances.entries()[i].image != destination.image) continue;
          edit.found.appearances.replace(i, destination.appearance, destination.image);
        }
      }
    }
  }

  /// Whether a place of the map and the unedited one that it was made of are known by the same picture.
  bool same_prototype(const PlaceId& id, const PlaceId& base) const {
    const Place* place = map::find_place(after_, id);
    const Place* made_of = map::find_place(base_, base);
    return place != nullptr && made_of != nullptr && place->prototype == made_of->prototype;
  }

  void put_edges() {
    for (const map::Edge& edge : after_.edges) {
      if (edge.shortcut || map::find_edge(before_, edge.from, edge.to) != nullptr) continue;
      map::Edge gained = edge;
      gained.from = base_place(edge.from);
      gained.to = base_place(edge.to);
      const bool known = map::find_edge(base_, gained.from, gained.to) != nullptr;
      if (known || gained.from == gained.to || gained.from.empty() || gained.to.empty()) continue;
      if (!same_prototype(edge.from, gained.from) || !same_prototype(edge.to, gained.to)) {
        // It was seen from a prototype that the place has by an edit alone.
        gained.bearing_rad.reset();
        gained.turn_rad.reset();
        gained.confidence = 0.0;
        gained.inliers = 0;
        gained.weak = true;
      }
      base_.edges.push_back(std::move(gained));
    }
  }

  void put_hypotheses() {
    for (const map::Hypothesis& hypothesis : after_.hypotheses) {
      const bool known = std::ranges::any_of(before_.hypotheses, [&](const map::Hypothesis& one) {
        return one.prototype_a == hypothesis.prototype_a && one.prototype_b == hypothesis.prototype_b;
      });
      if (!known) base_.hypotheses.push_back(hypothesis);
    }
  }

  void put_shortcuts() {
    TopologicalMap before = before_;
    for (const map::Shortcut& shortcut : after_.shortcuts) {
      if (find_shortcut(before, shortcut.image_a, shortcut.image_b) == nullptr) base_.shortcuts.push_back(shortcut);
    }
    std::erase_if(base_.shortcuts, [&](const map::Shortcut& one) {
      return find_shortcut(before, one.image_a, one.image_b) != nullptr &&
             find_shortcut(after_, one.image_a, one.image_b) == nullptr;
    });
  }

  const TopologicalMap& before_;
  TopologicalMap& after_;
  TopologicalMap base_;
  std::unordered_map<ImageId, PlaceId> base_of_;
  std::set<ImageId> known_;
  std::unordered_map<const features::Appearance*, AppearanceList::Entry> renewed_;
};

}  // namespace

void carry_over(const TopologicalMap& before, TopologicalMap& after) {
  if (!before.unedited) return;
  auto base = std::make_shared<const TopologicalMap>(Gains(before, after).put());
  after.unedited = std::move(base);
  after.settled_edits = before.settled_edits;
  replay_on_unedited(after);
}

}  // namespace homeward::mapping
