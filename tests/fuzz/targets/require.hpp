// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <cstdlib>
#include <string>

#include "core/result.hpp"
#include "fuzz/targets/targets.hpp"
#include "wire/json_reader.hpp"

namespace homeward::fuzz {

/// Ends the program, so that the fuzzer keeps the input, where `holds` is false.
inline void require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "this does not hold: %s\n", what);
  std::abort();
}

/// That a refusal says what is wrong, in one line of text.
inline void require_sentence(const Error& error) {
  const auto require = [&](bool holds, const char* what) {
    if (!holds) std::fprintf(stderr, "of \"%s\", %s: ", error.message.c_str(), error.where.c_str());
    fuzz::require(holds, what);
  };
  require(error.message.size() > 8, "a refusal says what is wrong");
  require(error.message.find('\n') == std::string::npos, "a refusal is one line");
  require(wire::is_utf8(error.message), "a refusal is text");
  require(error.code != ErrorCode::kInternal, "foreign bytes are no fault of the program");
}

template <class T>
void require_value_or_sentence(const Result<T>& result) {
  if (!result) require_sentence(result.error());
}

/// What the first byte chooses among so many, and the bytes after it.
struct Choice {
  std::size_t which = 0;
  Input rest;
  [[nodiscard]] std::string text() const { return {rest.begin(), rest.end()}; }
};
inline Choice choose(Input input, std::size_t among) {
  if (input.empty()) return {};
  return {input[0] % among, input.subspan(1)};
}

/// A sound file with bytes of it changed: of each five of the input the first four say where, the last what is there
/// now. An input that begins with an odd byte is the file itself.
inline std::string changed(std::string file, Input input) {
  const Choice choice = choose(input, 2);
  if (choice.which == 1) return choice.text();
  for (Input left = choice.rest; left.size() >= 5; left = left.subspan(5)) {
    std::size_t at = 0;
    for (std::size_t i = 0; i < 4; ++i) at = 256 * at + left[i];
    file[at % file.size()] = static_cast<char>(left[4]);
  }
  return file;
}

}  // namespace homeward::fuzz
