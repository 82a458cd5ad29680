// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>

#include "figures.hpp"

namespace homeward::bench {

/// What all cases are told.
struct Setting {
  std::filesystem::path bin;  // with homeward-server
  int seconds = 0;            // that each case is measured
  int threads = 0;            // of the server; 0: its own choice
};

/// How much of each flood; none of it where 0.
struct FloodSizes {
  int slow = 0;     // connections with half a head
  int readers = 0;  // of the graph of the large map
  int logins = 0;   // connections that try wrong passwords
  std::uint64_t upload_bytes = 0;
};

/// How long a stop takes while nothing else happens and then under the floods; how many frames of four robots are
/// followed by beliefs meanwhile, and what the server holds.
void measure_floods(const Setting& setting, const FloodSizes& sizes, Report& report);

/// From sending a frame to hearing the belief that follows it, four robots at a time; with a build beside it where
/// asked.
void measure_frames(const Setting& setting, bool with_build, Report& report);

/// Graphs of the large map after a change and again, the change, and small reads alone and beside an upload.
void measure_reads(const Setting& setting, int changes, std::uint64_t upload_bytes, Report& report);

/// What the server holds while strangers send it large bodies.
void measure_strangers(const Setting& setting, int connections, std::uint64_t body_bytes, Report& report);

/// All floods, robots that send frames, and builds, so many times, which together take the setting's seconds; what the
/// server holds after each, when the floods have gone, and at most during it.
void measure_everything(const Setting& setting, const FloodSizes& sizes, int times, Report& report);

}  // namespace homeward::bench
