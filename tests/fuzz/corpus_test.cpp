// SPDX-License-Identifier: Apache-2.0
// The fuzz targets on what fuzzing has found so far that each reads in another way (tests/fuzz/corpus, packed by
// corpus.py).
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "fuzz/targets/targets.hpp"
#include "support/folders.hpp"

namespace homeward::corpus_test {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// Each: its length in four bytes, the least first, and then itself.
std::vector<Bytes> unpacked(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  const Bytes packed{std::istreambuf_iterator<char>(stream), {}};
  std::vector<Bytes> inputs;
  for (std::size_t at = 0; at + 4 <= packed.size();) {
    std::size_t length = 0;
    for (std::size_t i = 0; i < 4; ++i) length |= static_cast<std::size_t>(packed[at + i]) << (8 * i);
    at += 4;
    if (length > packed.size() - at) return {};
    const auto begin = packed.begin() + static_cast<std::ptrdiff_t>(at);
    inputs.emplace_back(begin, begin + static_cast<std::ptrdiff_t>(length));
    at += length;
  }
  return inputs;
}

class FuzzCorpus : public ::testing::TestWithParam<fuzz::Target> {};

// A target aborts where something does not hold.
TEST_P(FuzzCorpus, IsReadOrRefused) {
  const auto file = testing::project_folder() / "tests/fuzz/corpus" / (std::string(GetParam().name) + ".corpus");
  const std::vector<Bytes> inputs = unpacked(file);
  EXPECT_GT(inputs.size(), 5U) << file;
  for (const Bytes& input : inputs) GetParam().run(input);
  GetParam().run({});
}

INSTANTIATE_TEST_SUITE_P(Every, FuzzCorpus, ::testing::ValuesIn(fuzz::kTargets),
                         [](const auto& target) { return std::string(target.param.name); });

}  // namespace
}  // namespace homeward::corpus_test
