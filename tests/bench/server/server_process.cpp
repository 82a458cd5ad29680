// SPDX-License-Identifier: Apache-2.0
#include "server_process.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "db/map_file.hpp"

namespace homeward::bench {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::chrono::seconds kStartsWithin{30};
constexpr std::chrono::seconds kEndsWithin{20};

/// In the new process: becomes the server, which ends with this program.
[[noreturn]] void become(std::vector<char*> arguments, const std::string& log) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  const int file = ::open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  ::dup2(file, STDOUT_FILENO);
  ::dup2(file, STDERR_FILENO);
  ::execv(arguments.front(), arguments.data());
  ::_exit(127);
}

/// The number of a line such as "VmRSS:   1234 kB".
double mib_of(const std::string& status, const std::string& name) {
  const std::size_t at = status.find(name + ":");
  return at == std::string::npos ? 0.0 : std::stod(status.substr(at + name.size() + 1)) / 1024.0;
}

std::string text_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

/// utime and stime: the 14th and 15th field (proc(5)), the 2nd being in brackets.
double processor_s_of(const std::string& stat) {
  std::istringstream fields(stat.substr(stat.rfind(')') + 1));
  std::string skipped;
  for (int i = 3; i < 14; ++i) fields >> skipped;
  double user = 0.0;
  double system = 0.0;
  fields >> user >> system;
  return (user + system) / static_cast<double>(::sysconf(_SC_CLK_TCK));
}

double own_processor_s() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

double tenths(double value) { return std::round(value * 10.0) / 10.0; }

}  // namespace

ServerProcess::ServerProcess(const fs::path& bin, int threads) {
  start(bin, threads);
  try {
    set_up();
  } catch (...) {
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
    throw;
  }
}

ServerProcess::~ServerProcess() {
  ::kill(pid_, SIGTERM);
  const auto end = Clock::now() + kEndsWithin;
  while (::waitpid(pid_, nullptr, WNOHANG) == 0) {
    if (Clock::now() > end) ::kill(pid_, SIGKILL);
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

void ServerProcess::start(const fs::path& bin, int threads) {
  const fs::path program = bin / "homeward-server";
  if (!fs::is_regular_file(program)) throw std::runtime_error("There is no " + program.string() + ".");
  // The proxy is this program: what asks in the name of many addresses says so in X-Forwarded-For.
  std::vector<std::string> texts = {program.string(),
                                    "--data",
                                    (folder_.path() / "data").string(),
                                    "--listen",
                                    "127.0.0.1:0",
                                    "--print-setup-file",
                                    (folder_.path() / "setup").string(),
                                    "--trust-proxy",
                                    "127.0.0.1",
                                    "--threads",
                                    std::to_string(threads)};
  std::vector<char*> arguments;
  for (std::string& text : texts) arguments.push_back(text.data());
  arguments.push_back(nullptr);
  const std::string log = (folder_.path() / "log").string();
  pid_ = ::fork();
  if (pid_ < 0) throw std::runtime_error("No process could be started.");
  if (pid_ == 0) become(arguments, log);
}

void ServerProcess::set_up() {
  const auto end = Clock::now() + kStartsWithin;
  std::string link;
  while (link.empty() || link.back() != '\n') {
    if (Clock::now() > end || ::waitpid(pid_, nullptr, WNOHANG) != 0) give_up("The server did not start");
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    link = text_of(folder_.path() / "setup");
  }
  link.pop_back();
  port_ = static_cast<std::uint16_t>(std::stoi(link.substr(link.find(':', link.find("://") + 3) + 1)));
  admin_.emplace(port_);
  const std::string secret = link.substr(link.find("token=") + 6);
  expect(201, admin_->post("/api/v1/setup", {{"token", secret}, {"name", "anna"}, {"password", "correct horse"}}));
}

void ServerProcess::give_up(const std::string& why) const {
  const std::string log = text_of(folder_.path() / "log");
  constexpr std::size_t kShown_bytes = 2000;
  throw std::runtime_error(why + ". Its log ends with:\n" +
                           log.substr(log.size() - std::min(log.size(), kShown_bytes)));
}

testing::Answer ServerProcess::expect(int status, testing::Answer answer) {
  if (answer.status != status) give_up("The server answered " + std::to_string(answer.status) + ": " + answer.body);
  return answer;
}

std::string ServerProcess::token(const std::string& role) {
  return expect(201, admin().post("/api/v1/tokens", {{"name", role}, {"role", role}})).json().at("token");
}

std::string ServerProcess::import_map(const map::TopologicalMap& map) {
  const fs::path file = folder_.path() / "made.hwmap";
  if (const Status saved = db::save_map(file, map, {}); !saved) throw std::runtime_error(saved.error().message);
  const auto answer =
      admin().send("POST", "/api/v1/maps/import", text_of(file), {{"Content-Type", "application/vnd.sqlite3"}});
  return expect(201, answer).json().at("map").at("id");
}

Robot ServerProcess::add_robot(const std::string& name, const std::string& map) {
  const json made = expect(201, admin().post("/api/v1/robots", {{"name", name}})).json();
  const Robot robot{made.at("id"), made.at("token")};
  expect(200, admin().put("/api/v1/robots/" + robot.id + "/map", {{"map", map}}));
  return robot;
}

Usage ServerProcess::usage() const {
  const fs::path process = fs::path("/proc") / std::to_string(pid_);
  const std::string status = text_of(process / "status");
  Usage usage{mib_of(status, "VmRSS"), mib_of(status, "VmHWM"), 0, processor_s_of(text_of(process / "stat"))};
  std::error_code ended;
  for (auto entry = fs::directory_iterator(process / "fd", ended); !ended && entry != fs::directory_iterator();
       entry.increment(ended)) {
    ++usage.descriptors;
  }
  return usage;
}

void ServerProcess::forget_peak() const {
  std::ofstream(fs::path("/proc") / std::to_string(pid_) / "clear_refs") << "5";
}

UsageWatch::UsageWatch(const ServerProcess& server) : server_(server), own_start_s_(own_processor_s()) {
  server_.forget_peak();
  start_ = server_.usage();
  most_descriptors_ = start_.descriptors;
  thread_ = std::jthread([this](const std::stop_token& told) {
    while (!told.stop_requested()) {
      most_descriptors_ = std::max(most_descriptors_.load(), server_.usage().descriptors);
      std::this_thread::sleep_for(std::chrono::milliseconds(200));
    }
  });
}

json UsageWatch::figures() {
  thread_ = {};
  const Usage end = server_.usage();
  return {
      {"memory_mib",
       {{"start", tenths(start_.resident_mib)}, {"most", tenths(end.peak_mib)}, {"end", tenths(end.resident_mib)}}},
      {"descriptors", {{"start", start_.descriptors}, {"most", most_descriptors_.load()}, {"end", end.descriptors}}},
      {"processor_s",
       {{"server", tenths(end.processor_s - start_.processor_s)}, {"load", tenths(own_processor_s() - own_start_s_)}}}};
}

}  // namespace homeward::bench
