// SPDX-License-Identifier: Apache-2.0
#include "scenario/shared_world.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <utility>

#include "files/write_file.hpp"

namespace homeward::scenario {
namespace {

namespace fs = std::filesystem;

constexpr const char* kEnding = ".robot";
constexpr int kVersion = 2;  // of the file: its version, the pose, the outline and the height
constexpr auto kGoneAfter = std::chrono::seconds(2);

std::string random_name() {
  std::random_device random;
  constexpr const char* kDigits = "0123456789abcdef";
  std::string name(16, '0');
  for (char& letter : name) letter = kDigits[random() % 16];
  return name;
}

std::optional<sim::Box> read_box(const fs::path& file) {
  constexpr double kLargest_m = 5.0;
  std::ifstream stream(file);
  int version = 0;
  sim::Box box;
  Outline& foot = box.foot;
  if (!(stream >> version >> box.pose.x_m >> box.pose.y_m >> box.pose.theta_rad >> foot.radius_m >> foot.back_m >>
        foot.front_m >> foot.side_m >> box.height_m) ||
      version != kVersion)
    return std::nullopt;
  const auto length = [](double value_m) { return value_m >= 0.0 && value_m <= kLargest_m; };
  const bool sound = std::isfinite(box.pose.x_m) && std::isfinite(box.pose.y_m) && std::isfinite(box.pose.theta_rad) &&
                     length(foot.radius_m) && length(foot.back_m) && length(foot.front_m) && length(foot.side_m) &&
                     box.height_m > 0.0 && length(box.height_m) && swept_radius_m(foot) > 0.0;
  return sound ? std::optional(box) : std::nullopt;
}

}  // namespace

Result<SharedWorld> SharedWorld::join(const fs::path& folder) {
  if (const Status made = files::make_folder(folder); !made) return pass_on(made);
  return SharedWorld(folder / (random_name() + kEnding));
}

SharedWorld::SharedWorld(SharedWorld&& other) noexcept : file_(std::exchange(other.file_, {})) {}

SharedWorld::~SharedWorld() {
  std::error_code ignored;
  if (!file_.empty()) fs::remove(file_, ignored);
}

std::vector<sim::Box> SharedWorld::exchange(const sim::Box& ours) {
  std::error_code error;
  // Whole or not at all, but not safe from a power cut: that would take a while.
  fs::path part = file_;
  part += ".part";
  {
    std::ofstream stream(part, std::ios::trunc);
    stream.precision(std::numeric_limits<double>::max_digits10);
    stream << kVersion << ' ' << ours.pose.x_m << ' ' << ours.pose.y_m << ' ' << ours.pose.theta_rad << ' '
           << ours.foot.radius_m << ' ' << ours.foot.back_m << ' ' << ours.foot.front_m << ' ' << ours.foot.side_m
           << ' ' << ours.height_m << '\n';
  }
  fs::rename(part, file_, error);
  std::vector<fs::path> others;
  for (fs::directory_iterator at(file_.parent_path(), error); !error && at != fs::directory_iterator();
       at.increment(error))
    if (at->path().extension() == kEnding && at->path() != file_) others.push_back(at->path());
  std::ranges::sort(others);
  std::vector<sim::Box> boxes;
  for (const fs::path& other : others) {
    const auto told = fs::last_write_time(other, error);
    if (error || fs::file_time_type::clock::now() - told > kGoneAfter) continue;
    if (const auto box = read_box(other)) boxes.push_back(*box);
  }
  return boxes;
}

}  // namespace homeward::scenario
