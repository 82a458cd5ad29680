// SPDX-License-Identifier: Apache-2.0
// The targets as libFuzzer runs them: homeward_fuzz CORPUS_FOLDER --target=NAME [options of libFuzzer]. It takes what
// begins with two dashes for none of its own.
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "fuzz/targets/targets.hpp"

namespace {

void (*chosen)(homeward::fuzz::Input) = nullptr;

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  constexpr std::string_view kOption = "--target=";
  for (int i = 1; i < *argc; ++i) {
    const std::string_view argument = (*argv)[i];
    if (!argument.starts_with(kOption)) continue;
    for (const auto& target : homeward::fuzz::kTargets) {
      if (target.name == argument.substr(kOption.size())) chosen = target.run;
    }
  }
  if (chosen != nullptr) return 0;
  std::fputs("homeward_fuzz: --target= has to name one of:", stderr);
  for (const auto& target : homeward::fuzz::kTargets) std::fprintf(stderr, " %s", target.name.data());
  std::fputs("\n", stderr);
  std::exit(2);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  chosen({data, size});
  return 0;
}
