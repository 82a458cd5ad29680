// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>

#include "cli/bench.hpp"
#include "sim/generate/laboratory.hpp"
#include "sim/random.hpp"
#include "sim/renderer.hpp"

namespace homeward::cli {
namespace {

constexpr double kStep_m = 0.3;  // between neighbours in the test row, and between rows
constexpr int kTrainingEvery = 3;

/// A set of pictures in the manner of the thesis's database: what the room was like when they were taken.
struct PictureSet {
  std::string name;
  sim::LaboratoryState state;
};

PictureSet original() { return {"original", {true, false, false, 0.0, 0}}; }

/// The sets of the second experiment. The first four are the thesis's; the furniture of the others was moved.
std::vector<PictureSet> changed_sets() {
  constexpr double kDusk = 1.6;
  return {original(),
          {"night", {false, true, false, 0.0, 0}},
          {"twilight", {false, true, false, kDusk, 0}},
          {"winlit", {true, false, true, 0.0, 0}},
          {"moved", {true, false, false, 0.0, 1}},
          {"moved_night", {false, true, false, 0.0, 1}},
          {"moved_winlit", {true, false, true, 0.0, 1}}};
}

nlohmann::json to_json(const sim::LaboratoryState& state, std::uint64_t room_seed) {
  return {{"room_seed", room_seed},       {"curtains_drawn", state.curtains_drawn},
          {"door_open", state.door_open}, {"only_window_lamps", state.only_window_lamps},
          {"daylight", state.daylight},   {"arrangement", state.arrangement}};
}

/// Takes the rows of one room in one state.
class Photographer {
 public:
  Photographer(std::uint64_t room_seed, PictureSet set, std::shared_ptr<const camera::Camera> camera,
               const RowSink& keep)
      : room_seed_(room_seed), set_(std::move(set)), keep_(keep) {
    world_ = std::make_unique<sim::LitWorld>(sim::generate_laboratory(room_seed, set_.state));
    const sim::LightSettings settings = sim::laboratory_light(set_.state);
    auto light = std::make_shared<const sim::Irradiance>(
        sim::compute_irradiance(world_->fine_scene(), world_->rays(), world_->world().lamps, settings));
    renderer_ = std::make_unique<sim::Renderer>(*world_, settings, std::move(light), std::move(camera));
  }

  /// Every `every`-th of `count` places along row number `across`. The same place gives the same picture.
  [[nodiscard]] Result<pipeline::PictureRow> take(const std::string& suffix, int across, int count, int every) const {
    pipeline::PictureRow row{set_.name + "_" + std::to_string(across) + suffix, {}, {}};
    std::vector<Pose2> poses;
    for (int i = 0; i < count; i += every) {
      // The measures are to be blind to the robot's heading: each picture has its own.
      const std::uint64_t key = room_seed_ * 1'000'003 + static_cast<std::uint64_t>(across * 100 + i);
      sim::Random random(key);
      const double theta_rad = sim::uniform(random, -std::numbers::pi, std::numbers::pi);
      poses.push_back(sim::laboratory_point(i * kStep_m, across * kStep_m, theta_rad));
      row.along_m.push_back(i * kStep_m);
      row.pictures.push_back(renderer_->render(poses.back(), {}, key));
    }
    if (!keep_) return row;
    const Status kept =
        keep_("room_" + std::to_string(room_seed_), row, poses, to_json(set_.state, room_seed_).dump(2));
    if (!kept) return pass_on(kept);
    return row;
  }

 private:
  std::uint64_t room_seed_;
  PictureSet set_;
  const RowSink& keep_;
  std::unique_ptr<sim::LitWorld> world_;
  std::unique_ptr<sim::Renderer> renderer_;
};

/// Adds the shares of one room to the means over `rooms`.
void add(std::vector<BenchLine>& lines, std::size_t first, const std::vector<std::vector<pipeline::RowScore>>& scores,
         int rooms) {
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::vector<pipeline::RowScore>& of_row = scores[first + i];
    lines[i].localised.resize(of_row.size());
    lines[i].filtered.resize(of_row.size());
    for (std::size_t m = 0; m < of_row.size(); ++m) {
      lines[i].localised[m] += of_row[m].alone / rooms;
      lines[i].filtered[m] += of_row[m].filtered / rooms;
    }
  }
}

/// Adds the curves of one room to the means over `rooms`.
void add(BenchCurves& curves, const std::vector<double>& along_m, const std::vector<std::vector<double>>& of_room,
         int rooms) {
  curves.along_m = along_m;
  curves.dissimilarities.resize(of_room.size(), std::vector<double>(along_m.size(), 0.0));
  for (std::size_t m = 0; m < of_room.size(); ++m) {
    for (std::size_t i = 0; i < along_m.size(); ++i) curves.dissimilarities[m][i] += of_room[m][i] / rooms;
  }
}

}  // namespace

Result<BenchTables> bench_localise(const LocaliseBench& bench, const camera::CameraConfig& config, const RowSink& keep,
                                   const std::function<void(double)>& progress) {
  auto camera = camera::Camera::create(config);
  if (!camera) return pass_on(camera);
  const auto eye = pipeline::Eye::create(config, pipeline::suited_feature_config(**camera));
  if (!eye) return pass_on(eye);
  const auto measures = pipeline::row_measures(bench.seed);
  BenchTables tables;
  for (const pipeline::RowMeasure& measure : measures) tables.measures.push_back(measure.name);
  for (int row = 0; row < bench.rows; ++row)
    tables.distances.push_back({"original_" + std::to_string(row), row * kStep_m, {}, {}});
  const std::vector<PictureSet> sets = changed_sets();
  for (const PictureSet& set : sets) tables.changes.push_back({set.name + "_1", kStep_m, {}, {}});
  const double steps = static_cast<double>(bench.rooms) * static_cast<double>(sets.size());
  double done = 0.0;
  for (int room = 0; room < bench.rooms; ++room) {
    const std::uint64_t room_seed = bench.seed + static_cast<std::uint64_t>(room);
    std::optional<pipeline::PictureRow> tests;
    std::vector<pipeline::PictureRow> training;
    const auto photograph = [&](const Photographer& photographer, int across) -> Status {
      auto row = photographer.take("", across, bench.pictures, kTrainingEvery);
      if (!row) return pass_on(row);
      training.push_back(std::move(*row));
      return {};
    };
    for (const PictureSet& set : sets) {
      const Photographer photographer(room_seed, set, *camera, keep);
      if (!tests) {  // the first set is the original one, which the first experiment is about
        auto row = photographer.take("_test", 0, bench.pictures, 1);
        if (!row) return pass_on(row);
        tests = std::move(*row);
        for (int across = 0; across < bench.rows; ++across) {
          if (const Status taken = photograph(photographer, across); !taken) return pass_on(taken);
        }
      }
      if (const Status taken = photograph(photographer, 1); !taken) return pass_on(taken);
      progress(++done / steps);
    }
    const auto found = pipeline::localise_rows(*tests, training, *eye, measures);
    if (!found) return pass_on(found);
    add(tables.distances, 0, found->scores, bench.rooms);
    add(tables.changes, tables.distances.size(), found->scores, bench.rooms);
    add(tables.curves, tests->along_m, found->curves, bench.rooms);
  }
  return tables;
}

}  // namespace homeward::cli
