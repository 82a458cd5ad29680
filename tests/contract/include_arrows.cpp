// SPDX-License-Identifier: Apache-2.0
#include "contract/include_arrows.hpp"

#include <map>
#include <regex>
#include <set>
#include <sstream>

namespace homeward::testing {
namespace {

using Modules = std::set<std::string>;

Modules operator+(Modules a, const Modules& b) {
  a.insert(b.begin(), b.end());
  return a;
}

/// Which modules each module may include, besides itself (docs/architecture.md).
const std::map<std::string, Modules>& arrows() {
  static const std::map<std::string, Modules> kArrows = [] {
    const Modules core = {"core"};
    const Modules base = core + Modules{"geometry", "camera", "imageio"};
    const Modules seeing = base + Modules{"features"};
    const Modules joining = seeing + Modules{"matching", "tracking", "map"};
    const Modules methods = {"mapping", "localisation", "planning", "homing", "repeat", "exploration", "linemodel"};
    const Modules pipeline = joining + methods;
    const Modules programs = pipeline + Modules{"pipeline", "wire", "db"};
    std::map<std::string, Modules> arrows = {{"core", {}}};
    for (const char* module : {"geometry", "camera", "imageio"}) arrows[module] = core;
    arrows["features"] = base;
    for (const char* module : {"matching", "tracking", "map"}) arrows[module] = seeing;
    for (const std::string& module : methods) arrows[module] = joining;
    arrows["pipeline"] = pipeline;
    arrows["wire"] = core + Modules{"map", "camera", "features"};  // features: the appearances inside maps
    arrows["db"] = arrows["wire"] + Modules{"wire"};
    arrows["sim"] = core + Modules{"geometry", "camera"};
    arrows["agent"] = programs + Modules{"sim"};
    arrows["server"] = programs;
    arrows["cli"] = programs + Modules{"sim", "agent"};
    return arrows;
  }();
  return kArrows;
}

bool starts_with(const std::string& text, const std::string& start) { return text.rfind(start, 0) == 0; }

bool starts_with_any(const std::string& text, const std::vector<std::string>& starts) {
  for (const std::string& start : starts) {
    if (starts_with(text, start)) return true;
  }
  return false;
}

std::string module_of(const std::string& path) {
  const std::string inner = starts_with(path, "src/") ? path.substr(4) : path;
  return inner.substr(0, inner.find('/'));
}

/// The library reads no files, has no clocks, prints nothing and starts no threads.
bool may_not_in_library(const std::string& header, const std::string& path) {
  static const Modules kWorldly = {"fstream", "filesystem", "iostream", "chrono"};
  static const Modules kThreads = {"thread", "future", "condition_variable"};
  if (kWorldly.contains(header)) return true;
  const bool data_parallel = path == "src/mapping/parallel.cpp" || starts_with(path, "src/sim/");
  return kThreads.contains(header) && !data_parallel;
}

std::string foreign_problem(const std::string& path, const std::string& header) {
  const std::string module = module_of(path);
  const bool program = module == "agent" || module == "cli" || module == "server" || module == "db";
  const bool sockets = starts_with_any(header, {"boost/asio", "boost/beast", "openssl/"});
  if (sockets && !starts_with_any(path, {"server/http/", "server/ws/", "src/agent/link"})) {
    return "sockets belong to server/http, server/ws and src/agent/link";
  }
  if (starts_with_any(header, {"SQLiteCpp", "sqlite3"}) && module != "db") return "SQL belongs to db";
  if (!program && may_not_in_library(header, path)) return "the library has no files, clocks, output or threads";
  return {};
}

}  // namespace

std::vector<std::string> include_problems(const std::string& path, const std::string& source) {
  static const std::regex kInclude(R"(^\s*#\s*include\s*([<"])([^>"]+)[>"])");
  const std::string module = module_of(path);
  std::vector<std::string> problems;
  if (!arrows().contains(module)) return {path + ": the module " + module + " has no row in the table of arrows"};
  std::istringstream lines(source);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    std::smatch match;
    if (!std::regex_search(line, match, kInclude)) continue;
    const std::string header = match[2];
    const std::string where = path + ":" + std::to_string(number) + ": " + header + ": ";
    if (const std::string problem = foreign_problem(path, header); !problem.empty())
      problems.push_back(where + problem);
    if (match[1] != "\"") continue;
    const std::string target = header.substr(0, header.find('/'));
    if (header.find('/') == std::string::npos || starts_with(header, ".")) {
      problems.push_back(where + "write it as module/file");
    } else if (!arrows().contains(target)) {
      problems.push_back(where + "there is no module " + target);
    } else if (target != module && !arrows().at(module).contains(target)) {
      problems.push_back(where + module + " may not include " + target);
    }
  }
  return problems;
}

}  // namespace homeward::testing
