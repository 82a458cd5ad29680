// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>

#include "cli/command.hpp"
#include "cli/map.hpp"
#include "cli/map_output.hpp"
#include "db/map_file.hpp"
#include "files/read_file.hpp"
#include "files/write_file.hpp"
#include "map/parts.hpp"
#include "pipeline/build_map.hpp"
#include "pipeline/report/report_page.hpp"
#include "wire/build_json.hpp"
#include "wire/map_reasons.hpp"

namespace homeward::cli {
namespace {

struct MapBuildOptions {
  std::vector<std::string> tours;  // folders
  std::string camera;
  std::string out;
  std::string add_to;  // map file
  std::string name;
  std::string report;  // folder
  int report_pictures = 60;
  int threads = 0;
  std::uint64_t seed = 1;
  bool json = false;
};

/// Returns the file.
Result<std::string> write_report(const MapBuildOptions& options, const pipeline::BuiltMap& built,
                                 const TourFolders& tours) {
  pipeline::ReportOptions report{pipeline::report_date(now_us()), options.report_pictures, options.threads,
                                 options.seed};
  for (const map::TourWarning& warning : built.notes.warnings) {
    report.warnings.push_back({wire::english(wire::reason_of(warning)), warning.image.str()});
  }
  const auto page = pipeline::report_page(built, tours.sources(), report);
  if (!page) return pass_on(page);
  const std::filesystem::path file = std::filesystem::path(options.report) / "report.html";
  if (const Status written = files::write_file(file, *page); !written) return pass_on(written);
  return file.string();
}

void tell_notes(const pipeline::BuildNotes& notes) {
  for (const Error& skipped : notes.skipped) {
    tell({skipped.code, "A picture was left out. " + skipped.message, skipped.where});
  }
  if (!notes.skipped.empty()) {
    const std::size_t all = notes.skipped.size() + notes.appearances.size();
    tell({ErrorCode::kInvalidInput,
          std::to_string(notes.skipped.size()) + " of " + std::to_string(all) +
              " pictures were left out; the map is made of the others.",
          {}});
  }
  for (const map::TourWarning& warning : notes.warnings) {
    tell({ErrorCode::kInvalidInput, "Warning: " + wire::english(wire::reason_of(warning)), warning.image.str()});
  }
}

/// Where a robot is likely to fail, and what was done about it.
void tell_of_weak_edges(const mapping::MappingNotes& notes) {
  if (notes.weak_before == 0) return;
  std::cout << notes.weak_before << " pairs of neighbouring places hardly see each other: " << notes.extra.size()
            << " extra places put between them, " << notes.weak_after << " pairs left without a sound way\n";
}

Status build(const MapBuildOptions& options) {
  const auto tours = TourFolders::open(options.tours);
  if (!tours) return pass_on(tours);
  if (!options.add_to.empty()) {
    return add_to_map({options.add_to, options.camera, options.out, options.threads, options.seed, options.json},
                      *tours);
  }
  if (options.camera.empty()) return fail(ErrorCode::kInvalidInput, "A new map needs its camera.", "--camera");
  const auto camera = files::read_camera(options.camera);
  if (!camera) return pass_on(camera);
  if (!options.report.empty()) {  // before the work: a folder that cannot be made is not told after it
    if (Status made = files::make_folder(options.report); !made) return made;
  }
  const auto begin = std::chrono::steady_clock::now();
  Result<pipeline::BuiltMap> built;
  {
    ProgressBar bar;
    const pipeline::BuildOptions build_options{options.name, options.threads, options.seed};
    built = pipeline::build_noted_map(tours->sources(), *camera, build_options, nullptr,
                                      [&](const pipeline::BuildProgress& at) { bar.show(at.stage, at.share); });
  }
  if (!built) {
    Error error = built.error();
    if (error.where.empty()) error.where = options.tours.front();
    return tl::unexpected<Error>(error);
  }
  map::TopologicalMap& map = built->map;
  map.build_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  db::Thumbnails thumbnails;
  if (Status made = add_thumbnails(map, *tours, thumbnails); !made) return made;
  if (const Status saved = db::save_map(options.out, map, thumbnails); !saved) return saved;
  wire::BuildView view{options.out, {}, built->notes.skipped, built->notes.warnings};
  tell_notes(built->notes);
  if (!options.json) {
    std::cout << summary(map) << ": " << options.out << "\n" << map::tell_parts(map::parts(map));
    tell_of_weak_edges(built->notes.mapping);
  }
  if (!options.report.empty()) {
    const auto report = write_report(options, *built, *tours);
    if (!report) return pass_on(report);
    view.report = *report;
    if (!options.json) std::cout << "report: " << *report << "\n";
  }
  if (options.json) print_json(wire::build_to_json(view, map));
  return {};
}

}  // namespace

void register_map_build(CLI::App& map) {
  CLI::App* command = map.add_subcommand("build", "Build a map from the pictures of tours, or add tours to a map");
  const auto options = std::make_shared<MapBuildOptions>();
  command->add_option("--tour", options->tours, "Folder of a tour's pictures; once for each tour")
      ->required()
      ->allow_extra_args(false);
  command->add_option("--camera", options->camera, "camera.json; with --add-to only when it is not the map's camera");
  command->add_option("--out", options->out, "Map file to write")->required();
  auto* add_to = command->add_option("--add-to", options->add_to,
                                     "Map file that the tours join: it keeps its places, names and decisions, and "
                                     "stays as it is unless --out names it");
  command->add_option("--name", options->name, "Name of the map")->excludes(add_to);
  command->add_flag("--json", options->json, "Print one JSON object, with the pictures left out and why");
  command
      ->add_option("--report", options->report,
                   "Folder for report.html: one page on the map and how it came about, to read and to print")
      ->excludes(add_to);
  command
      ->add_option("--report-pictures", options->report_pictures,
                   "Loop hypotheses that the report shows in pictures, the least certain first")
      ->check(CLI::Range(0, 10000))
      ->capture_default_str();
  command->add_option("--threads", options->threads, "Threads (0: as many as the machine has)")
      ->check(CLI::Range(0, 256));
  command->add_option("--seed", options->seed, "Seed of everything random");
  command->footer(
      "Pictures that cannot be read are left out and named on standard error. A tour whose pictures all show one view, "
      "are out of order or come from two cameras is refused.");
  run_on(*command, [options] { return build(*options); });
}

}  // namespace homeward::cli
