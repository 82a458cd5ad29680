// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

namespace homeward::fuzz {

using Input = std::span<const std::uint8_t>;

/// What reads bytes that somebody else chose, one function each: takes any bytes, and aborts where the reader does what
/// it must not: throws, gives what it then does not take itself, or refuses without saying what and where.
void settings_files(Input input);  // camera, scans, world, scenario, rosbridge, marks: the first byte says which
void request_bodies(Input input);  // edits, sweeps, reasons, problems, missions: the first byte says which
void addresses(Input input);       // of servers and of rosbridges
void link_messages(Input input);   // of the agent link: the first byte says whose
void ros_messages(Input input);    // from a rosbridge
void appearances(Input input);     // of maps and of the agent link
void pictures(Input input);        // JPEG and PNG
void http_requests(Input input);   // head and body, in pieces as large as the first byte says
void tables(Input input);          // CSV, grey maps, sweeps and lists of tours: the first byte says which
void map_files(Input input);       // SQLite: a sound one with what the input says changed
void recordings(Input input);      // the same
void recorded_texts(Input input);  // settings and memory in a recording: the first byte says which
void drawn_plans(Input input);     // VRML97, z or y up, and SVG: the first byte says which

struct Target {
  std::string_view name;
  void (*run)(Input);
};
inline constexpr std::array kTargets{Target{"settings_files", settings_files},
                                     Target{"request_bodies", request_bodies},
                                     Target{"addresses", addresses},
                                     Target{"link_messages", link_messages},
                                     Target{"ros_messages", ros_messages},
                                     Target{"appearances", appearances},
                                     Target{"pictures", pictures},
                                     Target{"http_requests", http_requests},
                                     Target{"tables", tables},
                                     Target{"drawn_plans", drawn_plans},
                                     Target{"map_files", map_files},
                                     Target{"recordings", recordings},
                                     Target{"recorded_texts", recorded_texts}};

}  // namespace homeward::fuzz
