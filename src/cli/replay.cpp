// SPDX-License-Identifier: Apache-2.0
#include "recording/replay.hpp"

#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/command.hpp"
#include "files/write_file.hpp"
#include "recording/export.hpp"
#include "recording/states_csv.hpp"
#include "wire/reason_json.hpp"

namespace homeward::cli {
namespace {

using nlohmann::json;

struct ReplayOptions {
  std::string recording;
  bool json = false;
  bool why = false;
  std::string out;
  std::string states;
};

template <class T>
json or_null(const std::optional<T>& value) {
  return value ? json(*value) : json(nullptr);
}

json to_json(const std::optional<db::WhyStopped>& why) {
  if (!why) return nullptr;
  return {{"step", why->step},
          {"after_s", why->after_s},
          {"state", why->state},
          {"reason", wire::reason_to_json(why->reason)},
          {"path_index", why->path_index},
          {"odometry", {why->odometry.x_m, why->odometry.y_m, why->odometry.theta_rad}},
          {"link_up", why->link_up},
          {"min_range_m", or_null(why->min_range_m)},
          {"since_message_s", or_null(why->since_message_s)},
          {"since_picture_s", or_null(why->since_picture_s)},
          {"since_sweep_s", or_null(why->since_sweep_s)},
          {"since_vector_s", or_null(why->since_vector_s)},
          {"last_confidence", or_null(why->last_confidence)}};
}

json to_json(const recording::ReplayResult& result) {
  json value = {{"mission", result.header.mission},
                {"label", result.header.label},
                {"agent", result.header.agent},
                {"started_us", result.header.started_us},
                {"steps", result.steps},
                {"compared", result.compared},
                {"pictures", result.pictures},
                {"vectors", result.vectors},
                {"differences", result.differences},
                {"differing", json::array()},
                {"complete", result.complete},
                {"note", result.note},
                {"why_stopped", to_json(result.why)}};
  for (const recording::ReplayDifference& difference : result.differing) {
    value["differing"].push_back({{"step", difference.step},
                                  {"what", difference.what},
                                  {"recorded", difference.recorded},
                                  {"replayed", difference.replayed}});
  }
  return value;
}

void print_since(const char* what, const std::optional<double>& seconds) {
  if (seconds) std::printf("  %-16s %.2f s before\n", what, *seconds);
}

void print(const db::WhyStopped& why) {
  std::printf("step %lld, after %.2f s: %s%s%s\n", static_cast<long long>(why.step), why.after_s, why.state.c_str(),
              why.reason ? ": " : "", why.reason ? wire::english(*why.reason).c_str() : "");
  std::printf("  view of the way  %lld\n  link             %s\n", static_cast<long long>(why.path_index),
              why.link_up ? "up" : "down");
  if (why.min_range_m) std::printf("  nearest thing    %.2f m\n", *why.min_range_m);
  print_since("last message", why.since_message_s);
  print_since("last picture", why.since_picture_s);
  print_since("last sweep", why.since_sweep_s);
  print_since("last answer", why.since_vector_s);
  if (why.last_confidence) std::printf("  confidence       %.2f in the last home vector\n", *why.last_confidence);
}

void print(const recording::ReplayResult& result) {
  std::printf("%lld of %lld steps, %lld pictures, %lld vectors: %s\n", static_cast<long long>(result.compared),
              static_cast<long long>(result.steps), static_cast<long long>(result.pictures),
              static_cast<long long>(result.vectors),
              result.same() ? "the same, bit for bit" : (std::to_string(result.differences) + " differences").c_str());
  for (const recording::ReplayDifference& difference : result.differing) {
    std::printf("  step %lld, %s: recorded %s, replayed %s\n", static_cast<long long>(difference.step),
                difference.what.c_str(), difference.recorded.c_str(), difference.replayed.c_str());
  }
  std::printf("%s: %s\n", result.complete ? "complete" : "not complete", result.note.c_str());
  if (result.why) print(*result.why);
}

Status tell_why(const ReplayOptions& options) {
  const auto recording = db::RecordingReader::open(options.recording);
  if (!recording) return pass_on(recording);
  const auto why = (*recording)->why_stopped();
  if (!why) return pass_on(why);
  if (!*why) return fail(ErrorCode::kEmptyInput, "The recording has no steps.", options.recording);
  if (options.json) {
    std::cout << to_json(*why).dump() << "\n";
  } else {
    print(**why);
  }
  return {};
}

Status write_states(const ReplayOptions& options) {
  // Most of all not over the recording.
  std::error_code ignored;
  if (std::filesystem::exists(options.states, ignored)) {
    return fail(ErrorCode::kConflict, "There is a file of this name already.", options.states);
  }
  const auto table = recording::states_csv(options.recording);
  if (!table) return pass_on(table);
  return files::write_file(options.states, *table);
}

Status run(const ReplayOptions& options) {
  if (options.why) return tell_why(options);
  if (!options.states.empty()) return write_states(options);
  if (!options.out.empty()) return recording::export_recording(options.recording, options.out);
  ProgressBar bar;
  const auto result = recording::replay(options.recording, [&](double share) { bar.show("replaying", share); });
  if (!result) return pass_on(result);
  if (options.json) {
    std::cout << to_json(*result).dump() << std::endl;
  } else {
    print(*result);
    std::fflush(stdout);
  }
  if (result->same()) return {};
  return fail(ErrorCode::kConflict,
              "The replay differs from what was recorded in " + std::to_string(result->differences) + " values.",
              options.recording);
}

}  // namespace

void register_replay(CLI::App& program) {
  CLI::App* command = program.add_subcommand("replay",
                                             "Run a recorded mission or exploration through the same code again and "
                                             "compare every vector, decision and command");
  const auto options = std::make_shared<ReplayOptions>();
  command->add_option("recording", options->recording, "Recording of a mission or an exploration (.hwrec)")->required();
  command->add_flag("--json", options->json, "The result as one JSON line");
  CLI::Option* why = command->add_flag("--why", options->why, "Only say why the robot stopped");
  CLI::Option* out = command
                         ->add_option("--export", options->out,
                                      "Only write pictures, odometry and sweeps as a tour into this new folder")
                         ->excludes(why);
  command
      ->add_option("--states", options->states,
                   "Only write the table of states of an exploration, what it found and decided, as this new CSV file")
      ->excludes(why)
      ->excludes(out);
  run_on(*command, [options] { return run(*options); });
}

}  // namespace homeward::cli
