// SPDX-License-Identifier: Apache-2.0
#include "contract/include_arrows.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include "support/folders.hpp"

namespace homeward::testing::include_arrows_test {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string read(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

/// Every source of the program by its path.
std::map<std::string, std::string> all_sources() {
  const fs::path root = project_folder();
  std::map<std::string, std::string> sources;
  for (const char* folder : {"src", "db", "server"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      const std::string extension = entry.path().extension().string();
      if (extension != ".cpp" && extension != ".hpp") continue;
      sources[fs::relative(entry.path(), root).generic_string()] = read(entry.path());
    }
  }
  return sources;
}

TEST(IncludeArrows, PointOneWayInAllSources) {
  const auto sources = all_sources();
  EXPECT_GT(sources.size(), 100U) << "the sources were not found";
  for (const auto& [path, source] : sources) EXPECT_THAT(include_problems(path, source), IsEmpty());
}

TEST(IncludeArrows, FormNoCircleInAllSources) { EXPECT_THAT(include_circles(all_sources()), IsEmpty()); }

TEST(IncludeArrows, RefuseTwoFilesThatIncludeEachOther) {
  const std::map<std::string, std::string> sources = {{"src/map/graph.cpp", "#include \"map/graph.hpp\"\n"},
                                                      {"src/map/graph.hpp", "#include <vector>\n"},
                                                      {"src/map/lookup.hpp", "#include \"map/graph.hpp\"\n"}};
  EXPECT_THAT(include_circles(sources), IsEmpty());
  auto circle = sources;
  circle["src/map/graph.cpp"] += "#include \"map/lookup.hpp\"\n";
  EXPECT_THAT(include_circles(circle),
              ElementsAre(HasSubstr("files include each other in a circle: map/graph, map/lookup")));
}

TEST(IncludeArrows, RefuseACircleOfThreeFiles) {
  EXPECT_THAT(include_circles({{"db/a.hpp", "#include \"db/b.hpp\""},
                               {"db/b.hpp", "#include \"db/c.hpp\""},
                               {"db/c.hpp", "  #  include \"db/a.hpp\""},
                               {"db/d.hpp", "#include \"db/a.hpp\""}}),
              ElementsAre(HasSubstr("db/a, db/b, db/c")));
}

TEST(IncludeArrows, RefuseFoldersThatIncludeEachOtherThroughDifferentFiles) {
  EXPECT_THAT(include_circles({{"server/http/a.hpp", "#include \"server/auth/b.hpp\""},
                               {"server/auth/c.hpp", "#include \"server/http/d.hpp\""}}),
              ElementsAre(HasSubstr("folders include each other in a circle: server/auth, server/http")));
  EXPECT_THAT(include_circles({{"src/sim/a.hpp", "#include \"sim/generate/b.hpp\""},
                               {"src/sim/generate/c.hpp", "#include \"sim/d.hpp\""}}),
              ElementsAre(HasSubstr("sim/., sim/generate")));
  EXPECT_THAT(include_circles({{"src/sim/generate/c.hpp", "#include \"sim/d.hpp\""},
                               {"server/http/a.hpp", "#include \"server/auth/b.hpp\""}}),
              IsEmpty());
}

TEST(IncludeArrows, RefuseALowerModuleThatIncludesAHigherOne) {
  EXPECT_THAT(include_problems("src/map/graph.cpp", "#include <vector>\n#include \"mapping/edit_log.hpp\"\n"),
              ElementsAre(HasSubstr("src/map/graph.cpp:2: mapping/edit_log.hpp: map may not include mapping")));
  EXPECT_THAT(include_problems("src/core/ids.hpp", "#include \"camera/camera.hpp\"\n").size(), 1U);
}

TEST(IncludeArrows, RefuseSiblings) {
  EXPECT_EQ(include_problems("src/localisation/a.cpp", "#include \"planning/route.hpp\"").size(), 1U);
  EXPECT_EQ(include_problems("src/wire/a.cpp", "#include \"localisation/localiser.hpp\"").size(), 1U);
  EXPECT_EQ(include_problems("server/service/a.cpp", "#include \"sim/motion.hpp\"").size(), 1U);
  EXPECT_EQ(include_problems("src/agent/a.cpp", "#include \"sim/motion.hpp\"").size(), 1U);
  EXPECT_EQ(include_problems("src/agent/a.cpp", "#include \"scenario/mission_run.hpp\"").size(), 1U);
  EXPECT_EQ(include_problems("src/scenario/a.cpp", "#include \"agent/run/program.hpp\"").size(), 1U);
}

TEST(IncludeArrows, AcceptWhatTheTableAllows) {
  EXPECT_THAT(include_problems("src/pipeline/eye.cpp", "#include \"pipeline/eye.hpp\"\n#include \"map/graph.hpp\"\n"),
              IsEmpty());
  EXPECT_THAT(include_problems("src/cli/main.cpp", "#include \"files/tour_folder.hpp\"\n#include <iostream>\n"),
              IsEmpty());
  EXPECT_THAT(include_problems("db/sqlite/a.cpp", "#include <SQLiteCpp/SQLiteCpp.h>\n"), IsEmpty());
  EXPECT_THAT(include_problems("server/http/a.cpp", "#include <boost/beast/core.hpp>\n"), IsEmpty());
  EXPECT_THAT(include_problems("src/mapping/parallel.cpp", "#include <thread>\n"), IsEmpty());
}

TEST(IncludeArrows, KeepSocketsDatabaseAndWorldInTheirPlaces) {
  EXPECT_EQ(include_problems("server/service/a.cpp", "#include <boost/asio.hpp>").size(), 1U);
  EXPECT_EQ(include_problems("server/service/a.cpp", "#include <SQLiteCpp/SQLiteCpp.h>").size(), 1U);
  EXPECT_EQ(include_problems("src/driving/step.cpp", "#include <boost/beast.hpp>").size(), 1U);
  for (const char* header : {"fstream", "filesystem", "iostream", "chrono", "thread"}) {
    for (const char* path : {"src/features/a.cpp", "src/driving/a.cpp"}) {
      EXPECT_EQ(include_problems(path, "#  include <" + std::string(header) + ">").size(), 1U) << path << header;
    }
  }
}

TEST(IncludeArrows, RefuseModulesThatNobodyKnowsAndBareNames) {
  EXPECT_EQ(include_problems("src/utils/a.cpp", "").size(), 1U);
  EXPECT_EQ(include_problems("src/map/a.cpp", "#include \"utils/text.hpp\"").size(), 1U);
  EXPECT_EQ(include_problems("src/map/a.cpp", "#include \"graph.hpp\"").size(), 1U);
}

}  // namespace
}  // namespace homeward::testing::include_arrows_test
