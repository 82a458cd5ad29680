// SPDX-License-Identifier: Apache-2.0
#include "contract/include_arrows.hpp"

#include <algorithm>
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
    std::map<std::string, Modules> arrows = {{"core", {}}};
    for (const char* module : {"geometry", "camera", "imageio", "raycast"}) arrows[module] = core;
    arrows["features"] = base;
    for (const char* module : {"matching", "tracking", "map"}) arrows[module] = seeing;
    for (const std::string& module : methods) arrows[module] = joining;
    arrows["linemodel"] = joining + Modules{"raycast"};
    arrows["pipeline"] = pipeline;
    arrows["wire"] = core + Modules{"map", "camera", "features"};  // features: the appearances inside maps
    arrows["db"] = arrows["wire"] + Modules{"wire"};
    arrows["files"] = core + Modules{"camera", "imageio", "wire"};
    arrows["sim"] = core + Modules{"geometry", "camera", "raycast"};
    arrows["driving"] = pipeline + Modules{"pipeline", "wire"};
    arrows["recording"] = arrows["driving"] + Modules{"driving", "files", "db"};
    arrows["scenario"] = arrows["recording"] + Modules{"recording", "sim"};
    arrows["agent"] = arrows["recording"] + Modules{"recording"};
    arrows["simulated_agent"] = arrows["scenario"] + Modules{"scenario", "agent"};
    arrows["server"] = pipeline + Modules{"pipeline", "wire", "db"};
    arrows["cli"] = arrows["scenario"] + Modules{"scenario"};
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
  static const Modules kWorldlyModules = {"files",           "db",     "recording", "scenario", "agent",
                                          "simulated_agent", "server", "cli"};
  const bool sockets = starts_with_any(header, {"boost/asio", "boost/beast", "openssl/"});
  if (sockets && !starts_with_any(path, {"server/http/", "server/ws/", "src/agent/link"})) {
    return "sockets belong to server/http, server/ws and src/agent/link";
  }
  if (starts_with_any(header, {"SQLiteCpp", "sqlite3"}) && module != "db") return "SQL belongs to db";
  if (!kWorldlyModules.contains(module) && may_not_in_library(header, path))
    return "the library has no files, clocks, output or threads";
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

namespace {

/// A header and its source are one unit: "map/graph" of src/map/graph.hpp, as includes name it.
std::string unit_of(const std::string& path) {
  const std::string inner = starts_with(path, "src/") ? path.substr(4) : path;
  return inner.substr(0, inner.rfind('.'));
}

using Graph = std::map<std::string, std::set<std::string>>;

/// Sets of nodes of which each is reached from each other one (Tarjan's strongly connected components), larger than
/// one.
class Circles {
 public:
  explicit Circles(const Graph& graph) : graph_(graph) {
    for (const auto& [node, ignored] : graph) {
      if (!reached_.contains(node)) visit(node);
    }
  }
  [[nodiscard]] const std::vector<std::set<std::string>>& found() const { return found_; }

 private:
  struct Reached {
    std::size_t number = 0;
    std::size_t lowest = 0;
    bool open = true;
  };
  std::size_t visit(const std::string& node) {
    const std::size_t number = reached_.size();
    reached_[node] = {number, number, true};
    path_.push_back(node);
    if (const auto next = graph_.find(node); next != graph_.end()) {
      for (const std::string& target : next->second) {
        const auto known = reached_.find(target);
        if (known != reached_.end() && !known->second.open) continue;
        const std::size_t lowest = known == reached_.end() ? visit(target) : known->second.number;
        reached_[node].lowest = std::min(reached_[node].lowest, lowest);
      }
    }
    const std::size_t lowest = reached_[node].lowest;
    if (lowest == number) close(node);
    return lowest;
  }
  void close(const std::string& node) {
    std::set<std::string> circle;
    for (bool last = false; !last;) {
      last = path_.back() == node;
      reached_[path_.back()].open = false;
      circle.insert(path_.back());
      path_.pop_back();
    }
    if (circle.size() > 1) found_.push_back(circle);
  }

  const Graph& graph_;
  std::map<std::string, Reached> reached_;
  std::vector<std::string> path_;
  std::vector<std::set<std::string>> found_;
};

/// Where two units part: the folder that holds both, and what of each lies in it: a folder's name, or "." for the unit
/// itself.
struct Parting {
  std::string folder;
  std::string from;
  std::string to;
};

Parting parting(const std::string& from, const std::string& to) {
  Parting at;
  std::size_t begin = 0;
  for (std::size_t end = from.find('/'); end != std::string::npos; end = from.find('/', begin)) {
    if (to.compare(0, end + 1, from, 0, end + 1) != 0) break;
    begin = end + 1;
  }
  const auto part = [begin](const std::string& unit) {
    const std::size_t end = unit.find('/', begin);
    return end == std::string::npos ? std::string(".") : unit.substr(begin, end - begin);
  };
  at.folder = from.substr(0, begin);
  at.from = part(from);
  at.to = part(to);
  return at;
}

std::vector<std::string> sentences(const std::string& kind, const Graph& graph) {
  std::vector<std::string> problems;
  const Circles circles(graph);
  for (const std::set<std::string>& circle : circles.found()) {
    std::string names;
    for (const std::string& name : circle) names += (names.empty() ? "" : ", ") + name;
    problems.push_back("these " + kind + " include each other in a circle: " + names);
  }
  return problems;
}

}  // namespace

std::vector<std::string> include_circles(const std::map<std::string, std::string>& sources) {
  static const std::regex kInclude(R"(^\s*#\s*include\s*"([^"]+)\.hpp")");
  Graph units;
  Graph folders;
  for (const auto& [path, source] : sources) {
    const std::string from = unit_of(path);
    std::istringstream lines(source);
    std::string line;
    while (std::getline(lines, line)) {
      std::smatch match;
      if (!std::regex_search(line, match, kInclude) || match[1] == from) continue;
      units[from].insert(match[1]);
      const Parting at = parting(from, match[1]);
      if (at.from != at.to) folders[at.folder + at.from].insert(at.folder + at.to);
    }
  }
  std::vector<std::string> problems = sentences("files", units);
  for (std::string& problem : sentences("folders", folders)) problems.push_back(std::move(problem));
  return problems;
}

}  // namespace homeward::testing
