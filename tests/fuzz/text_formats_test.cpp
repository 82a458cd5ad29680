// SPDX-License-Identifier: Apache-2.0
// Damaged JSON and tables: each is read or refused with a sentence and a place, and what is read can be written again.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "camera/camera.hpp"
#include "files/csv.hpp"
#include "files/grey_map.hpp"
#include "files/tour_folder.hpp"
#include "files/tour_scans.hpp"
#include "fuzz/mutate.hpp"
#include "support/folders.hpp"
#include "support/scratch_folder.hpp"
#include "wire/camera_json.hpp"
#include "wire/edit_json.hpp"
#include "wire/json_reader.hpp"
#include "wire/rosbridge_json.hpp"
#include "wire/scans_json.hpp"
#include "wire/scenario_json.hpp"
#include "wire/world_json.hpp"

namespace homeward::text_formats_test {
namespace {

using testing::Mutator;
using testing::ScratchFolder;

std::vector<std::string> examples(const std::string& kind) {
  auto texts = testing::texts_in(testing::project_folder() / "proto/examples" / kind / "valid");
  EXPECT_FALSE(texts.empty());
  return texts;
}

void expect_message(const Error& error, const std::string& input) {
  EXPECT_GT(error.message.size(), 8U) << input;
  EXPECT_EQ(error.message.find('\n'), std::string::npos) << error.message;
  EXPECT_FALSE(error.where.empty()) << error.message;
  EXPECT_NE(error.code, ErrorCode::kInternal) << input;
  EXPECT_TRUE(wire::is_utf8(error.message)) << input;
}

/// Parses `rounds` damaged copies of each example; returns how many of them were still readable.
template <class Parse>
int fuzz(const std::string& kind, int rounds, const Parse& parse) {
  Mutator mutator(std::hash<std::string>{}(kind));
  int readable = 0;
  for (const std::string& example : examples(kind)) {
    EXPECT_TRUE(parse(example)) << example;
    for (int i = 0; i < rounds; ++i) {
      const std::string text = mutator.damaged(example);
      const auto value = parse(text);
      readable += value ? 1 : 0;
      if (!value) expect_message(value.error(), text);
    }
  }
  return readable;
}

TEST(FuzzTexts, Camera) {
  fuzz("camera", 2000, [](const std::string& text) {
    auto camera = wire::parse_camera(text, "camera.json");
    if (camera) {
      EXPECT_TRUE(camera::problems(*camera).empty()) << text;
    }
    return camera;
  });
}

TEST(FuzzTexts, Scans) {
  fuzz("scans", 1000, [](const std::string& text) { return wire::parse_scans(text, "scans.json"); });
  fuzz("sweep", 1000, [](const std::string& text) -> Result<RangeSweep> {
    const auto value = wire::parse_json(text, "body");
    return value ? wire::sweep_from_json(*value, "body") : pass_on(value);
  });
  const std::string about = examples("scans").front();
  Mutator mutator(7);
  for (int i = 0; i < 300; ++i) {
    const ScratchFolder folder;
    folder.put("scans.json", about);
    folder.put("scans.csv", mutator.damaged("filename,r0,r1\n00000.jpg,1.25,12.000\n00001.jpg,,0.5\n"));
    const auto sweeps = files::read_scans(folder.path());
    if (!sweeps) expect_message(sweeps.error(), folder.text("scans.csv"));
  }
}

TEST(FuzzTexts, World) {
  fuzz("world", 2000, [](const std::string& text) { return wire::parse_world(text, "world.json"); });
}

TEST(FuzzTexts, Scenario) {
  fuzz("scenario", 2000, [](const std::string& text) { return wire::parse_scenario(text, "scenario.json"); });
}

TEST(FuzzTexts, Rosbridge) {
  fuzz("rosbridge", 2000, [](const std::string& text) { return wire::parse_rosbridge(text, "robot.json"); });
}

TEST(FuzzTexts, Edits) {
  fuzz("edits", 2000, [](const std::string& text) -> Result<std::vector<wire::EditRequest>> {
    const auto json = wire::parse_json(text, "body");
    if (!json) return pass_on(json);
    auto edits = wire::edits_from_json(*json);
    if (edits) {
      EXPECT_TRUE(wire::edits_from_json(wire::edits_to_json(*edits))) << text;
    }
    return edits;
  });
}

TEST(FuzzTexts, DeepNestingIsRefused) {
  for (const char* open : {"[", "{\"a\":"}) {
    std::string text;
    for (int i = 0; i < 200'000; ++i) text += open;
    EXPECT_FALSE(wire::parse_camera(text, "camera.json"));
    EXPECT_FALSE(wire::parse_scenario(text, "scenario.json"));
  }
}

TEST(FuzzTexts, Csv) {
  const ScratchFolder folder;
  Mutator mutator(3);
  const std::string good = "filename,t_us\n00000.jpg,1000000\n00001.jpg,1100000\n\n00002.jpg,1200000\n";
  for (int i = 0; i < 1500; ++i) {
    const std::string text = mutator.damaged(good);
    const auto table = files::read_csv(folder.put("t.csv", text));
    if (!table) {
      expect_message(table.error(), text);
      continue;
    }
    for (const auto& row : table->rows) EXPECT_EQ(row.size(), table->columns.size()) << text;
  }
}

TEST(FuzzTexts, GreyMap) {
  const ScratchFolder folder;
  Mutator mutator(4);
  const std::string good = "P5\n# floor\n7 5\n255\n" + std::string(35, '\x7f');
  for (int i = 0; i < 1500; ++i) {
    const std::string text = mutator.damaged(good);
    const auto image = files::read_grey_map(folder.put("m.pgm", text));
    if (!image) {
      expect_message(image.error(), text);
      continue;
    }
    EXPECT_EQ(image->data.size(),
              static_cast<std::size_t>(image->width_px) * static_cast<std::size_t>(image->height_px));
  }
}

TEST(FuzzTexts, TourFolder) {
  const ScratchFolder folder;
  folder.put("a.jpg", "never read here");
  folder.put("b.jpg", "never read here");
  Mutator mutator(5);
  for (int i = 0; i < 800; ++i) {
    folder.put("times.csv", mutator.damaged("filename,t_us\na.jpg,1000000\nb.jpg,1100000\n"));
    folder.put("odometry.csv", mutator.damaged("t_us,x_m,y_m,theta_rad\n900000,0,0,0\n1200000,1.5,-0.25,3.0\n"));
    folder.put("tour.json", mutator.damaged(R"({"marks":[{"image":"a.jpg","label":"kitchen"}]})"));
    const auto tour = files::TourFolder::open(folder.path());
    if (!tour) {
      expect_message(tour.error(), folder.text("times.csv") + folder.text("odometry.csv") + folder.text("tour.json"));
      continue;
    }
    for (const auto& image : tour->images()) {
      if (image.odometry) {
        EXPECT_TRUE(std::isfinite(image.odometry->x_m) && std::isfinite(image.odometry->theta_rad));
      }
    }
  }
}

}  // namespace
}  // namespace homeward::text_formats_test
