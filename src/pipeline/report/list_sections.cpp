// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "core/index.hpp"
#include "core/markup.hpp"
#include "pipeline/report/drawings.hpp"
#include "pipeline/report/html.hpp"
#include "pipeline/report/sections.hpp"

namespace homeward::pipeline {
namespace {

constexpr std::size_t kMostRows = 25;

std::string image_name(const BuiltMap& built, int image) { return picture_name(built.map.images[at(image)].id); }

std::string place_of_image(const BuiltMap& built, const ReportFacts& facts, int image) {
  const int place = facts.place_of[at(image)];
  return place < 0 ? "no place" : place_name(built.map.places[at(place)]);
}

std::string cut_note(std::size_t count, const char* what) {
  if (count <= kMostRows) return {};
  return "<p class=\"soft\">" + std::to_string(count - kMostRows) + " more " + what + " are not listed.</p>\n";
}

}  // namespace

std::string length_text(double length, const ReportFacts& facts) {
  return facts.metric ? number(length, 1) + " m" : number(length, 1) + " steps";
}

std::string look_alikes_section(const BuiltMap& built, const ReportFacts& facts) {
  std::string html = "<section id=\"look-alikes\">\n<h2>Places that look alike</h2>\n";
  if (facts.look_alikes.empty()) {
    return html + "<p>No two places that are apart look as alike as pictures of one place do.</p>\n</section>\n";
  }
  html +=
      "<p>Pictures of these places are as alike as pictures of one place usually are on this tour (visual distance up "
      "to " +
      number(static_cast<double>(built.notes.mapping.place_distance), 4) +
      "), and yet they are kept apart. Where they are truly two, something that only one of them has, a poster or "
      "a plant, helps people and robots alike.</p>\n<div class=\"scroll\"><table>\n<tr><th scope=\"col\">Place</th>"
      "<th scope=\"col\">Place</th><th scope=\"col\" class=\"n\">Visual distance</th>"
      "<th scope=\"col\" class=\"n\">Apart on the map</th><th scope=\"col\">Hypothesis</th></tr>\n";
  for (std::size_t i = 0; i < std::min(kMostRows, facts.look_alikes.size()); ++i) {
    const LookAlike& pair = facts.look_alikes[i];
    const auto place = [&](int index) {
      return "<td class=\"name\">" + place_name(built.map.places[at(index)]) + "<br/><span class=\"soft\">" +
             picture_name(built.map.places[at(index)].prototype) + "</span></td>";
    };
    html += "<tr>" + place(pair.place_a) + place(pair.place_b) + "<td class=\"n\">" + number(pair.distance, 4) +
            "</td><td class=\"n\">" + (pair.hops ? counted(at(*pair.hops), "way", "ways") : "not joined") +
            "</td><td>" +
            (pair.hypothesis < 0 ? "none" : decision_name(built.map.hypotheses[at(pair.hypothesis)].decision)) +
            "</td></tr>\n";
  }
  return html + "</table></div>\n" + cut_note(facts.look_alikes.size(), "pairs") + "</section>\n";
}

std::string weak_section(const BuiltMap& built, const ReportFacts& facts) {
  std::string html = "<section id=\"weak\">\n<h2>Weak ways</h2>\n";
  const mapping::MappingNotes& notes = built.notes.mapping;
  if (!notes.extra.empty()) {
    html += "<p>" +
            counted(static_cast<std::size_t>(notes.weak_before), "pair of neighbouring places",
                    "pairs of neighbouring places") +
            " hardly saw each other; " + counted(notes.extra.size(), "picture was", "pictures were") +
            " put between them as " + (notes.extra.size() == 1 ? "a place of its own" : "places of their own") +
            ", and " + counted(static_cast<std::size_t>(notes.weak_after), "pair is", "pairs are") +
            " left without a sound way. A weak way beside a sound one is not driven as long as that is open.</p>\n";
  }
  if (facts.weak_edges == 0) {
    return html +
           "<p>On every way the two ends see each other well enough to drive from one to the other by sight.</p>\n"
           "</section>\n";
  }
  html +=
      "<p>Between these places the pictures have too little in common to be sure of the direction: a robot is likely "
      "to fail there. Drive these stretches again, slowly, with a picture every 30 cm, and with the doors as they "
      "usually stand.</p>\n";
  if (!facts.weak.empty()) {
    html +=
        "<div class=\"scroll\"><table>\n<tr><th scope=\"col\">Stretch</th><th scope=\"col\">From</th>"
        "<th scope=\"col\">To</th><th scope=\"col\" class=\"n\">Weak ways</th>"
        "<th scope=\"col\" class=\"n\">Their length</th><th scope=\"col\" class=\"n\">Least confidence</th>"
        "<th scope=\"col\">What to do</th></tr>\n";
    for (std::size_t i = 0; i < std::min(kMostRows, facts.weak.size()); ++i) {
      const WeakStretch& stretch = facts.weak[i];
      html += "<tr><td class=\"name\">" + image_name(built, stretch.first) + " to " + image_name(built, stretch.last) +
              "</td><td class=\"name\">" + place_of_image(built, facts, stretch.first) + "</td><td class=\"name\">" +
              place_of_image(built, facts, stretch.last) + "</td><td class=\"n\">" + std::to_string(stretch.edges) +
              "</td><td class=\"n\">" + length_text(stretch.length_m, facts) + "</td><td class=\"n\">" +
              number(stretch.least_confidence, 2) + "</td><td>drive this stretch again</td></tr>\n";
    }
    html += "</table></div>\n" + cut_note(facts.weak.size(), "stretches");
  }
  if (facts.weak_off_tour > 0) {
    html += "<p>" + counted(at(facts.weak_off_tour), "weak way was", "weak ways were") +
            " added by a person and never driven by a tour.</p>\n";
  }
  return html + "</section>\n";
}

std::string coverage_section(const BuiltMap& built, const ReportFacts& facts) {
  const map::TopologicalMap& map = built.map;
  std::string html = "<section id=\"coverage\">\n<h2>Coverage</h2>\n";
  if (map.places.empty()) return html + "<p>The map has no places.</p>\n</section>\n";
  const auto once = std::ranges::count(facts.visits_of, 1);
  html += "<h3>Visits</h3>\n<p>" + counted(static_cast<std::size_t>(once), "place was", "places were") +
          " passed once only, of " + std::to_string(map.places.size()) +
          ". What was seen twice is recognised better, and only a second visit closes a loop.</p>\n<figure>" +
          draw_visits(facts) + "</figure>\n";
  if (facts.parts > 1) {
    html +=
        "<h3>Parts that are not joined</h3>\n<p>No way leads from one to the other; a tour that touches both joins "
        "them.</p>\n<table>\n<tr><th scope=\"col\">Part</th><th scope=\"col\">Begins at</th>"
        "<th scope=\"col\" class=\"n\">Places</th></tr>\n";
    for (int part = 0; part < facts.parts && at(part) < kMostRows; ++part) {
      const auto first = std::ranges::find(facts.component_of, part) - facts.component_of.begin();
      html += "<tr><td>" + std::to_string(part + 1) + "</td><td class=\"name\">" +
              place_name(map.places[static_cast<std::size_t>(first)]) + "</td><td class=\"n\">" +
              std::to_string(std::ranges::count(facts.component_of, part)) + "</td></tr>\n";
    }
    html += "</table>\n" + cut_note(at(facts.parts), "parts");
  }
  if (facts.gaps.empty()) return html + "</section>\n";
  constexpr std::size_t kLongest = 5;
  html += "<h3>Longest gaps</h3>\n<p>The longest steps from one picture to the next" +
          std::string(facts.metric ? ", by odometry" : ", by how little the two have in common") +
          ".</p>\n<div class=\"scroll\"><table>\n<tr><th scope=\"col\">From</th><th scope=\"col\">To</th>"
          "<th scope=\"col\">Place</th>" +
          (facts.metric ? "<th scope=\"col\" class=\"n\">Length</th>" : "") + "<th scope=\"col\">In common</th></tr>\n";
  for (std::size_t i = 0; i < std::min(kLongest, facts.gaps.size()); ++i) {
    const Gap& gap = facts.gaps[i];
    html += "<tr><td class=\"name\">" + image_name(built, gap.before) + "</td><td class=\"name\">" +
            image_name(built, gap.before + 1) + "</td><td class=\"name\">" + place_of_image(built, facts, gap.before) +
            "</td>" + (facts.metric ? "<td class=\"n\">" + number(gap.length, 2) + " m</td>" : "") + "<td>" +
            (std::isfinite(gap.distance) ? "visual distance " + number(gap.distance, 4) : "nothing: drive it again") +
            "</td></tr>\n";
  }
  return html + "</table></div>\n</section>\n";
}

std::string skipped_section(const BuiltMap& built) {
  std::string html = "<section id=\"skipped\">\n<h2>Pictures left out</h2>\n";
  if (built.notes.skipped.empty()) return html + "<p>Every picture of the tour is in the map.</p>\n</section>\n";
  html += "<table>\n<tr><th scope=\"col\">Picture</th><th scope=\"col\">Why</th></tr>\n";
  for (std::size_t i = 0; i < std::min(kMostRows, built.notes.skipped.size()); ++i) {
    const Error& error = built.notes.skipped[i];
    html += "<tr><td class=\"name\">" + escape_html(error.where) + "</td><td>" + escape_html(error.message) +
            "</td></tr>\n";
  }
  return html + "</table>\n" + cut_note(built.notes.skipped.size(), "pictures") + "</section>\n";
}

}  // namespace homeward::pipeline
