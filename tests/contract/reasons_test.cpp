// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cctype>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>

#include "map/no_route.hpp"
#include "planning/no_route.hpp"
#include "planning/route.hpp"
#include "support/folders.hpp"
#include "support/sample_map.hpp"
#include "wire/map_reasons.hpp"
#include "wire/reason_catalogue.hpp"
#include "wire/reason_json.hpp"

namespace homeward::wire::reasons_test {
namespace {

namespace fs = std::filesystem;
using homeward::testing::project_folder;
using nlohmann::json;

std::string read(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

json proto(const std::string& name) { return json::parse(read(project_folder() / "proto" / name)); }

std::string all_sources() {
  std::string text;
  for (const char* folder : {"src", "db", "server"}) {
    for (const auto& entry : fs::recursive_directory_iterator(project_folder() / folder)) {
      const std::string extension = entry.path().extension().string();
      if (extension == ".cpp" || extension == ".hpp") text += read(entry.path());
    }
  }
  return text;
}

/// "way_blocked" as "kWayBlocked".
std::string enumerator(const std::string& code) {
  std::string name = "k";
  bool first = true;
  for (const char c : code) {
    if (c != '_') name += first ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
    first = c == '_';
  }
  return name;
}

std::set<std::string> placeholders(const std::string& words) {
  static const std::regex kPlaceholder(R"(\{([a-z_]+)(\?[^}:]*:[^}]*)?\})");
  std::set<std::string> names;
  for (auto at = std::sregex_iterator(words.begin(), words.end(), kPlaceholder); at != std::sregex_iterator(); ++at)
    names.insert((*at)[1]);
  return names;
}

TEST(Reasons, EachIsSaidInEnglishWithAllOfItsParameters) {
  const json codes = proto("reasons.json").at("codes");
  const json english = proto("reasons.en.json").at("reasons");
  EXPECT_EQ(codes.size(), english.size());
  for (const auto& [code, entry] : codes.items()) {
    ASSERT_TRUE(english.contains(code)) << code;
    std::set<std::string> names;
    for (const auto& [name, type] : entry.at("parameters").items()) names.insert(name);
    if (code == "error" || code == "error_at") names.erase("error");  // for programs
    EXPECT_EQ(placeholders(english.at(code)), names) << code;
  }
}

TEST(Reasons, EachIsOfAKindAndItsParametersOfTypesThatAreExplained) {
  const json reasons = proto("reasons.json");
  std::set<std::string> kinds;
  for (const auto& [code, entry] : reasons.at("codes").items()) {
    kinds.insert(entry.at("kind"));
    for (const auto& [name, type] : entry.at("parameters").items()) {
      EXPECT_TRUE(reasons.at("types").contains(type.get<std::string>())) << code << "/" << name;
    }
  }
  for (const auto& [kind, meaning] : reasons.at("kinds").items()) EXPECT_EQ(kinds.erase(kind), 1U) << kind;
  EXPECT_THAT(kinds, ::testing::IsEmpty());
}

TEST(Reasons, EachIsGivenSomewhere) {
  const std::string sources = all_sources();
  std::set<std::string> given;
  static const std::regex kGiven("\\bReasonCode::(\\w+)|\"code\":\"(\\w+)\"");
  for (auto at = std::sregex_iterator(sources.begin(), sources.end(), kGiven); at != std::sregex_iterator(); ++at)
    given.insert((*at)[1].matched ? (*at)[1] : (*at)[2]);
  const nlohmann::json reasons = proto("reasons.json");
  for (const auto& [code, entry] : reasons.at("codes").items()) {
    EXPECT_TRUE(given.contains(enumerator(code)) || given.contains(code)) << code << " is never given";
  }
}

TEST(Reasons, TheProgramHasTheTable) {
  const json codes = proto("reasons.json").at("codes");
  ASSERT_EQ(reason_rows().size(), codes.size());
  for (const ReasonRow& row : reason_rows()) {
    const json& entry = codes.at(std::string(row.name));
    EXPECT_EQ(entry.at("kind"), row.kind) << row.name;
    EXPECT_EQ(entry.at("parameters").size(), row.parameters.size()) << row.name;
  }
}

TEST(Reasons, AreFilledIn) {
  EXPECT_EQ(english({ReasonCode::kStoppedBy, {{"by", "anna"}}}), "Stopped by anna.");
  EXPECT_EQ(english({ReasonCode::kDestinationUnsure, {{"destination", ""}}}),
            "I am not sure that this is the destination.");
  EXPECT_EQ(english(reason_with(ReasonCode::kTakesAnotherWay, "because", {ReasonCode::kWayBlocked})),
            "The way is blocked. I take another way.");
  const auto added = [](std::int64_t images, std::int64_t places) {
    return english({ReasonCode::kToursAdded,
                    {{"images", images},
                     {"joined_images", std::int64_t{1}},
                     {"joined_places", std::int64_t{1}},
                     {"places", places},
                     {"destinations", std::int64_t{0}}}});
  };
  EXPECT_EQ(added(1, 2),
            "1 picture came to the map, 1 of them at 1 place of before; 2 places and 0 destinations are new.");
  EXPECT_EQ(added(18, 1),
            "18 pictures came to the map, 1 of them at 1 place of before; 1 place and 0 destinations are new.");
}

TEST(Reasons, OfATourThatJumpsNameTheFirstJumps) {
  map::TourWarning warning;
  warning.jumps = 3;
  warning.steps = 40;
  warning.first = {{"1.jpg", "2.jpg"}, {"7.jpg", "8.jpg"}};
  EXPECT_THAT(english(reason_of(warning)),
              ::testing::StartsWith("The tour jumps at 3 of 40 steps: 1.jpg to 2.jpg, 7.jpg to 8.jpg, .... These"));
  warning.against_times = true;
  EXPECT_THAT(english(reason_of(warning)), ::testing::EndsWith("Their times say another order than their names, too."));
}

TEST(Reasons, WhyThereIsNoWayIsSaidAsInTheProblem) {
  const map::TopologicalMap map = homeward::testing::sample_map();
  const PlaceId from = map.places.front().id;
  const PlaceId to = map.places.back().id;
  planning::RouteRequest request{.from = from, .to = to, .avoid = {}};
  for (const map::Edge& edge : map.edges) request.closed.push_back({edge.from, edge.to});
  const auto route = planning::plan_route(map, request);
  ASSERT_FALSE(route);
  ASSERT_EQ(route.error().code, ErrorCode::kNoRoute);
  EXPECT_EQ(english(reason_of(planning::explain_no_route(map, request), map)), route.error().message);
}

TEST(Reasons, ComeBackFromAColumnOfADatabase) {
  const Reason reason =
      reason_with(ReasonCode::kTriesOnceMore, "because", {ReasonCode::kStoppedBy, {{"by", "an\"na"}}});
  EXPECT_EQ(reason_from_text(reason_to_text(reason)), reason);
  EXPECT_EQ(reason_from_text("The way is blocked."), in_words("The way is blocked."));
  EXPECT_EQ(reason_from_text("{\"code\":\"of_tomorrow\",\"parameters\":{}}").code, ReasonCode::kText);
  EXPECT_EQ(json::parse(reason_to_text(in_words("caf\xE9"))).at("parameters").at("text"), "caf\xEF\xBF\xBD");
}

TEST(Reasons, DoNotLieInsideEachOtherWithoutEnd) {
  Reason reason{ReasonCode::kWayBlocked};
  for (int depth = 0; depth < 4; ++depth) reason = reason_with(ReasonCode::kTakesAnotherWay, "because", reason);
  EXPECT_TRUE(reason_from_json(reason_to_json(reason)));
  reason = reason_with(ReasonCode::kTakesAnotherWay, "because", reason);
  EXPECT_FALSE(reason_from_json(reason_to_json(reason)));
}

}  // namespace
}  // namespace homeward::wire::reasons_test
