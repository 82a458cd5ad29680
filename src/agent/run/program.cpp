// SPDX-License-Identifier: Apache-2.0
#include "agent/run/program.hpp"

#include <spdlog/spdlog.h>
#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <iostream>
#include <memory>
#include <thread>

#include "agent/run/agent_loop.hpp"
#include "agent/run/driver_choice.hpp"
#include "agent/upload/upload.hpp"
#include "files/read_file.hpp"
#include "wire/error_table.hpp"

namespace homeward::agent {
namespace {

struct ServerOptions {
  std::string address = "http://127.0.0.1:8080";
  std::string token_file;
};

void add_server_options(CLI::App& command, ServerOptions& options) {
  command.add_option("--server", options.address, "Address of the server")->capture_default_str();
  command.add_option("--token-file", options.token_file, "File with the robot's token")->required();
}

Result<std::string> read_token(const std::string& file) {
  auto text = files::read_text(file);
  if (!text) return pass_on(text);
  while (!text->empty() && std::isspace(static_cast<unsigned char>(text->back())) != 0) text->pop_back();
  if (text->empty()) return fail(ErrorCode::kInvalidInput, "The file holds no token.", file);
  return *text;
}

struct RunOptions {
  ServerOptions server;
  std::string robot;
  std::string robot_name = "Homeward robot";
  DriverOptions driver;
  std::string joystick;
  std::string explorations;
  std::string record;
  std::int64_t record_limit_mb = 512;
  std::int64_t record_folder_limit_mb = 4096;
};

/// Waits for SIGINT or SIGTERM in a thread of its own, so that the loop can end in order.
class SignalWatch {
 public:
  SignalWatch() {
    sigemptyset(&signals_);
    sigaddset(&signals_, SIGINT);
    sigaddset(&signals_, SIGTERM);
    pthread_sigmask(SIG_BLOCK, &signals_, nullptr);
    thread_ = std::thread([this] {
      int number = 0;
      sigwait(&signals_, &number);
      stop_.request_stop();
    });
  }
  ~SignalWatch() {
    // Blocked in every thread and waited for in that one: it ends the wait, not the thread.
    pthread_kill(thread_.native_handle(), SIGTERM);  // NOLINT(bugprone-bad-signal-to-kill-thread)
    thread_.join();
  }
  SignalWatch(const SignalWatch&) = delete;
  SignalWatch& operator=(const SignalWatch&) = delete;
  [[nodiscard]] std::stop_token token() const { return stop_.get_token(); }

 private:
  sigset_t signals_{};
  std::stop_source stop_;
  std::thread thread_;
};

Status run(const RunOptions& options, const std::vector<FurtherDriver>& further) {
  const SignalWatch signals;
  const auto address = parse_address(options.server.address);
  if (!address) return pass_on(address);
  const auto token = read_token(options.server.token_file);
  if (!token) return pass_on(token);
  spdlog::info("preparing the driver: {}", options.driver.driver);
  const auto driver =
      make_driver(options.driver, further, [](const std::string& what) { spdlog::info("robot: {}", what); });
  if (!driver) return pass_on(driver);
  AgentOptions agent_options{*address,
                             RobotId(options.robot),
                             *token,
                             options.robot_name,
                             [](const std::string& what) { spdlog::info("{}", what); },
                             std::nullopt,
                             options.joystick};
  if (!options.explorations.empty()) agent_options.explorations = options.explorations;
  if (!options.record.empty()) {
    recording::RecordingOptions& record = agent_options.record.emplace();
    record.folder = options.record;
    record.limit_bytes = options.record_limit_mb << 20;
    record.folder_limit_bytes = options.record_folder_limit_mb << 20;
  }
  return run_agent(**driver, agent_options, signals.token());
}

struct UploadCommand {
  ServerOptions server;
  UploadOptions upload;
};

Status upload(const UploadCommand& options) {
  const auto address = parse_address(options.server.address);
  if (!address) return pass_on(address);
  const auto token = read_token(options.server.token_file);
  if (!token) return pass_on(token);
  RestClient server(*address, *token);
  int reported = -1;
  const auto progress = [&](double share) {
    const int tenths = static_cast<int>(share * 10.0);
    if (tenths == reported) return true;
    reported = tenths;
    std::fprintf(stderr, "uploading: %d %%\n", tenths * 10);
    return true;
  };
  const auto tour = upload_tour(server, options.upload, progress);
  if (!tour) return pass_on(tour);
  for (const Error& skipped : tour->skipped) std::cerr << "Left out: " << skipped.message << "\n";
  std::cout << tour->id << "\n";
  return {};
}

void run_on(CLI::App& command, const std::function<Status()>& work) {
  command.callback([&command, work] {
    const Status status = work();
    if (status) return;
    const Error& error = status.error();
    std::cerr << command.get_parent()->get_name() << ": " << error.message
              << (error.where.empty() ? "" : " (" + error.where + ")") << "\n";
    throw CLI::RuntimeError(wire::exit_code(error.code));
  });
}

void register_run(CLI::App& program, const std::vector<FurtherDriver>& further) {
  CLI::App* command = program.add_subcommand("run", "Drive a robot for a server");
  const auto options = std::make_shared<RunOptions>();
  add_server_options(*command, options->server);
  command->add_option("--robot", options->robot, "The robot's id on the server")->required();
  command->add_option("--name", options->robot_name, "The robot's name, for the log")->capture_default_str();
  add_driver_options(*command, options->driver, further);
  command->add_option("--joystick", options->joystick,
                      "The rider's joystick at this machine (/dev/input/js0): deflected, it ends a mission and drives");
  command->add_option(
      "--explorations", options->explorations,
      "Map buildings by itself when told to; what it explores is kept in this folder until the server has it");
  command->add_option("--record", options->record, "Record each mission as a file in this folder (homeward replay)");
  command
      ->add_option("--record-limit-mb", options->record_limit_mb,
                   "Size of one recording; full, it goes on without pictures")
      ->check(CLI::Range(1, 1 << 20))
      ->capture_default_str();
  command
      ->add_option("--record-folder-limit-mb", options->record_folder_limit_mb,
                   "Size of all recordings; the oldest are removed")
      ->check(CLI::Range(1, 1 << 24))
      ->capture_default_str();
  run_on(*command, [options, further] { return run(*options, further); });
}

void register_upload(CLI::App& program) {
  CLI::App* command =
      program.add_subcommand("upload", "Bring a tour to a server: pictures, times, odometry, sweeps and marks");
  const auto options = std::make_shared<UploadCommand>();
  add_server_options(*command, options->server);
  command->add_option("--tour", options->upload.folder, "Folder of the tour")->required();
  command->add_option("--camera", options->upload.camera, "camera.json (otherwise the one in the folder)");
  command->add_option("--name", options->upload.name, "Name of the tour")->required();
  run_on(*command, [options] { return upload(*options); });
}

}  // namespace

int run_program(int argc, char** argv, const std::string& name, const std::vector<FurtherDriver>& further) {
  CLI::App program("The robot's side of Homeward", name);
  program.require_subcommand(1);
  register_run(program, further);
  register_upload(program);
  try {
    program.parse(argc, argv);
  } catch (const CLI::RuntimeError& failed) {
    return failed.get_exit_code();
  } catch (const CLI::ParseError& wrong) {
    return program.exit(wrong) == 0 ? 0 : wire::exit_code(ErrorCode::kInvalidInput);
  } catch (const std::exception& broken) {
    std::cerr << name << ": " << broken.what() << "\n";
    return wire::exit_code(ErrorCode::kInternal);
  }
  return 0;
}

}  // namespace homeward::agent
