// SPDX-License-Identifier: Apache-2.0
// The cases without robots: reads and strangers.
#include <cmath>
#include <stdexcept>

#include "cases.hpp"
#include "floods.hpp"
#include "generated_map.hpp"
#include "probes.hpp"

namespace homeward::bench {
namespace {

/// Asks and gives the milliseconds until the whole answer was there; throws where it is another one.
double time_of(Caller& caller, const std::string& request, int status) {
  const auto began = Clock::now();
  const int answered = caller.ask(request).status;
  const double time_ms = milliseconds_since(began);
  if (answered == status) return time_ms;
  throw std::runtime_error("The server answered " + std::to_string(answered) + " instead of " + std::to_string(status) +
                           " to " + request.substr(0, request.find('\r')));
}

std::string rename_request(const std::string& map, const std::string& token, int revision) {
  const nlohmann::json edit = {{"kind", "rename"}, {"place", "p1"}, {"label", "name " + std::to_string(revision)}};
  const std::string body = nlohmann::json({{"edits", {edit}}}).dump();
  const std::string fields = "Content-Type: application/json\r\nIf-Match: \"r" + std::to_string(revision) + "\"\r\n";
  return head_of("POST", "/api/v1/maps/" + map + "/edits", token, body.size(), fields) + body;
}

}  // namespace

void measure_reads(const Setting& setting, int changes, std::uint64_t upload_bytes, Report& report) {
  ServerProcess server(setting.bin, setting.threads);
  const map::TopologicalMap made = corridor_map(kLargeMap, false);
  const std::string map = server.import_map(made);
  const std::string token = server.token("installer");
  server.add_robot("chair", map);
  Caller caller(server.port());
  const std::string graph = head_of("GET", "/api/v1/maps/" + map + "/graph", token, 0);
  {
    UsageWatch watch(server);
    const Answered first = caller.ask(graph);
    std::vector<double> rename_ms;
    std::vector<double> cold_ms;
    std::vector<double> cached_ms;
    for (int i = 0; i < changes; ++i) {
      rename_ms.push_back(time_of(caller, rename_request(map, token, static_cast<int>(made.revision) + i), 200));
      cold_ms.push_back(time_of(caller, graph, 200));
      cached_ms.push_back(time_of(caller, graph, 200));
    }
    report.add("graph of a large map", {{"rename", summary(std::move(rename_ms))},
                                        {"graph_after_change", summary(std::move(cold_ms))},
                                        {"graph_again", summary(std::move(cached_ms))},
                                        {"graph_mb", static_cast<double>(first.body_bytes / 1000) / 1000.0},
                                        {"server", watch.figures()}});
  }
  const std::string robots = head_of("GET", "/api/v1/robots", token, 0);
  {
    UsageWatch watch(server);
    nlohmann::json reads = ask_again_and_again(server.port(), robots, setting.seconds);
    report.add("small reads alone", {{"read", std::move(reads)}, {"server", watch.figures()}});
  }
  UsageWatch watch(server);
  const Upload upload(server.port(), token, upload_bytes);
  nlohmann::json reads = ask_again_and_again(server.port(), robots, setting.seconds);
  report.add("small reads during an upload",
             {{"read", std::move(reads)}, {"upload", upload.figures()}, {"server", watch.figures()}});
}

void measure_strangers(const Setting& setting, int connections, std::uint64_t body_bytes, Report& report) {
  ServerProcess server(setting.bin, setting.threads);
  allow_many_sockets();
  UsageWatch watch(server);
  const LargeBodies bodies(server.port(), connections, body_bytes);
  std::this_thread::sleep_for(std::chrono::seconds(setting.seconds));
  nlohmann::json figures = {{"strangers", bodies.figures()}, {"server", watch.figures()}};
  const nlohmann::json& memory = figures.at("server").at("memory_mib");
  const double growth_mib = memory.at("most").get<double>() - memory.at("start").get<double>();
  figures["memory_grew_by_mib"] = std::round(growth_mib * 10.0) / 10.0;
  report.add("strangers with large bodies", std::move(figures));
}

}  // namespace homeward::bench
