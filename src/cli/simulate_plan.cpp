// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "cli/command.hpp"
#include "cli/simulate.hpp"
#include "files/write_file.hpp"
#include "linemodel/feature_edges.hpp"
#include "linemodel/write_vrml.hpp"
#include "scenario/world_folder.hpp"
#include "sim/changed_objects.hpp"

namespace homeward::cli {
namespace {

struct SimulatePlanOptions {
  std::string world;
  std::string out;
  sim::ObjectChanges changes;
  bool json = false;
};

Status draw_plan(const SimulatePlanOptions& options) {
  if (std::filesystem::exists(options.out))
    return fail(ErrorCode::kConflict, "The plan's file is there already.", options.out);
  const auto world = scenario::load_world(options.world);
  if (!world) return pass_on(world);
  auto changed = sim::change_objects(*world, options.changes);
  if (!changed) return pass_on(changed);
  const linemodel::Plan plan =
      linemodel::plan_of_mesh(std::move(changed->scene.vertices_m), std::move(changed->scene.triangles));
  if (const Status written = files::write_file(options.out, linemodel::write_vrml(plan)); !written) return written;
  if (options.json) {
    std::cout << nlohmann::json{{"lines", plan.lines.size()},
                                {"triangles", plan.triangles.rows()},
                                {"objects", changed->objects},
                                {"missing", changed->missing},
                                {"moved", changed->moved}}
              << "\n";
    return {};
  }
  std::cout << plan.lines.size() << " lines, " << plan.triangles.rows() << " triangles; of " << changed->objects
            << " objects " << changed->missing << " left out, " << changed->moved << " moved: " << options.out << "\n";
  return {};
}

}  // namespace

void register_simulate_plan(CLI::App& simulate) {
  CLI::App* command =
      simulate.add_subcommand("plan", "A drawn plan of a world: its edges and what hides them, as a VRML file");
  const auto options = std::make_shared<SimulatePlanOptions>();
  command->add_option("--world", options->world, "house:SEED, offices:SEED, another generated world, or a world.json")
      ->required();
  command->add_option("--out", options->out, "File of the plan (.wrl); must not be there yet")->required();
  command->add_option("--missing", options->changes.missing_share, "Share of the objects that the plan leaves out")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  command
      ->add_option("--moved", options->changes.moved_share,
                   "Share of the objects that it has up to 1 m elsewhere, and turned")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  command->add_option("--seed", options->changes.seed, "Of which objects, and where to")->capture_default_str();
  command->add_flag("--json", options->json, "JSON on standard output");
  run_on(*command, [options] { return draw_plan(*options); });
}

}  // namespace homeward::cli
