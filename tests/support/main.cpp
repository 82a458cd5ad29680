// SPDX-License-Identifier: Apache-2.0
// The main function of every program of tests.
// usage: PROGRAM [--file=NAME_test.cpp ...] [GoogleTest's options]      --file runs the tests of these files alone
#include <gtest/gtest.h>

#include <iostream>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace {

constexpr std::string_view kFile = "--file=";

std::string name_of(const std::string& path) { return path.substr(path.find_last_of('/') + 1); }

/// The full names of this program's tests by the file that each is written in, which is given without its folder.
/// Prints a line for each name that two files bear, and gives nothing then: no filter could tell them apart.
std::map<std::string, std::vector<std::string>> tests_by_file() {
  std::map<std::string, std::vector<std::string>> tests;
  std::set<std::string> names;
  bool unique = true;
  const ::testing::UnitTest& all = *::testing::UnitTest::GetInstance();
  for (int s = 0; s < all.total_test_suite_count(); ++s) {
    const ::testing::TestSuite& suite = *all.GetTestSuite(s);
    for (int t = 0; t < suite.total_test_count(); ++t) {
      const ::testing::TestInfo& test = *suite.GetTestInfo(t);
      const std::string name = std::string(suite.name()) + "." + test.name();
      if (!names.insert(name).second) {
        std::cerr << test.file() << ": there are two tests of the name " << name << "\n";
        unique = false;
      }
      tests[name_of(test.file())].push_back(name);
    }
  }
  if (!unique) tests.clear();
  return tests;
}

/// A filter of GoogleTest for the tests of these files; empty, with a line printed, where one has none.
std::string filter_of(const std::vector<std::string>& files) {
  const auto tests = tests_by_file();
  std::string filter;
  for (const std::string& file : files) {
    const auto found = tests.find(file);
    if (found == tests.end()) {
      std::cerr << "no test of this program is from " << file << "\n";
      return {};
    }
    for (const std::string& name : found->second) filter += (filter.empty() ? "" : ":") + name;
  }
  return filter;
}

}  // namespace

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);  // and takes its own options out of argv
  std::vector<std::string> files;
  for (const std::string_view argument : std::vector<std::string_view>(argv + 1, argv + argc)) {
    if (argument.rfind(kFile, 0) != 0) {
      std::cerr << "unknown option " << argument << " (known: --file=NAME_test.cpp and GoogleTest's)\n";
      return 2;
    }
    files.emplace_back(argument.substr(kFile.size()));
  }
  if (!files.empty()) {
    if (GTEST_FLAG_GET(filter) != "*") {
      std::cerr << "--file and --gtest_filter exclude each other\n";
      return 2;
    }
    const std::string filter = filter_of(files);
    if (filter.empty()) return 2;
    GTEST_FLAG_SET(filter, filter);
  }
  return RUN_ALL_TESTS();
}
