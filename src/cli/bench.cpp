// SPDX-License-Identifier: Apache-2.0
#include "cli/bench.hpp"

#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "cli/command.hpp"
#include "cli/simulate.hpp"
#include "files/write_file.hpp"
#include "imageio/decode.hpp"
#include "wire/camera_json.hpp"

namespace homeward::cli {

namespace fs = std::filesystem;

namespace {

struct BenchOptions {
  LocaliseBench bench;
  std::string camera = "hyperbolic_mirror";
  std::string out;
  bool json = false;
};

/// Writes rows as folders of PNG pictures with poses.csv, camera.json and condition.json.
RowSink folder_sink(const fs::path& out, const camera::CameraConfig& camera) {
  auto written = std::make_shared<std::set<std::string>>();
  return [=](const std::string& room, const pipeline::PictureRow& row, const std::vector<Pose2>& poses,
             const std::string& condition) -> Status {
    const fs::path folder = out / room / row.name;
    if (!written->insert(folder.string()).second) return {};  // original_1 belongs to both experiments
    if (const Status made = files::make_folder(folder); !made) return made;
    std::string table = "filename,x_m,y_m,theta_rad,room\n";
    for (std::size_t i = 0; i < row.pictures.size(); ++i) {
      char line[120];
      std::snprintf(line, sizeof line, "%05zu.png,%.4f,%.4f,%.5f,laboratory\n", i, poses[i].x_m, poses[i].y_m,
                    poses[i].theta_rad);
      table += line;
      const auto png = imageio::encode_png(row.pictures[i]);
      const std::string name = std::string(line).substr(0, 9);
      const Status kept = files::write_file(folder / name, {reinterpret_cast<const char*>(png.data()), png.size()});
      if (!kept) return kept;
    }
    for (const auto& [name, text] : {std::pair<std::string, std::string>{"poses.csv", table},
                                     {"camera.json", wire::camera_to_json(camera).dump(2) + "\n"},
                                     {"condition.json", condition + "\n"}}) {
      if (const Status kept = files::write_file(folder / name, text); !kept) return kept;
    }
    return {};
  };
}

Status run(const BenchOptions& options) {
  const LocaliseBench& bench = options.bench;
  const auto config = camera_named(options.camera);
  if (!config) return pass_on(config);
  RowSink keep;
  if (!options.out.empty()) {
    std::error_code error;
    if (fs::exists(options.out, error) && !fs::is_empty(options.out, error)) {
      return fail(ErrorCode::kConflict, "The folder holds something already; name a new or empty one.", options.out);
    }
    if (const Status made = files::make_folder(options.out); !made) return made;
    keep = folder_sink(options.out, *config);
  }
  auto bar = std::make_unique<ProgressBar>();
  const auto tables = bench_localise(bench, *config, keep, [&](double share) { bar->show("rooms", share); });
  bar.reset();
  if (!tables) return pass_on(tables);
  if (!options.out.empty()) {
    const fs::path out(options.out);
    for (const auto& [name, text] : {std::pair<std::string, std::string>{"tables.txt", text_of(*tables, bench)},
                                     {"tables.json", json_of(*tables, bench)},
                                     {"curves.csv", curves_csv(*tables)},
                                     {"curves.svg", curves_svg(*tables)}}) {
      if (const Status kept = files::write_file(out / name, text); !kept) return kept;
    }
  }
  std::cout << (options.json ? json_of(*tables, bench) : text_of(*tables, bench));
  return {};
}

}  // namespace

void register_bench_localise(CLI::App& bench) {
  CLI::App* command = bench.add_subcommand(
      "localise",
      "Which measure finds the nearest training picture: rows further and further apart, and in changed "
      "light and with moved furniture (Ferdaus 2008, tables 3.2 and 3.3), each picture alone and with a filter along "
      "the "
      "row, and how different pictures are by how far they are apart (its figure 3.6), in generated rooms");
  const auto options = std::make_shared<BenchOptions>();
  command->add_option("--rooms", options->bench.rooms, "Rooms; the shares are means over them")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  command->add_option("--rows", options->bench.rows, "Training rows, 0.3 m apart")
      ->check(CLI::Range(1, 7))
      ->capture_default_str();
  command->add_option("--pictures", options->bench.pictures, "Pictures in the test row, 0.3 m apart")
      ->check(CLI::Range(2, 16))
      ->capture_default_str();
  command->add_option("--camera", options->camera, "hyperbolic_mirror, equirectangular, pinhole or a camera.json")
      ->capture_default_str();
  command->add_option("--seed", options->bench.seed, "Seed of rooms, headings, noise and verification")
      ->capture_default_str();
  command->add_option("--out", options->out,
                      "New folder that keeps the pictures with their poses, the tables and the curves");
  command->add_flag("--json", options->json, "One JSON object instead of tables");
  run_on(*command, [options] { return run(*options); });
}

void register_bench(CLI::App& program) {
  CLI::App* bench = program.add_subcommand("bench", "Experiments that measure the methods");
  bench->require_subcommand(1);
  register_bench_localise(*bench);
}

}  // namespace homeward::cli
