// SPDX-License-Identifier: Apache-2.0
#include "contract/include_arrows.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include "support/folders.hpp"

namespace homeward::testing {
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

TEST(IncludeArrows, PointOneWayInAllSources) {
  const fs::path root = project_folder();
  int files = 0;
  for (const char* folder : {"src", "db", "server"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      const std::string extension = entry.path().extension().string();
      if (extension != ".cpp" && extension != ".hpp") continue;
      ++files;
      const std::string path = fs::relative(entry.path(), root).generic_string();
      EXPECT_THAT(include_problems(path, read(entry.path())), IsEmpty());
    }
  }
  EXPECT_GT(files, 100) << "the sources were not found";
}

TEST(IncludeArrows, RefuseALowerModuleThatIncludesAHigherOne) {
  EXPECT_THAT(include_problems("src/map/graph.cpp", "#include <vector>\n#include \"mapping/edits.hpp\"\n"),
              ElementsAre(HasSubstr("src/map/graph.cpp:2: mapping/edits.hpp: map may not include mapping")));
  EXPECT_THAT(include_problems("src/core/ids.hpp", "#include \"camera/camera.hpp\"\n").size(), 1U);
}

TEST(IncludeArrows, RefuseSiblings) {
  EXPECT_EQ(include_problems("src/localisation/a.cpp", "#include \"planning/route.hpp\"").size(), 1U);
  EXPECT_EQ(include_problems("src/wire/a.cpp", "#include \"localisation/localiser.hpp\"").size(), 1U);
  EXPECT_EQ(include_problems("server/service/a.cpp", "#include \"sim/motion.hpp\"").size(), 1U);
}

TEST(IncludeArrows, AcceptWhatTheTableAllows) {
  EXPECT_THAT(include_problems("src/pipeline/eye.cpp", "#include \"pipeline/eye.hpp\"\n#include \"map/graph.hpp\"\n"),
              IsEmpty());
  EXPECT_THAT(include_problems("src/cli/main.cpp", "#include \"agent/files/tour_folder.hpp\"\n#include <iostream>\n"),
              IsEmpty());
  EXPECT_THAT(include_problems("db/sqlite/a.cpp", "#include <SQLiteCpp/SQLiteCpp.h>\n"), IsEmpty());
  EXPECT_THAT(include_problems("server/http/a.cpp", "#include <boost/beast/core.hpp>\n"), IsEmpty());
  EXPECT_THAT(include_problems("src/mapping/parallel.cpp", "#include <thread>\n"), IsEmpty());
}

TEST(IncludeArrows, KeepSocketsDatabaseAndWorldInTheirPlaces) {
  EXPECT_EQ(include_problems("server/service/a.cpp", "#include <boost/asio.hpp>").size(), 1U);
  EXPECT_EQ(include_problems("server/service/a.cpp", "#include <SQLiteCpp/SQLiteCpp.h>").size(), 1U);
  EXPECT_EQ(include_problems("src/agent/step.cpp", "#include <boost/beast.hpp>").size(), 1U);
  for (const char* header : {"fstream", "filesystem", "iostream", "chrono", "thread"}) {
    EXPECT_EQ(include_problems("src/features/a.cpp", "#  include <" + std::string(header) + ">").size(), 1U) << header;
  }
}

TEST(IncludeArrows, RefuseModulesThatNobodyKnowsAndBareNames) {
  EXPECT_EQ(include_problems("src/utils/a.cpp", "").size(), 1U);
  EXPECT_EQ(include_problems("src/map/a.cpp", "#include \"utils/text.hpp\"").size(), 1U);
  EXPECT_EQ(include_problems("src/map/a.cpp", "#include \"graph.hpp\"").size(), 1U);
}

}  // namespace
}  // namespace homeward::testing
