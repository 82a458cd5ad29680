// SPDX-License-Identifier: Apache-2.0
// How does the real homeward-server behave under load? Each command starts one in a folder of its own on a free port,
// with generated maps, and prints a JSON object for each case on the standard output and a table on the standard error.
//
//   cmake --build --preset release --target homeward-server homeward_bench_server
//   P=build/release/bin/homeward_bench_server
//   $P floods --bin build/release/bin                    stops alone, then under all floods at once
//   $P floods --bin build/release/bin --readers 24       one of them alone: --slow, --readers, --logins, --upload
//   $P frames --bin build/release/bin [--build]          from a frame to its belief, with a map built beside it
//   $P reads --bin build/release/bin                     graphs of a large map, its change, small reads
//   $P strangers --bin build/release/bin                 memory under large bodies of those who may send none
//   $P everything --bin build/release/bin                30 minutes of all of it: whether memory and descriptors stay
//   flat
//
// The load takes processor time from the server that it shares the machine with: "processor_s" says how much. An upload
// that is larger than the server takes (--upload-mb) is refused and loads nothing: its "answers" show it.
#include <CLI/CLI.hpp>
#include <iostream>

#include "cases.hpp"

namespace {

using homeward::bench::FloodSizes;
using homeward::bench::Report;
using homeward::bench::Setting;

constexpr std::uint64_t kMegabyte = 1'000'000;

/// Each command has times of its own.
struct Options {
  Setting of_floods{{}, 30, 0};
  Setting of_frames{{}, 60, 0};
  Setting of_reads{{}, 20, 0};
  Setting of_strangers{{}, 20, 0};
  Setting of_everything{{}, 1800, 0};
  int times = 6;
  FloodSizes floods;
  bool upload = false;
  bool build = false;
  std::uint64_t upload_mb = 1000;
  int changes = 20;
  int strangers = 400;
  std::uint64_t body_mb = 250;
};

void add_setting(CLI::App& command, Setting& setting) {
  command.add_option("--bin", setting.bin, "folder with homeward-server")->required();
  command.add_option("--seconds", setting.seconds, "that each case is measured")
      ->check(CLI::Range(1, 3600))
      ->capture_default_str();
  command.add_option("--threads", setting.threads, "of the server; 0: its own choice")->capture_default_str();
}

/// All floods where none was chosen.
FloodSizes chosen(const Options& options) {
  FloodSizes sizes = options.floods;
  sizes.upload_bytes = options.upload ? options.upload_mb * kMegabyte : 0;
  const bool any = sizes.slow > 0 || sizes.readers > 0 || sizes.logins > 0 || options.upload;
  return any ? sizes : FloodSizes{1000, 24, 8, options.upload_mb * kMegabyte};
}

void add_commands(CLI::App& program, Options& options, Report& report) {
  program.require_subcommand(1);
  CLI::App& floods = *program.add_subcommand("floods", "How long a stop takes alone and under floods");
  add_setting(floods, options.of_floods);
  floods.add_option("--slow", options.floods.slow, "connections with half a head; 1000 where no flood is chosen");
  floods.add_option("--readers", options.floods.readers, "of the graph of a large map; 24 where no flood is chosen");
  floods.add_option("--logins", options.floods.logins, "connections with wrong passwords; 8 where no flood is chosen");
  floods.add_flag("--upload", options.upload, "a large upload over and over; also where no flood is chosen");
  floods.add_option("--upload-mb", options.upload_mb, "size of an upload")->capture_default_str();
  floods.callback([&] { measure_floods(options.of_floods, chosen(options), report); });

  CLI::App& frames = *program.add_subcommand("frames", "How long it is from a frame to the belief that follows it");
  add_setting(frames, options.of_frames);
  frames.add_flag("--build", options.build, "while a map is built over and over");
  frames.callback([&] { measure_frames(options.of_frames, options.build, report); });

  CLI::App& reads = *program.add_subcommand("reads", "How long graphs, changes and small reads take");
  add_setting(reads, options.of_reads);
  reads.add_option("--changes", options.changes, "how often the map is changed and read")
      ->check(CLI::Range(1, 10'000))
      ->capture_default_str();
  reads.add_option("--upload-mb", options.upload_mb, "size of an upload")->capture_default_str();
  reads.callback([&] { measure_reads(options.of_reads, options.changes, options.upload_mb * kMegabyte, report); });

  CLI::App& strangers = *program.add_subcommand("strangers", "What the server holds while strangers send bodies");
  add_setting(strangers, options.of_strangers);
  strangers.add_option("--connections", options.strangers, "at once")->capture_default_str();
  strangers.add_option("--body-mb", options.body_mb, "size that each states")->capture_default_str();
  strangers.callback(
      [&] { measure_strangers(options.of_strangers, options.strangers, options.body_mb * kMegabyte, report); });

  CLI::App& everything =
      *program.add_subcommand("everything", "What the server holds after all floods, again and again");
  add_setting(everything, options.of_everything);
  everything.add_option("--times", options.times, "that the floods come and go")
      ->check(CLI::Range(2, 100))
      ->capture_default_str();
  everything.callback([&] {
    const FloodSizes sizes{1000, 24, 8, options.upload_mb * kMegabyte};
    measure_everything(options.of_everything, sizes, options.times, report);
  });
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App program("The homeward-server under load: times, memory and descriptors");
  Options options;
  Report report;
  add_commands(program, options, report);
  try {
    CLI11_PARSE(program, argc, argv);
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
  report.print_table();
  return 0;
}
