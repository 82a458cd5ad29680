// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <optional>

#include "core/index.hpp"
#include "map/lookup.hpp"
#include "pipeline/report/drawings.hpp"
#include "pipeline/report/html.hpp"
#include "pipeline/report/sections.hpp"

namespace homeward::pipeline {
namespace {

constexpr std::size_t kMostRows = 300;  // of hypotheses without a picture

/// What the way driven said, where the builder told.
std::optional<mapping::TrackVerdict> way_of(const BuiltMap& built, int index) {
  const auto& way = built.notes.mapping.way;
  if (at(index) >= way.size()) return std::nullopt;
  return way[at(index)];
}

std::string way_text(const std::optional<mapping::TrackVerdict>& way) {
  if (!way) return "not told";
  if (*way == mapping::TrackVerdict::kAgrees) return "agrees";
  return *way == mapping::TrackVerdict::kContradicts ? "contradicts" : "cannot tell";
}

/// What keeps a hypothesis open that has support enough.
std::string obstacle(const BuiltMap& built, int index) {
  const mapping::MappingNotes& notes = built.notes.mapping;
  if (at(index) < notes.meets.size() && notes.meets[at(index)] == 0) {
    return "their pictures share too few features to have been taken at one spot";
  }
  if (at(index) < notes.reliability.size() &&
      notes.reliability[at(index)] < notes.config.hypotheses.least_reliability) {
    return "looks were wrong too often on this tour to be trusted";
  }
  return "one place of both would join places that are kept apart";
}

/// Why it was decided so, in a sentence.
std::string reason(const BuiltMap& built, const ReportFacts& facts, int index) {
  const map::Hypothesis& h = built.map.hypotheses[at(index)];
  const mapping::HypothesisConfig& config = built.notes.mapping.config.hypotheses;
  if (h.by != map::Decider::kMethod) return "A person decided this.";
  const auto way = way_of(built, index);
  const std::vector<char>& taken_back = built.notes.mapping.taken_back;
  if (at(index) < taken_back.size() && taken_back[at(index)] != 0) {
    return "It was accepted at first. The other loops that were closed lead elsewhere: taken back, two places.";
  }
  if (h.decision == map::Decision::kRejected && way == mapping::TrackVerdict::kContradicts) {
    return "They look alike, but the way driven between them leads elsewhere: two places.";
  }
  std::string text;
  switch (h.decision) {
    case map::Decision::kAccepted:
      text = "Support " + number(h.support, 2) + " is above " + number(config.accept_support, 2) + ": one place.";
      break;
    case map::Decision::kRejected:
      text = "Plausibility " + number(h.plausibility, 2) + " is below " + number(config.reject_plausibility, 2) +
             ": two places.";
      break;
    case map::Decision::kUndecided:
      text = h.support > config.accept_support
                 ? "Support " + number(h.support, 2) + " would do, but " + obstacle(built, index) + "."
                 : "Support " + number(h.support, 2) + " is not above " + number(config.accept_support, 2) +
                       " and plausibility " + number(h.plausibility, 2) + " not below " +
                       number(config.reject_plausibility, 2) +
                       (facts.joined[at(index)] != 0 ? ". Other loops make it one place all the same."
                                                     : ": kept apart until somebody knows better.");
      break;
  }
  if (way == mapping::TrackVerdict::kAgrees) text += " The way driven agrees.";
  if (way == mapping::TrackVerdict::kUnknown) text += " The way driven cannot tell.";
  return text;
}

std::string ends_text(const map::TopologicalMap& map, const ReportFacts& facts,
                      const std::unordered_map<ImageId, int>& images, const map::Hypothesis& h) {
  const auto side = [&](const ImageId& id) {
    const auto image = images.find(id);
    const int place = image == images.end() ? -1 : facts.place_of[at(image->second)];
    return picture_name(id) + (place < 0 ? "" : " in " + place_name(map.places[at(place)]));
  };
  return side(h.prototype_a) + " and " + side(h.prototype_b);
}

std::string badge(map::Decision decision) {
  const std::string name = decision_name(decision);
  return "<span class=\"badge " + name + "\">" + name + "</span>";
}

std::string masses_row(const char* name, const map::Masses& masses) {
  return "<tr><th scope=\"row\">" + std::string(name) + "</th><td class=\"bar\">" + draw_masses(masses, name) +
         "</td><td class=\"n\">" + number(masses.is_true, 2) + "</td><td class=\"n\">" + number(masses.unknown, 2) +
         "</td><td class=\"n\">" + number(masses.is_false, 2) + "</td></tr>";
}

std::string card(const BuiltMap& built, const ReportFacts& facts, int index, const std::string& ends,
                 const HypothesisPicture& picture) {
  const map::Hypothesis& h = built.map.hypotheses[at(index)];
  const std::string agreement = picture.agree > 0 ? std::to_string(picture.agree) + " of " +
                                                        counted(at(picture.matches), "match", "matches") +
                                                        " agree with one motion between the two"
                                                  : "no motion between the two explains enough matches";
  return "<article class=\"loop\">\n<h4>" + badge(h.decision) + " " + ends + "</h4>\n<img src=\"" + picture.uri +
         "\" alt=\"Two pictures, one above the other: " + ends + "; " + agreement + "\"/>\n" +
         "<table><tr><th scope=\"col\">masses</th><td></td><th scope=\"col\" class=\"n\">for</th>"
         "<th scope=\"col\" class=\"n\">unknown</th><th scope=\"col\" class=\"n\">against</th></tr>" +
         masses_row("before", h.masses_before) + masses_row("after", h.masses_after) + "</table>\n<p>" +
         reason(built, facts, index) + "</p>\n<p class=\"soft\">Similarity " + number(h.similarity, 2) + " · support " +
         number(h.support, 2) + " · plausibility " + number(h.plausibility, 2) +
         " · way driven: " + way_text(way_of(built, index)) + " · decided by " +
         (h.by == map::Decider::kMethod ? "the method" : "a person") + " · " + agreement + ".</p>\n</article>\n";
}

std::string row(const BuiltMap& built, int index, const std::string& ends) {
  const map::Hypothesis& h = built.map.hypotheses[at(index)];
  const auto masses = [](const map::Masses& m) {
    return number(m.is_true, 2) + " / " + number(m.unknown, 2) + " / " + number(m.is_false, 2);
  };
  return "<tr><td>" + badge(h.decision) + "</td><td class=\"name\">" + ends + "</td><td class=\"n\">" +
         masses(h.masses_before) + "</td><td class=\"n\">" + masses(h.masses_after) + "</td><td class=\"n\">" +
         number(h.support, 2) + "</td><td class=\"n\">" + number(h.plausibility, 2) + "</td><td>" +
         way_text(way_of(built, index)) + "</td><td>" + (h.by == map::Decider::kMethod ? "method" : "person") +
         "</td></tr>\n";
}

}  // namespace

const char* decision_name(map::Decision decision) {
  if (decision == map::Decision::kAccepted) return "accepted";
  return decision == map::Decision::kRejected ? "rejected" : "undecided";
}

std::string loops_section(const BuiltMap& built, const ReportFacts& facts,
                          const std::unordered_map<int, HypothesisPicture>& pictures) {
  const map::TopologicalMap& map = built.map;
  std::string html = "<section id=\"loops\">\n<h2>Loops</h2>\n";
  if (map.hypotheses.empty()) {
    return html +
           "<p>No two stretches of the tour looked like one place: nothing had to be decided. A tour that passes its "
           "junctions more than once gives a map with loops, and shorter ways.</p>\n</section>\n";
  }
  html +=
      "<p>Each of these asks: was the robot here before? The two views stand above each other, turned so that the same "
      "direction of the world is under itself. Lines join what agrees, green between features and violet between "
      "upright edges, at most " +
      std::to_string(kMostLines) +
      " of them. The masses tell how much speaks for one place, how much against, and how much nobody knows, before "
      "and "
      "after the evidence of the hypotheses nearby.</p>\n";
  const auto images = map::image_indices(map);
  const auto ends = [&](int index) { return ends_text(map, facts, images, map.hypotheses[at(index)]); };
  if (pictures.size() < map.hypotheses.size()) {
    html += "<p>The map has " + counted(map.hypotheses.size(), "hypothesis", "hypotheses") + "; the " +
            std::to_string(pictures.size()) + " least certain ones are shown in pictures, the others in a table.</p>\n";
  }
  for (const auto& [decision, title] :
       {std::pair(map::Decision::kUndecided, "Undecided"), std::pair(map::Decision::kAccepted, "Accepted: one place"),
        std::pair(map::Decision::kRejected, "Rejected: two places")}) {
    std::string cards;
    for (const int index : facts.uncertain_first) {
      const auto picture = pictures.find(index);
      if (picture == pictures.end() || map.hypotheses[at(index)].decision != decision) continue;
      cards += card(built, facts, index, ends(index), picture->second);
    }
    if (!cards.empty()) html += "<h3>" + std::string(title) + "</h3>\n<div class=\"loops\">\n" + cards + "</div>\n";
  }
  std::string rows;
  std::size_t count = 0;
  for (const int index : facts.uncertain_first) {
    if (pictures.contains(index) || ++count > kMostRows) continue;
    rows += row(built, index, ends(index));
  }
  if (!rows.empty()) {
    html +=
        "<h3>More certain ones</h3>\n<div class=\"scroll\"><table>\n<tr><th scope=\"col\">Decision</th>"
        "<th scope=\"col\">Pictures</th><th scope=\"col\" class=\"n\">Before: for / unknown / against</th>"
        "<th scope=\"col\" class=\"n\">After</th><th scope=\"col\" class=\"n\">Support</th>"
        "<th scope=\"col\" class=\"n\">Plausibility</th><th scope=\"col\">Way driven</th>"
        "<th scope=\"col\">By</th></tr>\n" +
        rows + "</table></div>\n";
  }
  if (count > kMostRows) {
    html += "<p class=\"soft\">" + std::to_string(count - kMostRows) +
            " more, all of them more certain, are in the map file (<code>homeward map inspect --json</code>).</p>\n";
  }
  return html + "</section>\n";
}

}  // namespace homeward::pipeline
