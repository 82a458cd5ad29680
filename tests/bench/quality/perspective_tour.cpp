// SPDX-License-Identifier: Apache-2.0
#include "perspective_tour.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <numeric>
#include <string>
#include <variant>

#include "files/csv.hpp"
#include "files/read_file.hpp"
#include "files/tour_folder.hpp"
#include "imageio/decode.hpp"

namespace homeward::bench {
namespace {

Image grey_of(const Image& rgb) {
  Image grey(rgb.width_px, rgb.height_px, 1);
  for (std::size_t i = 0; i < grey.data.size(); ++i) {
    const std::uint8_t* at = rgb.data.data() + 3 * i;
    grey.data[i] = static_cast<std::uint8_t>(std::lround(0.299 * at[0] + 0.587 * at[1] + 0.114 * at[2]));
  }
  return grey;
}

}  // namespace

PerspectiveTour read_perspective_tour(const std::filesystem::path& folder, int width_px) {
  PerspectiveTour tour;
  tour.camera = files::read_camera(folder / "camera.json").value();
  const double shrunk = static_cast<double>(width_px) / tour.camera.width_px;
  auto& lens = std::get<camera::Pinhole>(tour.camera.model).intrinsics;
  lens = {lens.fx_px * shrunk, lens.fy_px * shrunk, (lens.cx_px + 0.5) * shrunk - 0.5,
          (lens.cy_px + 0.5) * shrunk - 0.5};
  const auto poses = files::read_csv(folder / "poses.csv").value();
  for (const auto& row : poses.rows) {
    tour.poses.push_back({std::stod(row[1]), std::stod(row[2]), std::stod(row[3])});
    const Image picture = files::read_picture(folder / row[0]).value();
    tour.grey.push_back(grey_of(imageio::shrink_to_fit(picture, width_px, picture.height_px)));
  }
  if (!tour.grey.empty()) {
    tour.camera.width_px = tour.grey.front().width_px;
    tour.camera.height_px = tour.grey.front().height_px;
  }
  return tour;
}

double cpu_ms() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

double at_share(std::vector<double> values, double share) {
  if (values.empty()) return std::nan("");
  const auto k = static_cast<std::size_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(k), values.end());
  return values[k];
}

void print_tenths(const char* name, const std::vector<double>& ms) {
  constexpr std::size_t kParts = 10;
  std::printf("%s: ms of each tenth", name);
  for (std::size_t part = 0; part < kParts; ++part) {
    const auto begin = static_cast<std::ptrdiff_t>(part * ms.size() / kParts);
    const auto end = static_cast<std::ptrdiff_t>((part + 1) * ms.size() / kParts);
    std::printf(" %.1f", at_share({ms.begin() + begin, ms.begin() + end}, 0.5));
  }
  std::printf("; %.0f pictures/s\n", 1e3 * static_cast<double>(ms.size()) / std::accumulate(ms.begin(), ms.end(), 0.0));
}

}  // namespace homeward::bench
