// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <filesystem>

#include "db/map_file.hpp"
#include "db/recording.hpp"
#include "files/csv.hpp"
#include "files/grey_map.hpp"
#include "files/tour_folder.hpp"
#include "files/tour_scans.hpp"
#include "fuzz/targets/require.hpp"
#include "support/sample_map.hpp"
#include "support/sample_recording.hpp"
#include "support/scratch_folder.hpp"

namespace homeward::fuzz {
namespace {

std::string sound_map() {
  const testing::ScratchFolder folder;
  require(db::save_map(folder.path() / "sound.map", testing::sample_map(), {}).has_value(), "a map is written");
  return folder.text("sound.map");
}

std::string sound_recording() {
  const testing::ScratchFolder folder;
  {
    auto writer = db::RecordingWriter::create(folder.path() / "sound.hwrec", testing::sample_recording_header(),
                                              testing::sample_recorded_step(1).sweep);
    require(writer.has_value(), "a recording is begun");
    std::vector<db::RecordedStep> steps;
    for (int seq = 1; seq <= 4; ++seq) steps.push_back(testing::sample_recorded_step(seq));
    require((*writer)->append(steps).has_value(), "steps are written");
    require((*writer)->finish({true, "The mission ended."}).has_value(), "a recording is ended");
  }
  return folder.text("sound.hwrec");
}

void table_of(const std::string& text, const testing::ScratchFolder& folder) {
  const auto table = files::read_csv(folder.put("t.csv", text));
  require_value_or_sentence(table);
  if (!table) return;
  for (const auto& row : table->rows) require(row.size() == table->columns.size(), "a field for each column");
}

void grey_map_of(const std::string& text, const testing::ScratchFolder& folder) {
  const auto image = files::read_grey_map(folder.put("m.pgm", text));
  require_value_or_sentence(image);
  if (!image) return;
  const auto pixels = static_cast<std::int64_t>(image->width_px) * image->height_px;
  require(static_cast<std::int64_t>(image->data.size()) == pixels, "a byte for each pixel");
}

void tour_of(const std::string& text, const testing::ScratchFolder& folder, const std::string& name) {
  folder.put("a.jpg", "never read here");
  folder.put("b.jpg", "never read here");
  folder.put(name, text);
  const auto tour = files::TourFolder::open(folder.path());
  require_value_or_sentence(tour);
  if (!tour) return;
  for (const auto& image : tour->images()) {
    require(!image.odometry || std::isfinite(image.odometry->x_m), "odometry is finite");
  }
}

}  // namespace

void tables(Input input) {
  const Choice choice = choose(input, 6);
  const std::string text = choice.text();
  const testing::ScratchFolder folder;
  switch (choice.which) {
    case 0:
      return table_of(text, folder);
    case 1:
      return grey_map_of(text, folder);
    case 2:
      return tour_of(text, folder, "times.csv");
    case 3:
      return tour_of(text, folder, "odometry.csv");
    case 4:
      return tour_of(text, folder, "tour.json");
    default:
      folder.put("scans.json", R"({"format":"homeward-scans","version":1,"angle_min_rad":-1.5,"angle_step_rad":1.5,)"
                               R"("range_max_m":12,"robot_from_scan":{"x_m":0,"y_m":0,"theta_rad":0}})");
      folder.put("scans.csv", text);
      return require_value_or_sentence(files::read_scans(folder.path()));
  }
}

void map_files(Input input) {
  static const std::string sound = sound_map();
  const testing::ScratchFolder folder;
  const std::string text = changed(sound, input);
  const auto loaded = db::load_map(folder.put("m.map", text));
  require(folder.text("m.map") == text && folder.count() == 1, "reading leaves the file as it is");
  require_value_or_sentence(loaded);
  if (!loaded) return;
  require(!loaded->map.places.empty(), "a map has places");
  require_value_or_sentence(db::save_map(folder.path() / "again.map", loaded->map, loaded->thumbnails));
}

void recordings(Input input) {
  static const std::string sound = sound_recording();
  const testing::ScratchFolder folder;
  const std::string text = changed(sound, input);
  const Status read = testing::read_whole_recording(folder.put("r.hwrec", text));
  require(folder.text("r.hwrec") == text, "reading leaves the file as it is");
  if (!read) require_sentence(read.error());
}

}  // namespace homeward::fuzz
