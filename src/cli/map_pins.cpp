// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <iostream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "cli/command.hpp"
#include "cli/map.hpp"
#include "db/map_file.hpp"
#include "files/read_file.hpp"
#include "files/write_file.hpp"
#include "wire/json_reader.hpp"
#include "wire/plan_json.hpp"
#include "wire/tracked_json.hpp"

namespace homeward::cli {
namespace {

struct MapPinsOptions {
  std::string map;
  std::string tracked;  // what homeward track printed
  std::string tour;     // of the map's pictures; empty: the only one
  std::string plan;     // id on the server
  int version = 0;      // of it; 0: the newest
  double most_spread_m = 0.2;
  std::string out;
};

std::string tour_of(const ImageId& image) {
  const std::size_t end = image.str().rfind('/');
  return end == std::string::npos ? std::string() : image.str().substr(0, end);
}

std::string file_of(const ImageId& image) { return image.str().substr(image.str().rfind('/') + 1); }

/// What is said of each picture, by its file name.
Result<std::map<std::string, wire::TrackedPose>> read_tracked(const std::string& file) {
  const auto text = files::read_text(file);
  if (!text) return pass_on(text);
  std::map<std::string, wire::TrackedPose> tracked;
  std::istringstream lines(*text);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    if (line.empty()) continue;
    const std::string where = file + ": line " + std::to_string(number);
    const auto value = wire::parse_json(line, where);
    if (!value) return pass_on(value);
    auto one = wire::tracked_pose_from_json(*value, where);
    if (!one) return pass_on(one);
    tracked.insert_or_assign(one->image, *std::move(one));
  }
  if (tracked.empty()) return fail(ErrorCode::kInvalidInput, "There is no line of homeward track in it.", file);
  return tracked;
}

/// The tour whose pictures were tracked: file names of two tours may be the same.
Result<std::string> tour_in(const map::TopologicalMap& map, const MapPinsOptions& options) {
  std::set<std::string> tours;
  for (const map::MapImage& image : map.images) tours.insert(tour_of(image.id));
  if (options.tour.empty()) {
    if (tours.size() == 1) return *tours.begin();
    return fail(ErrorCode::kInvalidInput, "The map has several tours: say of which one the pictures were tracked.",
                "--tour");
  }
  if (!tours.contains(options.tour))
    return fail(ErrorCode::kNotFound, "The map has no such tour.", "--tour " + options.tour);
  return options.tour;
}

/// A pin for each place whose prototype's pose is known well enough.
std::vector<wire::PlanPinRequest> pins_of(const map::TopologicalMap& map, const std::string& tour,
                                          const std::map<std::string, wire::TrackedPose>& tracked,
                                          double most_spread_m) {
  std::vector<wire::PlanPinRequest> pins;
  for (const map::Place& place : map.places) {
    if (tour_of(place.prototype) != tour) continue;
    const auto found = tracked.find(file_of(place.prototype));
    if (found == tracked.end() || !found->second.pose || found->second.spread_m > most_spread_m) continue;
    pins.push_back({{}, place.prototype, position_m(*found->second.pose), found->second.pose->theta_rad});
  }
  return pins;
}

/// No more than a map may have, spread over its places.
void thin_out(std::vector<wire::PlanPinRequest>& pins) {
  if (pins.size() <= wire::kMaxPlanPins) return;
  std::vector<wire::PlanPinRequest> kept;
  for (std::size_t i = 0; i < wire::kMaxPlanPins; ++i) kept.push_back(pins[i * pins.size() / wire::kMaxPlanPins]);
  pins = std::move(kept);
}

Status make_pins(const MapPinsOptions& options) {
  const auto stored = db::load_map(options.map);
  if (!stored) return pass_on(stored);
  const auto tracked = read_tracked(options.tracked);
  if (!tracked) return pass_on(tracked);
  const auto tour = tour_in(stored->map, options);
  if (!tour) return pass_on(tour);
  std::vector<wire::PlanPinRequest> pins = pins_of(stored->map, *tour, *tracked, options.most_spread_m);
  thin_out(pins);
  if (pins.size() < 2) {
    return fail(ErrorCode::kTooLittleSupport,
                "Of fewer than two places it is known well enough where on the plan they are.", options.tracked);
  }
  wire::PlanTieRequest request{wire::PlanId(options.plan), std::nullopt, std::move(pins)};
  if (options.version > 0) request.version = options.version;
  const std::string text = wire::plan_tie_to_json(request).dump(1) + "\n";
  if (options.out.empty()) {
    std::cout << text;
    return {};
  }
  if (const Status written = files::write_file(options.out, text); !written) return written;
  std::cout << request.pins.size() << " of " << stored->map.places.size() << " places: " << options.out << "\n";
  return {};
}

}  // namespace

void register_map_pins(CLI::App& map) {
  CLI::App* command = map.add_subcommand(
      "pins", "Where the places of a map lie on a drawn plan, by what homeward track says of its tour");
  const auto options = std::make_shared<MapPinsOptions>();
  command->add_option("--map", options->map, "Map file")->required();
  command
      ->add_option("--tracked", options->tracked,
                   "What homeward track --json printed of the pictures that the map was built from")
      ->required();
  command->add_option("--plan", options->plan, "Id of the plan on the server")->required();
  command->add_option("--version", options->version, "Version of the plan on the server; without it the newest")
      ->check(CLI::Range(1, 1000000));
  command->add_option("--tour", options->tour, "Tour of the map whose pictures were tracked, where it has several");
  command
      ->add_option("--spread-m", options->most_spread_m,
                   "Places whose pose is known less well than that (standard deviation) get no pin")
      ->check(CLI::Range(0.01, 10.0))
      ->capture_default_str();
  command->add_option("--out", options->out, "File to write; without it, to standard output");
  command->footer(
      "What it writes is the body of PUT /api/v1/maps/{map}/plan of the server, which the map is tied to the "
      "plan by.");
  run_on(*command, [options] { return make_pins(*options); });
}

}  // namespace homeward::cli
