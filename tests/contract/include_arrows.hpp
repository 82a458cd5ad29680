// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

namespace homeward::testing {

/// What is wrong with the includes of a source file, one sentence each; empty when nothing is.
/// `path`: of the file, relative to the root of the project, such as "src/map/graph.cpp".
std::vector<std::string> include_problems(const std::string& path, const std::string& source);

/// Which files (a header and its source are one), and which folders of one folder, include each other in circles, one
/// sentence each. "folder/." are the files that lie in a folder itself. `sources`: path -> text, as above.
std::vector<std::string> include_circles(const std::map<std::string, std::string>& sources);

}  // namespace homeward::testing
