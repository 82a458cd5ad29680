// SPDX-License-Identifier: Apache-2.0
// The cases with robots that send frames: floods, frames, and everything at once.
#include <cmath>
#include <memory>
#include <optional>

#include "build_load.hpp"
#include "cases.hpp"
#include "floods.hpp"
#include "generated_map.hpp"
#include "probes.hpp"
#include "robots.hpp"

namespace homeward::bench {
namespace {

using std::chrono::seconds;

constexpr seconds kGraceOfBeliefs{2};  // for those of the last frames
constexpr seconds kSettles{1};         // after a load has gone
constexpr seconds kComesToRest{5};     // until what the load had asked for is answered too

using Floods = std::map<std::string, std::unique_ptr<Flood>>;

Floods begin_floods(const FloodSizes& sizes, ServerProcess& server, const std::string& large_map) {
  Floods floods;
  const std::uint16_t port = server.port();
  const std::string viewer = server.token("viewer");
  const std::string installer = server.token("installer");
  if (sizes.slow > 0) floods["slow"] = std::make_unique<SlowConnections>(port, sizes.slow);
  if (sizes.readers > 0) {
    floods["readers"] = std::make_unique<Readers>(port, "/api/v1/maps/" + large_map + "/graph", viewer, sizes.readers);
  }
  if (sizes.logins > 0) floods["logins"] = std::make_unique<WrongLogins>(port, sizes.logins);
  if (sizes.upload_bytes > 0) floods["upload"] = std::make_unique<Upload>(port, installer, sizes.upload_bytes);
  return floods;
}

nlohmann::json figures_of(const Floods& floods) {
  nlohmann::json figures = nlohmann::json::object();
  for (const auto& [name, flood] : floods) figures[name] = flood->figures();
  return figures;
}

/// Stops for some seconds while the robots go on sending.
nlohmann::json stops_and_frames(Robots& robots, std::uint16_t port, const std::vector<std::string>& tokens) {
  std::vector<std::string> ids;
  for (std::size_t i = 0; i < Robots::kCount; ++i) ids.push_back(robots.id(i));
  robots.log.begin();
  nlohmann::json stops = stop_again_and_again(port, ids, tokens);
  robots.log.end();
  std::this_thread::sleep_for(kGraceOfBeliefs);
  return {{"stop", std::move(stops)}, {"frames", robots.log.figures()}};
}

std::vector<std::string> new_tokens(ServerProcess& server, int count) {
  std::vector<std::string> tokens;
  for (int i = 0; i < count; ++i) tokens.push_back(server.token("viewer"));
  return tokens;
}

}  // namespace

void measure_floods(const Setting& setting, const FloodSizes& sizes, Report& report) {
  ServerProcess server(setting.bin, setting.threads);
  allow_many_sockets();
  const std::string large_map = server.import_map(corridor_map(kLargeMap, false));
  Robots robots(server, server.import_map(corridor_map(kUsualMap, true)));
  const int stops = stops_in(setting.seconds);
  const auto alone = new_tokens(server, stops);
  const auto during = new_tokens(server, stops);
  {
    UsageWatch watch(server);
    nlohmann::json figures = stops_and_frames(robots, server.port(), alone);
    figures["server"] = watch.figures();
    report.add("alone", std::move(figures));
  }
  UsageWatch watch(server);
  Floods floods = begin_floods(sizes, server, large_map);
  std::this_thread::sleep_for(seconds(1));  // until all of it is there
  nlohmann::json figures = stops_and_frames(robots, server.port(), during);
  figures["floods"] = figures_of(floods);
  floods.clear();
  std::this_thread::sleep_for(kSettles);
  figures["server"] = watch.figures();
  report.add("during floods", std::move(figures));
}

void measure_frames(const Setting& setting, bool with_build, Report& report) {
  ServerProcess server(setting.bin, setting.threads);
  Robots robots(server, server.import_map(corridor_map(kUsualMap, true)));
  std::optional<BuildLoad> builds;
  if (with_build) builds.emplace(server);
  UsageWatch watch(server);
  robots.log.begin();
  std::this_thread::sleep_for(seconds(setting.seconds));
  robots.log.end();
  std::this_thread::sleep_for(kGraceOfBeliefs);
  nlohmann::json figures = {{"frames", robots.log.figures()}, {"server", watch.figures()}};
  if (builds) figures["builds_done"] = builds->done();
  report.add(with_build ? "frames beside a build" : "frames", std::move(figures));
}

void measure_everything(const Setting& setting, const FloodSizes& sizes, int times, Report& report) {
  ServerProcess server(setting.bin, setting.threads);
  allow_many_sockets();
  const std::string large_map = server.import_map(corridor_map(kLargeMap, false));
  Robots robots(server, server.import_map(corridor_map(kUsualMap, true)));
  nlohmann::json resident_mib = nlohmann::json::array();
  nlohmann::json peak_mib = nlohmann::json::array();
  nlohmann::json descriptors = nlohmann::json::array();
  nlohmann::json last;
  robots.log.begin();
  for (int i = 0; i < times; ++i) {
    server.forget_peak();
    {
      const BuildLoad builds(server);
      const Floods floods = begin_floods(sizes, server, large_map);
      std::this_thread::sleep_for(std::chrono::duration<double>(double(setting.seconds) / times));
      last = figures_of(floods);
      last["builds_done"] = builds.done();
    }
    std::this_thread::sleep_for(kComesToRest);
    const Usage usage = server.usage();
    resident_mib.push_back(std::round(usage.resident_mib));
    peak_mib.push_back(std::round(usage.peak_mib));
    descriptors.push_back(usage.descriptors);
  }
  robots.log.end();
  std::this_thread::sleep_for(kGraceOfBeliefs);
  report.add("everything at once", {{"resident_mib", resident_mib},
                                    {"peak_mib", peak_mib},
                                    {"descriptors", descriptors},
                                    {"frames", robots.log.figures()},
                                    {"last_time", last}});
}

}  // namespace homeward::bench
