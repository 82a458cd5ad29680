// SPDX-License-Identifier: Apache-2.0
#include "pipeline/report/report_page.hpp"

#include <algorithm>
#include <variant>

#include "core/markup.hpp"
#include "pipeline/report/drawings.hpp"
#include "pipeline/report/html.hpp"
#include "pipeline/report/sections.hpp"
#include "pipeline/report/style.hpp"

namespace homeward::pipeline {
namespace {

std::string tile(const std::string& name, const std::string& value) {
  return "<div class=\"tile\"><dt>" + name + "</dt><dd>" + value + "</dd></div>\n";
}

std::size_t decided(const map::TopologicalMap& map, map::Decision decision) {
  return static_cast<std::size_t>(std::ranges::count(map.hypotheses, decision, &map::Hypothesis::decision));
}

std::string head(const map::TopologicalMap& map, const ReportOptions& options) {
  const std::string name = map.name.empty() ? "A map without a name" : escape_html(map.name);
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\" xmlns=\"http://www.w3.org/1999/xhtml\">\n<head>\n"
      "<meta charset=\"utf-8\"/>\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n<title>" +
      name + " – map report</title>\n<style>" + kReportStyle +
      "</style>\n</head>\n<body>\n<header>\n<p class=\"kicker\">Homeward map report</p>\n<h1>" + name + "</h1>\n";
  std::string about;
  if (!options.date.empty()) about += escape_html(options.date) + " · ";
  about += "revision " + std::to_string(map.revision);
  if (!map.feature_config_id.empty()) about += " · features " + escape_html(map.feature_config_id);
  if (map.build_seconds > 0.0) about += " · built in " + number(map.build_seconds, 1) + " s";
  html += "<p class=\"soft\">" + about + "</p>\n<nav aria-label=\"Sections\"><ul>";
  for (const auto& [id, title] :
       {std::pair("graph", "Graph"), std::pair("tour", "Along the tour"), std::pair("matrix", "Similarity"),
        std::pair("loops", "Loops"), std::pair("look-alikes", "Look-alikes"), std::pair("weak", "Weak ways"),
        std::pair("coverage", "Coverage"), std::pair("skipped", "Left out")}) {
    html += "<li><a href=\"#" + std::string(id) + "\">" + title + "</a></li>";
  }
  return html + "</ul></nav>\n</header>\n<main>\n";
}

std::string summary(const BuiltMap& built, const ReportFacts& facts) {
  const map::TopologicalMap& map = built.map;
  std::string html = "<section id=\"summary\" aria-label=\"Summary\">\n<dl class=\"tiles\">\n";
  html += tile("pictures", std::to_string(map.images.size()));
  html += tile("places", std::to_string(map.places.size()));
  html += tile("ways", std::to_string(facts.edges));
  html += tile("destinations", std::to_string(map.destinations.size()));
  html += tile("loops accepted", std::to_string(decided(map, map::Decision::kAccepted)));
  html += tile("loops rejected", std::to_string(decided(map, map::Decision::kRejected)));
  html += tile("loops undecided", std::to_string(decided(map, map::Decision::kUndecided)));
  html += tile("weak ways", std::to_string(facts.weak_edges));
  html += tile("parts not joined", facts.parts > 1 ? std::to_string(facts.parts) : "none");
  html += tile("pictures left out", std::to_string(built.notes.skipped.size()));
  return html + "</dl>\n";
}

/// What a person can do about it, most important first.
std::string to_do(const BuiltMap& built, const ReportFacts& facts, const std::vector<ReportWarning>& warnings) {
  std::string items;
  const auto add = [&](const std::string& html) { items += "<li>" + html + "</li>\n"; };
  if (built.map.places.empty()) add("The map has no places: build it from a tour.");
  if (facts.parts > 1) {
    add("The map falls into " + std::to_string(facts.parts) +
        " parts that no way joins: <a href=\"#coverage\">take a tour from one to the other</a>.");
  }
  if (!facts.weak.empty()) {
    add("<a href=\"#weak\">Drive again</a>: " + counted(facts.weak.size(), "stretch", "stretches") + " with " +
        counted(static_cast<std::size_t>(facts.weak_edges), "weak way", "weak ways") + ".");
  }
  if (facts.open > 0) {
    add("<a href=\"#loops\">Look at " +
        counted(static_cast<std::size_t>(facts.open), "undecided loop", "undecided loops") +
        "</a> and accept or reject them in the map editor.");
  }
  if (!built.notes.skipped.empty()) {
    add("<a href=\"#skipped\">" + counted(built.notes.skipped.size(), "picture was", "pictures were") +
        " left out</a>.");
  }
  for (const ReportWarning& warning : warnings) {
    add(escape_html(warning.words) + " <span class=\"soft\">(" + escape_html(warning.image) + ")</span>");
  }
  if (items.empty()) items = "<li class=\"good\">Nothing to do: the map is in one piece and no way is weak.</li>\n";
  return "<h2>What to do</h2>\n<ul class=\"todo\">\n" + items + "</ul>\n</section>\n";
}

std::string legend_line(const char* kind) {
  return "<svg viewBox=\"0 0 30 12\" aria-hidden=\"true\" xmlns=\"http://www.w3.org/2000/svg\"><line class=\"" +
         std::string(kind) + "\" x1=\"0\" y1=\"6\" x2=\"30\" y2=\"6\"/></svg>";
}

std::string legend_dot(const char* kind) {
  return "<svg viewBox=\"0 0 30 12\" aria-hidden=\"true\" xmlns=\"http://www.w3.org/2000/svg\"><circle class=\"" +
         std::string(kind) + "\" cx=\"15\" cy=\"6\" r=\"5\"/></svg>";
}

std::string legend_box(const char* fill) {
  return "<svg viewBox=\"0 0 30 12\" aria-hidden=\"true\" xmlns=\"http://www.w3.org/2000/svg\"><rect width=\"30\" "
         "height=\"12\" fill=\"" +
         std::string(fill) + "\" stroke=\"#9aa5ae\"/></svg>";
}

std::string graph_section(const map::TopologicalMap& map, const ReportFacts& facts) {
  if (map.places.empty())
    return "<section id=\"graph\">\n<h2>Graph</h2>\n<p>There is nothing to draw.</p>\n</section>\n";
  return "<section id=\"graph\">\n<h2>Graph</h2>\n<figure><div class=\"scroll\">" + draw_graph(map, facts) +
         "</div>\n<figcaption><ul class=\"legend\"><li>" + legend_dot("place") + "passed once</li><li>" +
         legend_dot("place twice") + "twice</li><li>" + legend_dot("place often") + "more often</li><li>" +
         legend_line("edge") + "way</li><li>" + legend_line("edge weak") + "weak way</li><li>" +
         legend_line("edge blocked") + "blocked way</li></ul>Drawn from what the ways say about direction and length" +
         (facts.metric ? " and from odometry" : "") +
         "; it resembles the floor plan up to a turn and is not to scale.</figcaption></figure>\n</section>\n";
}

std::string tour_section(const BuiltMap& built, const ReportFacts& facts) {
  std::string html = "<section id=\"tour\">\n<h2>Along the tour</h2>\n";
  if (built.map.images.empty()) return html + "<p>There are no pictures.</p>\n</section>\n";
  return html + "<figure><div class=\"scroll\">" + draw_strip(built, facts) +
         "</div>\n<figcaption><ul class=\"legend\"><li>" + legend_line("arc accepted") + "accepted loop</li><li>" +
         legend_line("arc undecided") + "undecided</li><li>" + legend_line("arc rejected") + "rejected</li><li>" +
         legend_box("#b3261e") +
         "weak way</li></ul>The tour from left to right, by number of the "
         "picture, counted from 0. Clusters are pictures that look alike, places what the map made of them; what "
         "occurs once "
         "only is grey, what occurs again has its colour again.</figcaption></figure>\n</section>\n";
}

std::string matrix_section(const BuiltMap& built) {
  std::string html = "<section id=\"matrix\">\n<h2>Similarity</h2>\n";
  const std::size_t images = built.map.images.size();
  if (images == 0 || static_cast<std::size_t>(built.notes.pairs.images()) != images) {
    return html + "<p>There are no compared pictures.</p>\n</section>\n";
  }
  return html + "<figure>" + draw_matrix(built) + "\n<figcaption><ul class=\"legend\"><li>" + legend_box("#aacdeb") +
         "have something in common</li><li>" + legend_box("#082350") + "look the same</li><li>" +
         legend_box("#157347") + "one place</li><li>" + legend_box("#c87800") + "undecided</li><li>" +
         legend_box("#b3261e") +
         "rejected</li></ul>Above the diagonal how alike every two pictures are, 1/(1 + D/D₀) of the visual distance "
         "D; "
         "below it what the map made of it. A tour that comes back draws a line beside the diagonal, or across it when "
         "it "
         "comes back the other way.</figcaption></figure>\n</section>\n";
}

}  // namespace

Result<std::string> report_page(const BuiltMap& built, const std::vector<const TourSource*>& tours,
                                const ReportOptions& options, const std::stop_token& stop) {
  const ReportFacts facts = gather_facts(built);
  std::vector<int> drawn = facts.uncertain_first;
  drawn.resize(std::min(drawn.size(), static_cast<std::size_t>(std::max(0, options.most_pictures))));
  const auto pictures = draw_hypotheses(built, tours, drawn, options, stop);
  if (!pictures) return pass_on(pictures);
  return head(built.map, options) + summary(built, facts) + to_do(built, facts, options.warnings) +
         graph_section(built.map, facts) + tour_section(built, facts) + matrix_section(built) +
         loops_section(built, facts, *pictures) + look_alikes_section(built, facts) + weak_section(built, facts) +
         coverage_section(built, facts) + skipped_section(built) + "</main>\n</body>\n</html>\n";
}

}  // namespace homeward::pipeline
