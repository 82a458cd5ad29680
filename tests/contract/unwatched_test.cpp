// SPDX-License-Identifier: Apache-2.0
// What the thread sanitizer does not watch (cmake/HomewardTarget.cmake) is such that it need not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "support/folders.hpp"

namespace homeward::testing::unwatched_test {
namespace {

namespace fs = std::filesystem;
using ::testing::Contains;
using ::testing::IsEmpty;
using ::testing::SizeIs;

std::string read(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

/// The words between the brackets of the first call `command(` in a CMake file, without `first` where that is the
/// first.
std::vector<std::string> arguments_of(const std::string& text, const std::string& command, const std::string& first) {
  const std::regex call(command + R"(\(\s*)" + first + R"(([^)]*)\))");
  std::smatch found;
  if (!std::regex_search(text, found, call)) return {};
  std::istringstream words(found[1]);
  return {std::istream_iterator<std::string>(words), {}};
}

/// The lines of a source with which two threads could meet in it: locks, threads, atomics, libraries that have some,
/// and variables that outlive a call. Reads sources as clang-format leaves them: what begins a line is in no function.
std::vector<std::string> meetings(const std::string& source) {
  static const std::regex kHeader(
      R"(^#include <(atomic|mutex|shared_mutex|thread|future|condition_variable|stop_token|semaphore|latch|barrier)>|)"
      R"(^#include <(tbb|hnswlib)/)");
  static const std::regex kWord(R"(\b(mutable|volatile|std::atomic\w*|std::j?thread|std::async|std::once_flag)\b)");
  static const std::regex kStatic(R"(^\s*(inline )?static (?!(inline )?const)[^()]*[;={])");
  static const std::regex kGlobal(
      R"(^(?!using |struct |class |enum |const|inline const|static const|namespace |})[a-z])"
      R"([^()#]*\s\w+( = [^()]*|\{[^()]*\})?;)",
      std::regex::icase);
  std::vector<std::string> found;
  std::istringstream lines(source);
  for (std::string line; std::getline(lines, line);) {
    line = line.substr(0, line.find("//"));
    for (const std::regex* forbidden : {&kHeader, &kWord, &kStatic, &kGlobal}) {
      if (std::regex_search(line, *forbidden)) {
        found.push_back(line);
        break;
      }
    }
  }
  return found;
}

TEST(Unwatched, TwoThreadsMeetInNoSourceThatTheThreadSanitizerDoesNotWatch) {
  const fs::path root = project_folder();
  const auto modules = arguments_of(read(root / "cmake/HomewardTarget.cmake"), "set", "homeward_unwatched\\s");
  ASSERT_THAT(modules, Contains("features"));
  int sources = 0;
  for (const std::string& module : modules) {
    if (module == "calibration") continue;  // its sources are in the folder of the cameras
    const fs::path folder = root / "src" / module;
    ASSERT_TRUE(fs::is_directory(folder)) << folder;
    const auto watched = arguments_of(read(folder / "CMakeLists.txt"), "homeward_watch", "");
    const std::set<std::string> exempt(watched.begin(), watched.end());
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      const std::string extension = entry.path().extension().string();
      if ((extension != ".cpp" && extension != ".hpp") || exempt.contains(entry.path().filename().string())) continue;
      ++sources;
      EXPECT_THAT(meetings(read(entry.path())), IsEmpty()) << entry.path();
    }
  }
  EXPECT_GT(sources, 50) << "the sources were not found";
}

TEST(Unwatched, WhatTwoThreadsCouldMeetInIsFound) {
  for (const char* line :
       {"#include <mutex>", "#include <hnswlib/hnswlib.h>", "  mutable int looked_ = 0;", "  std::atomic<int> count;",
        "  static int count = 0;", "  static std::vector<int> kept;", "int count = 0;", "std::vector<int> kept;",
        "std::map<int, double> kept{};", "inline int count = 3;"}) {
    EXPECT_THAT(meetings(line), SizeIs(1)) << line;
  }
}

TEST(Unwatched, WhatIsConstantOrOfOneThreadIsAllowed) {
  for (const char* line :
       {"  static const bool fast = can();", "  static constexpr int kWide = 16;", "constexpr int kRows = 3;",
        "  thread_local std::vector<int> spare;", "  static Result<Index> create(int size);", "using Row = int;",
        "struct Forward;", "const double kHalf = 0.5;", "inline constexpr int kMost = 4;", "  int count = 0;",
        "Result<int> read(int count = 3);", "};", "  // a mutable thing"}) {
    EXPECT_THAT(meetings(line), IsEmpty()) << line;
  }
}

}  // namespace
}  // namespace homeward::testing::unwatched_test
