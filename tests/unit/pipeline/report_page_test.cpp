// SPDX-License-Identifier: Apache-2.0
#include "pipeline/report/report_page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/report/html.hpp"
#include "support/painted_tour.hpp"
#include "support/well_formed.hpp"

namespace homeward::pipeline::report_page_test {
namespace {

using homeward::testing::drive;
using homeward::testing::markup_problem;
using homeward::testing::MemoryTour;
using ::testing::HasSubstr;
using ::testing::Not;

int count_of(const std::string& text, const std::string& part) {
  int count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

/// Six pictures forth through a corridor and six back.
const MemoryTour& tour() {
  static const MemoryTour made = [] {
    const auto camera = camera::Camera::create(homeward::testing::sphere_camera(512)).value();
    MemoryTour tour("forth_and_back");
    drive(tour, *camera, 6, 0.6);
    drive(tour, *camera, 6, 0.6, true);
    tour.mark("1003.png", "bed");
    return tour;
  }();
  return made;
}

const BuiltMap& built() {
  static const BuiltMap made = [] {
    BuiltMap map = build_noted_map({&tour()}, homeward::testing::sphere_camera(512), {"house", 1, 1}).value();
    map.map.build_seconds = 1.5;
    return map;
  }();
  return made;
}

/// The map with as many hypotheses, all between pictures of the tour, more and more certain.
BuiltMap with_hypotheses(int count) {
  BuiltMap map = built();
  map.map.hypotheses.clear();
  map.notes.mapping.way.clear();
  map.notes.mapping.meets.clear();
  map.notes.mapping.reliability.clear();
  map.notes.mapping.taken_back.clear();
  for (int i = 0; i < count; ++i) {
    map::Hypothesis hypothesis;
    hypothesis.prototype_a = map.map.images[static_cast<std::size_t>(i % 5)].id;
    hypothesis.prototype_b = map.map.images[11U - static_cast<std::size_t>(i % 5)].id;
    hypothesis.similarity = 0.5;
    hypothesis.support = 0.81 + 0.18 * i / count;
    hypothesis.plausibility = 0.995;
    hypothesis.masses_before = {0.375, 0.375, 0.25};
    hypothesis.masses_after = {hypothesis.support, 0.005, 0.995 - hypothesis.support};
    hypothesis.decision = map::Decision::kAccepted;
    map.map.hypotheses.push_back(hypothesis);
    map.notes.mapping.way.push_back(mapping::TrackVerdict::kAgrees);
  }
  return map;
}

std::string page_of(const BuiltMap& map, int most_pictures = 60, const std::vector<ReportWarning>& warnings = {}) {
  const auto page = report_page(map, {&tour()}, {"1 May 2026", most_pictures, 1, 1, warnings});
  EXPECT_TRUE(page) << page.error().message;
  const std::string html = page.value_or("");
  EXPECT_EQ(markup_problem(html), "");
  return html;
}

TEST(ReportPage, TellsAllThatIsAsked) {
  const std::string page = page_of(with_hypotheses(2));
  EXPECT_THAT(page, HasSubstr("<h1>house</h1>"));
  EXPECT_THAT(page, HasSubstr("1 May 2026"));
  EXPECT_THAT(page, HasSubstr("built in 1.5 s"));
  EXPECT_THAT(page, HasSubstr("<dt>pictures</dt><dd>12</dd>"));
  EXPECT_THAT(page, HasSubstr("<dt>places</dt><dd>" + std::to_string(built().map.places.size()) + "</dd>"));
  EXPECT_THAT(page, HasSubstr("<dt>loops accepted</dt><dd>2</dd>"));
  for (const char* section : {"graph", "tour", "matrix", "loops", "look-alikes", "weak", "coverage", "skipped"}) {
    EXPECT_EQ(count_of(page, "<section id=\"" + std::string(section) + "\">"), 1) << section;
    EXPECT_THAT(page, HasSubstr("href=\"#" + std::string(section) + "\""));
  }
  EXPECT_EQ(count_of(page, "<circle class=\"place"), static_cast<int>(built().map.places.size()) + 3);  // the legend's
  EXPECT_THAT(page, HasSubstr(">bed</text>"));
  EXPECT_EQ(count_of(page, "data:image/png;base64,"), 1);   // the matrix
  EXPECT_EQ(count_of(page, "data:image/jpeg;base64,"), 2);  // the hypotheses
}

TEST(ReportPage, AHypothesisHasItsMassesItsDecisionAndWhy) {
  BuiltMap map = with_hypotheses(1);
  std::string page = page_of(map);
  EXPECT_THAT(page, HasSubstr("<span class=\"badge accepted\">accepted</span> 1000.png in "));
  EXPECT_THAT(page, HasSubstr("aria-label=\"before: for 0.38, unknown 0.25, against 0.38\""));
  EXPECT_THAT(page, HasSubstr("aria-label=\"after: for 0.81"));
  EXPECT_THAT(page, HasSubstr("Support 0.81 is above 0.80: one place. The way driven agrees."));
  EXPECT_THAT(page, HasSubstr("decided by the method"));
  EXPECT_THAT(page, HasSubstr("agree with one motion between the two"));

  map.map.hypotheses[0].decision = map::Decision::kRejected;
  map.notes.mapping.way[0] = mapping::TrackVerdict::kContradicts;
  EXPECT_THAT(page_of(map), HasSubstr("the way driven between them leads elsewhere: two places."));
  map.map.hypotheses[0].by = map::Decider::kPerson;
  page = page_of(map);
  EXPECT_THAT(page, HasSubstr("A person decided this."));
  EXPECT_THAT(page, HasSubstr("decided by a person"));
  map.map.hypotheses[0].by = map::Decider::kMethod;
  map.map.hypotheses[0].decision = map::Decision::kUndecided;
  map.map.hypotheses[0].support = 0.3;
  map.notes.mapping.way.clear();
  page = page_of(map);
  EXPECT_THAT(page, HasSubstr("Other loops make it one place all the same."));
  EXPECT_THAT(page, Not(HasSubstr("undecided loop<")));
  map.map.hypotheses[0].prototype_b = map.map.images[5].id;  // the other end of the corridor
  page = page_of(map);
  EXPECT_THAT(page, HasSubstr("kept apart until somebody knows better."));
  EXPECT_THAT(page, HasSubstr("way driven: not told"));
  EXPECT_THAT(page, HasSubstr("Look at 1 undecided loop<"));
}

TEST(ReportPage, TellsWhatKeepsAHypothesisWithSupportEnoughOpen) {
  BuiltMap map = with_hypotheses(1);
  map.map.hypotheses[0].decision = map::Decision::kUndecided;
  map.notes.mapping.meets = {1};
  map.notes.mapping.reliability = {1.0};
  EXPECT_THAT(page_of(map), HasSubstr("Support 0.81 would do, but one place of both would join places"));
  map.notes.mapping.reliability = {0.1};
  EXPECT_THAT(page_of(map), HasSubstr("Support 0.81 would do, but looks were wrong too often"));
  map.notes.mapping.meets = {0};
  EXPECT_THAT(page_of(map), HasSubstr("Support 0.81 would do, but their pictures share too few features"));
}

TEST(ReportPage, ShowsTheLeastCertainHypothesesAndSaysSo) {
  const std::string page = page_of(with_hypotheses(9), 4);
  EXPECT_EQ(count_of(page, "<article class=\"loop\">"), 4);
  EXPECT_THAT(page, HasSubstr("The map has 9 hypotheses; the 4 least certain ones are shown in pictures"));
  EXPECT_EQ(count_of(page, "<tr><td><span class=\"badge accepted\">"), 5);
  EXPECT_LT(page.find("support 0.81"), page.find("support 0.87"));
  EXPECT_THAT(page_of(with_hypotheses(3), 0), Not(HasSubstr("data:image/jpeg")));
}

TEST(ReportPage, EscapesWhatPeopleAndFilesAreCalled) {
  BuiltMap map = with_hypotheses(1);
  const std::string nasty = "<script>alert('\"&\x01\xff')</script>";
  map.map.name = nasty;
  map.map.places[0].label = nasty;
  map.map.destinations[0].label = nasty;
  map.map.feature_config_id = nasty;
  map.notes.skipped.push_back({ErrorCode::kIo, nasty, nasty});
  const std::string page = page_of(map, 60, {{nasty, nasty}});
  EXPECT_THAT(page, Not(HasSubstr("<script")));
  EXPECT_THAT(page,
              HasSubstr("<h1>&lt;script&gt;alert(&#39;&quot;&amp;\xEF\xBF\xBD\xEF\xBF\xBD&#39;)&lt;/script&gt;</h1>"));
  EXPECT_GE(count_of(page, "&lt;script&gt;"), 6);
}

TEST(ReportPage, NeedsNothingFromOutside) {
  const std::string page = page_of(with_hypotheses(2));
  for (const char* outside : {"src=\"http", "href=\"http", "url(", "@import", "<script", "<link"}) {
    EXPECT_THAT(page, Not(HasSubstr(outside)));
  }
}

TEST(ReportPage, WithoutHypothesesSaysThatNothingHadToBeDecided) {
  const std::string page = page_of(with_hypotheses(0));
  EXPECT_THAT(page, HasSubstr("No two stretches of the tour looked like one place"));
  EXPECT_EQ(count_of(page, "<article"), 0);
}

TEST(ReportPage, CanBeStopped) {
  std::stop_source stop;
  stop.request_stop();
  const auto page = report_page(with_hypotheses(2), {&tour()}, {}, stop.get_token());
  ASSERT_FALSE(page);
  EXPECT_EQ(page.error().code, ErrorCode::kCancelled);
}

TEST(ReportPage, OfAnEmptyMapSaysThatItIsEmpty) {
  const auto page = report_page(BuiltMap{}, {}, {});
  ASSERT_TRUE(page);
  EXPECT_EQ(markup_problem(*page), "");
  EXPECT_THAT(*page, HasSubstr("A map without a name"));
  EXPECT_THAT(*page, HasSubstr("The map has no places"));
}

TEST(ReportPage, NamesWeakStretchesAndPartsThatAreNotJoined) {
  BuiltMap map = with_hypotheses(0);
  for (map::Edge& edge : map.map.edges) edge.weak = false;
  EXPECT_THAT(page_of(map), Not(HasSubstr("drive this stretch again</td>")));
  map.map.edges[0].weak = true;
  std::string page = page_of(map);
  EXPECT_EQ(count_of(page, "drive this stretch again</td>"), 1);
  EXPECT_THAT(page, HasSubstr("1 stretch with 1 weak way"));
  EXPECT_THAT(page, Not(HasSubstr("hardly saw each other")));
  map.notes.mapping.extra = {map.map.images.front().id};
  map.notes.mapping.weak_before = 2;
  map.notes.mapping.weak_after = 1;
  EXPECT_THAT(page_of(map), HasSubstr("2 pairs of neighbouring places hardly saw each other; 1 picture was put between "
                                      "them as a place of its own, and 1 pair is left without a sound way."));
  map.map.edges.clear();
  page = page_of(map);
  EXPECT_THAT(page, HasSubstr("The map falls into " + std::to_string(map.map.places.size()) + " parts"));
}

TEST(ReportPage, NamesPlacesThatLookAlikeAndAreFarApart) {
  BuiltMap map = with_hypotheses(0);
  EXPECT_THAT(page_of(map), HasSubstr("No two places that are apart look as alike"));
  map.notes.mapping.place_distance = 1e6F;
  map.map.edges.clear();
  EXPECT_GE(count_of(page_of(map), "<td class=\"n\">not joined</td>"), 1);
}

TEST(ReportPage, APictureThatIsGoneIsAnError) {
  const auto page = report_page(with_hypotheses(1), {}, {});
  ASSERT_FALSE(page);
  EXPECT_EQ(page.error().code, ErrorCode::kNotFound);
  EXPECT_EQ(page.error().where, "forth_and_back/1000.png");
}

TEST(ReportHtml, EncodesBytesAsInTheirDefinition) {  // RFC 4648, section 10
  const auto encoded = [](std::string_view text) {
    return data_uri("a/b", {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  };
  EXPECT_EQ(encoded(""), "data:a/b;base64,");
  EXPECT_EQ(encoded("f"), "data:a/b;base64,Zg==");
  EXPECT_EQ(encoded("fo"), "data:a/b;base64,Zm8=");
  EXPECT_EQ(encoded("foobar"), "data:a/b;base64,Zm9vYmFy");
}

TEST(ReportHtml, TheCheckOfTagsFindsWhatIsWrong) {
  EXPECT_EQ(markup_problem("<!DOCTYPE html>\n<p class=\"a\">x<br/>&lt;</p>"), "");
  for (const char* bad : {"<p>", "<p></b>", "</p>", "a & b", "a < b", "<p class=a></p>", "<p id=\"a\"b\"></p>"}) {
    EXPECT_NE(markup_problem(bad), "") << bad;
  }
}

}  // namespace
}  // namespace homeward::pipeline::report_page_test
