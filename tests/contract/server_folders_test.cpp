// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>

#include "support/folders.hpp"

namespace homeward::testing::server_folders_test {
namespace {

namespace fs = std::filesystem;

/// Which folders of the server each of them may include, besides itself (server/README.md). What stands beside them
/// (app, main) may include all.
const std::map<std::string, std::set<std::string>>& folders() {
  static const std::map<std::string, std::set<std::string>> kFolders = {
      {"time", {}},
      {"log", {}},
      {"ws", {}},
      {"http", {"ws", "time"}},
      {"auth", {"http", "time"}},
      {"services", {"ws", "time"}},
      {"work", {"services", "ws", "time"}},
      {"driving", {"work", "services", "ws", "http", "time"}},
      {"routes", {"driving", "work", "services", "auth", "ws", "http", "time"}},
      {"front", {"work", "auth", "http", "time"}}};
  return kFolders;
}

TEST(ServerFolders, IncludeOnlyWhatStandsBelowThem) {
  static const std::regex kInclude(R"re(^\s*#\s*include\s*"server/([a-z_]+)/)re");
  const fs::path root = project_folder() / "server";
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    const std::string extension = entry.path().extension().string();
    const fs::path inner = fs::relative(entry.path(), root);
    if ((extension != ".cpp" && extension != ".hpp") || !inner.has_parent_path()) continue;
    ++files;
    const std::string folder = inner.begin()->string();
    ASSERT_TRUE(folders().contains(folder)) << "server/" << folder << " has no row in the table";
    std::ifstream lines(entry.path());
    std::smatch match;
    for (std::string line; std::getline(lines, line);) {
      if (!std::regex_search(line, match, kInclude) || match[1] == folder) continue;
      EXPECT_TRUE(folders().at(folder).contains(match[1])) << inner.generic_string() << ": " << line;
    }
  }
  EXPECT_GT(files, 40) << "the sources were not found";
}

}  // namespace
}  // namespace homeward::testing::server_folders_test
