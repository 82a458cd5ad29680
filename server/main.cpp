// SPDX-License-Identifier: Apache-2.0
#include <pthread.h>
#include <spdlog/spdlog.h>
#include <sys/stat.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <csignal>
#include <iostream>

#include "server/app.hpp"
#include "server/log/plain_lines.hpp"
#include "wire/error_table.hpp"

namespace {

using homeward::server::App;
using homeward::server::AppConfig;

bool parse_listen(const std::string& text, AppConfig& config) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos) return false;
  config.address = text.substr(0, colon);
  if (config.address.size() > 2 && config.address.front() == '[' && config.address.back() == ']') {
    config.address = config.address.substr(1, config.address.size() - 2);
  }
  const char* const end = text.data() + text.size();
  const auto [at, error] = std::from_chars(text.data() + colon + 1, end, config.port);
  return error == std::errc() && at == end && !config.address.empty();
}

// Signals are taken by sigwait here alone, so that no handler has to run in the middle of anything.
int wait_for_end(const sigset_t& signals) {
  int number = 0;
  sigwait(&signals, &number);
  return number;
}

int serve(const AppConfig& config, const sigset_t& signals) {
  auto app = App::start(config);
  if (!app) {
    std::cerr << "homeward-server: " << app.error().message << '\n';
    return homeward::wire::exit_code(app.error().code);
  }
  std::cout << "listening on " << config.address << " port " << (*app)->port() << std::endl;
  if (!(*app)->setup_link().empty()) {
    std::cout << "open this link once to make the first account: " << (*app)->setup_link() << std::endl;
  }
  const int number = wait_for_end(signals);
  spdlog::info("ending on signal {}", number);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App options{"The Homeward server: owns the maps, localises, plans and shows the dashboard."};
  AppConfig config;
  std::string listen = "127.0.0.1:8080";
  std::vector<std::string> hosts;
  std::vector<std::string> proxies;
  bool verbose = false;
  options.add_option("--data", config.data, "folder of the server's data; made when it is not there")->required();
  options.add_option("--listen", listen, "ADDRESS:PORT, port 0 for any free one")->capture_default_str();
  options.add_option("--web", config.web, "folder of the built dashboard");
  options.add_option("--print-setup-file", config.setup_file, "also write the one-time set-up link to this file");
  options.add_flag("--allow-plain-http", config.allow_plain_http, "listen without TLS for other machines too");
  options.add_option("--allow-host", hosts, "another name that this server answers to, without port");
  options.add_option("--trust-proxy", proxies,
                     "address of a proxy in front, whose X-Forwarded-For says where a login comes from");
  options.add_option("--longest-mission-s", config.longest_mission_s,
                     "stop every mission after so long; 0: after ten minutes, and later the longer its way is");
  options.add_option("--threads", config.threads, "for pictures and builds; 0: one for each processor")
      ->capture_default_str();
  options.add_flag("--verbose", verbose, "log every request");
  CLI11_PARSE(options, argc, argv);
  config.allowed_hosts.insert(hosts.begin(), hosts.end());
  config.trusted_proxies.insert(proxies.begin(), proxies.end());
  if (!parse_listen(listen, config)) {
    std::cerr << "homeward-server: --listen " << listen << " is not ADDRESS:PORT.\n";
    return 2;
  }
  const auto list = homeward::server::problems(config);
  for (const std::string& problem : list) std::cerr << "homeward-server: " << problem << '\n';
  if (!list.empty()) return 2;

  ::umask(0077);  // what is kept is of somebody's home: for this program's user alone
  homeward::server::log_in_plain_lines();
  // Before any thread starts, so that all of them leave these to sigwait.
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
  spdlog::set_level(verbose ? spdlog::level::debug : spdlog::level::info);
  spdlog::flush_on(spdlog::level::info);
  try {
    return serve(config, signals);
  } catch (const std::exception& exception) {
    std::cerr << "homeward-server: " << exception.what() << '\n';
    return 70;
  }
}
