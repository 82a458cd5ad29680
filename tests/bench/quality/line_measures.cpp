// SPDX-License-Identifier: Apache-2.0
// homeward_bench_line_measures TOUR PLAN [EVERY]: how the measures of localisation on a drawn plan fall off beside the
// true pose. TOUR is a folder of pictures with camera.json and poses.csv in the plan's frame, PLAN a .wrl; every
// EVERYth picture is looked at. A row of Markdown for each measure and setting, then milliseconds (of one
// processor, medians over pictures) of an update's parts.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "core/angles.hpp"
#include "files/csv.hpp"
#include "files/read_file.hpp"
#include "files/tour_folder.hpp"
#include "linemodel/plan_tracker.hpp"
#include "linemodel/read_plan.hpp"

namespace homeward::bench {
namespace {

using linemodel::LineMeasure;
using linemodel::MeasureConfig;

constexpr std::array<double, 5> kOff_m{0.05, 0.1, 0.2, 0.5, 1.0};
constexpr std::array<double, 4> kOff_deg{1.0, 2.0, 5.0, 20.0};
constexpr int kAnywhere = 100;  // poses anywhere for each picture
constexpr int kPoses = 1000;    // for timing

struct Setting {
  std::string name;
  MeasureConfig config;
};

std::vector<Setting> settings() {
  std::vector<Setting> all;
  const auto add = [&](const std::string& name, LineMeasure measure, double MeasureConfig::*what, double value) {
    MeasureConfig config;
    config.measure = measure;
    config.*what = value;
    all.push_back({name, config});
  };
  for (const double tolerance : {0.0125, 0.025, 0.05, 0.1}) {
    add("match count, tolerance " + std::to_string(tolerance).substr(0, 6), LineMeasure::kCentredMatchCount,
        &MeasureConfig::tolerance_rad, tolerance);
  }
  for (const double cell : {0.035, 0.07, 0.14}) {
    add("length match, cell " + std::to_string(cell).substr(0, 5), LineMeasure::kGridLengthMatch,
        &MeasureConfig::cell_rad, cell);
  }
  for (const double spread : {0.015, 0.03, 0.06}) {
    add("distance transform, spread " + std::to_string(spread).substr(0, 5), LineMeasure::kDistanceTransform,
        &MeasureConfig::spread_rad, spread);
  }
  add("match odds", LineMeasure::kMatchOdds, &MeasureConfig::true_match, 0.85);
  return all;
}

struct Falloff {
  double here = 0.0;
  std::array<double, kOff_m.size()> by_m{};
  std::array<double, kOff_deg.size()> by_deg{};
  double anywhere = 0.0;
  std::vector<double> ms_1000;  // of each picture
  double unused = 0.0;          // so that what is timed is done
};

/// Of processor time, which a busy machine lengthens less than it does the clock's.
double ms_since(std::clock_t begin) { return 1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC; }

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

/// What a plan lets expect, as a tracker asks for it.
struct Asked {
  linemodel::VisibleLines visible;
  linemodel::Expectation expectation;
  linemodel::ExpectedView view;

  const linemodel::ExpectedView& at(const Pose2& pose, LineMeasure measure) {
    const auto around = visible.around(expectation.eye_m(pose).head<2>());
    expectation.expect(pose, around, view, measure == LineMeasure::kDistanceTransform);
    return view;
  }
};

/// What one picture adds.
void add_picture(linemodel::PlanTracker& tracker, Asked& asked, LineMeasure measure,
                 const linemodel::PictureLines& lines, const Pose2& truth, std::mt19937_64& random, Falloff& sums) {
  const auto score = [&](const Pose2& pose) { return lines.score(tracker.expected(pose)); };
  sums.here += score(truth);
  for (std::size_t i = 0; i < kOff_m.size(); ++i) {
    for (int k = 0; k < 8; ++k) {
      const double way = 0.25 * kPi * k;
      sums.by_m[i] +=
          score({truth.x_m + kOff_m[i] * std::cos(way), truth.y_m + kOff_m[i] * std::sin(way), truth.theta_rad}) / 8.0;
    }
  }
  for (std::size_t i = 0; i < kOff_deg.size(); ++i) {
    for (const double side : {-1.0, 1.0}) {
      sums.by_deg[i] += 0.5 * score({truth.x_m, truth.y_m, truth.theta_rad + side * radians(kOff_deg[i])});
    }
  }
  const auto& points_m = tracker.floor().free_points_m();
  for (int k = 0; k < kAnywhere; ++k) {
    const Eigen::Vector2d& point_m = points_m[random() % points_m.size()];
    sums.anywhere += score({point_m.x(), point_m.y(), 0.01 * static_cast<double>(random() % 628)}) / kAnywhere;
  }
  const auto begin = std::clock();
  double sum = 0.0;
  for (int k = 0; k < kPoses; ++k) {
    sum += lines.score(asked.at({truth.x_m + 1e-4 * k, truth.y_m, truth.theta_rad}, measure));
  }
  sums.unused += sum;
  sums.ms_1000.push_back(ms_since(begin));
}

Result<std::map<std::string, Pose2>> poses_of(const std::filesystem::path& folder) {
  const auto table = files::read_csv(folder / "poses.csv");
  if (!table) return pass_on(table);
  std::map<std::string, Pose2> poses;
  for (const auto& row : table->rows) poses[row[0]] = {std::stod(row[1]), std::stod(row[2]), std::stod(row[3])};
  return poses;
}

void print(const std::string& name, const Falloff& sums, double count) {
  std::printf("| %s | %.3f |", name.c_str(), sums.here / count);
  for (const double score : sums.by_m) std::printf(" %.3f |", score / count);
  for (const double score : sums.by_deg) std::printf(" %.3f |", score / count);
  std::printf(" %.3f | %.1f |\n", sums.anywhere / count, median(sums.ms_1000));
}

Status measure(const std::filesystem::path& folder, const std::string& plan_file, std::size_t every) {
  const auto bytes = files::read_text(plan_file);
  if (!bytes) return pass_on(bytes);
  const auto plan = linemodel::read_plan(*bytes, "wrl", {}, plan_file);
  if (!plan) return pass_on(plan);
  const auto config = files::read_camera(folder / "camera.json");
  if (!config) return pass_on(config);
  const auto truth = poses_of(folder);
  if (!truth) return pass_on(truth);
  const auto pictures = files::pictures_in(folder);
  if (!pictures) return pass_on(pictures);
  const auto camera = camera::Camera::create(*config);
  if (!camera) return pass_on(camera);
  auto tracker = linemodel::PlanTracker::create(*plan, *config, {});
  if (!tracker) return pass_on(tracker);
  const linemodel::LineViews views(**camera);
  const linemodel::HoughSpace space(*config);
  Asked asked{{*plan, config->robot_from_camera_translation_m.z(), {}}, linemodel::Expectation(**camera), {}};
  const std::vector<Setting> all = settings();
  std::vector<Falloff> sums(all.size());
  double count = 0.0;
  std::vector<double> detect_ms;
  std::mt19937_64 random(1);
  for (std::size_t i = 0; i < pictures->size(); i += every) {
    const auto picture = files::read_picture((*pictures)[i]);
    if (!picture) return pass_on(picture);
    const auto begin = std::clock();
    const auto lines = linemodel::detect_lines(*picture, views, {});
    if (!lines) return pass_on(lines);
    detect_ms.push_back(ms_since(begin));
    for (std::size_t k = 0; k < sums.size(); ++k) {
      const MeasureConfig& setting = all[k].config;
      add_picture(*tracker, asked, setting.measure, linemodel::PictureLines(*lines, space, setting),
                  truth->at((*pictures)[i].filename().string()), random, sums[k]);
    }
    count += 1.0;
  }
  for (std::size_t k = 0; k < sums.size(); ++k) print(all[k].name, sums[k], count);
  std::printf("%.0f pictures; edges of a picture: %.1f ms\n", count, median(detect_ms));
  return {};
}

}  // namespace
}  // namespace homeward::bench

int main(int count, char** arguments) {
  if (count < 3) {
    std::fprintf(stderr, "homeward_bench_line_measures TOUR PLAN [EVERY]\n");
    return 2;
  }
  const std::size_t every = count > 3 ? std::stoul(arguments[3]) : 10;
  const homeward::Status measured = homeward::bench::measure(arguments[1], arguments[2], every);
  if (!measured) std::fprintf(stderr, "%s: %s\n", measured.error().where.c_str(), measured.error().message.c_str());
  return measured ? 0 : 1;
}
