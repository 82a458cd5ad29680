// SPDX-License-Identifier: Apache-2.0
// The address sanitizer's build leaves alignment unchecked (cmake/HomewardTarget.cmake): nothing may point a wider type
// at bytes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "support/folders.hpp"

namespace homeward::testing::casts_test {
namespace {

namespace fs = std::filesystem;
using ::testing::IsEmpty;
using ::testing::SizeIs;

/// The lines of a source, as clang-format leaves it, that take an address for one of something else that may be wider
/// than a byte. What a library hands back as `const void*` is exempt: it is what it was given.
std::vector<std::string> wider_casts(std::istream& source) {
  static const std::regex kReinterpret(
      R"(\breinterpret_cast<(?!(const )?((un)?signed char|char|std::byte|std::u?int8_t)\*>))");
  static const std::regex kOldStyle(R"(\((const )?(float|double|int|long|std::u?int(16|32|64)_t|std::size_t)\*\))");
  static const std::regex kThroughVoid(R"(static_cast<(const )?[\w:]+\*>\(static_cast<(const )?void\*>)");
  static const std::regex kBytesThroughVoid(
      R"(static_cast<(const )?((un)?signed char|char|std::byte|std::u?int8_t)\*>\(static_cast<(const )?void\*>)");
  std::vector<std::string> found;
  for (std::string line; std::getline(source, line);) {
    line = line.substr(0, line.find("//"));
    const bool through_void = std::regex_search(line, kThroughVoid) && !std::regex_search(line, kBytesThroughVoid);
    if (std::regex_search(line, kReinterpret) || std::regex_search(line, kOldStyle) || through_void) {
      found.push_back(line);
    }
  }
  return found;
}

TEST(Casts, NoSourceTakesBytesForSomethingWider) {
  int sources = 0;
  for (const char* folder : {"src", "server", "db"}) {
    for (const auto& entry : fs::recursive_directory_iterator(project_folder() / folder)) {
      const std::string extension = entry.path().extension().string();
      if (extension != ".cpp" && extension != ".hpp") continue;
      ++sources;
      std::ifstream source(entry.path());
      EXPECT_THAT(wider_casts(source), IsEmpty()) << entry.path();
    }
  }
  EXPECT_GT(sources, 300) << "the sources were not found";
}

TEST(Casts, WhatIsWiderIsFound) {
  for (const char* line :
       {"  const auto* value = reinterpret_cast<const float*>(bytes);", "auto* head = reinterpret_cast<Head*>(bytes);",
        "auto at = reinterpret_cast<std::uintptr_t>(bytes);", "  const int first = *(const int*)bytes;",
        "  auto* row = static_cast<float*>(static_cast<void*>(bytes));"}) {
    std::istringstream source(line);
    EXPECT_THAT(wider_casts(source), SizeIs(1)) << line;
  }
}

TEST(Casts, BytesOfSomethingAreAllowed) {
  for (const char* line :
       {"  file.write(reinterpret_cast<const char*>(values), size);", "  reinterpret_cast<std::int8_t*>(record)",
        "  static_cast<const char*>(static_cast<const void*>(bytes.data()))", "  // reinterpret_cast<float*>(bytes)",
        "  (count * size)"}) {
    std::istringstream source(line);
    EXPECT_THAT(wider_casts(source), IsEmpty()) << line;
  }
}

}  // namespace
}  // namespace homeward::testing::casts_test
