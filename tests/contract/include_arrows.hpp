// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace homeward::testing {

/// What is wrong with the includes of a source file, one sentence each; empty when nothing is.
/// `path`: of the file, relative to the root of the project, such as "src/map/graph.cpp".
std::vector<std::string> include_problems(const std::string& path, const std::string& source);

}  // namespace homeward::testing
