// SPDX-License-Identifier: Apache-2.0
// homeward_bench_beside TOUR WORLD SEED OUT: renders a second drive of a tour (a folder with camera.json and poses.csv
// that `homeward simulate tour` made of WORLD), up to 0.3 m beside the first one as far as the floor is free there,
// with headings a degree off, its pictures between those of the first drive.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "camera/camera.hpp"
#include "core/angles.hpp"
#include "files/csv.hpp"
#include "files/read_file.hpp"
#include "files/tour_folder.hpp"
#include "imageio/decode.hpp"
#include "scenario/simulated_robot.hpp"
#include "scenario/world_folder.hpp"
#include "sim/floor.hpp"
#include "sim/renderer.hpp"

namespace homeward::bench {
namespace {

namespace fs = std::filesystem;

constexpr double kMostAside_m = 0.3;
constexpr double kHeadingNoise_deg = 1.0;
constexpr double kRadius_m = 0.25;
constexpr int kQuality = 92;

std::vector<Pose2> read_poses(const fs::path& file) {
  std::vector<Pose2> poses;
  const auto table = files::read_csv(file).value();
  for (const auto& row : table.rows) {
    poses.push_back({std::stod(row[1]), std::stod(row[2]), std::stod(row[3])});
  }
  return poses;
}

/// The drive beside: a slow wave to both sides, less where the floor is not free.
std::vector<Pose2> drive_beside(const std::vector<Pose2>& taught, const sim::FloorGrid& drivable, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> phase(0.0, 2.0 * kPi);
  std::normal_distribution<double> noise(0.0, radians(kHeadingNoise_deg));
  const double slow = phase(random);
  const double quick = phase(random);
  std::vector<Pose2> driven;
  double way_m = 0.0;
  double aside_m = 0.0;
  for (std::size_t i = 0; i + 1 < taught.size(); ++i) {
    const Pose2& a = taught[i];
    const Pose2& b = taught[i + 1];
    const double step_m = std::hypot(b.x_m - a.x_m, b.y_m - a.y_m);
    way_m += step_m;
    Pose2 pose{0.5 * (a.x_m + b.x_m), 0.5 * (a.y_m + b.y_m),
               wrap_angle(a.theta_rad + 0.5 * wrap_angle(b.theta_rad - a.theta_rad))};
    double wanted_m = kMostAside_m * (0.7 * std::sin(2.0 * kPi * way_m / 7.0 + slow) +
                                      0.3 * std::sin(2.0 * kPi * way_m / 3.1 + quick));
    const auto at_side = [&](double side_m) {
      return Eigen::Vector2d(pose.x_m - side_m * std::sin(pose.theta_rad),
                             pose.y_m + side_m * std::cos(pose.theta_rad));
    };
    while (std::abs(wanted_m) > 0.02 && !sim::is_set(drivable, at_side(wanted_m))) wanted_m *= 0.8;
    const double most_change_m = 0.35 * step_m + 0.004;
    const double before_m = aside_m;
    aside_m += std::clamp(wanted_m - aside_m, -most_change_m, most_change_m);
    const Eigen::Vector2d point = at_side(aside_m);
    const double drift = step_m > 0.01 ? std::atan2(aside_m - before_m, step_m) : 0.0;
    driven.push_back({point.x(), point.y(), wrap_angle(pose.theta_rad + drift + noise(random))});
  }
  return driven;
}

int run(const fs::path& tour, const std::string& name, std::uint64_t seed, const fs::path& out) {
  const auto config = files::read_camera(tour / "camera.json").value();
  const auto light = scenario::light_named("day").value();
  sim::LitWorld world(scenario::load_world(name).value());
  scenario::prepare_light(world, light);
  const sim::Renderer renderer(world, light, camera::Camera::create(config).value());
  const auto taught = read_poses(tour / "poses.csv");
  const auto drivable = sim::drivable_cells(world.world().occupied, kRadius_m, taught.front());
  const auto driven = drive_beside(taught, drivable, seed);
  fs::create_directories(out);
  fs::copy_file(tour / "camera.json", out / "camera.json", fs::copy_options::overwrite_existing);
  std::ofstream poses(out / "poses.csv");
  poses << "filename,x_m,y_m,theta_rad\n";
  for (std::size_t i = 0; i < driven.size(); ++i) {
    std::array<char, 32> file{};
    std::snprintf(file.data(), file.size(), "%05zu.jpg", i);
    const auto jpeg = imageio::encode_jpeg(renderer.render(driven[i], {}, seed * 1'000'003 + i), kQuality);
    std::ofstream(out / file.data(), std::ios::binary)
        .write(reinterpret_cast<const char*>(jpeg.data()), static_cast<std::streamsize>(jpeg.size()));
    poses << file.data() << ',' << driven[i].x_m << ',' << driven[i].y_m << ',' << driven[i].theta_rad << '\n';
  }
  std::printf("%zu pictures: %s\n", driven.size(), out.c_str());
  return 0;
}

}  // namespace
}  // namespace homeward::bench

int main(int argc, char** argv) try {
  if (argc != 5) {
    std::fprintf(stderr, "usage: homeward_bench_beside TOUR WORLD SEED OUT\n");
    return 2;
  }
  return homeward::bench::run(argv[1], argv[2], std::stoull(argv[3]), argv[4]);
} catch (const tl::bad_expected_access<homeward::Error>& stopped) {
  std::fprintf(stderr, "%s\n", stopped.error().message.c_str());
  return 1;
} catch (const std::exception& stopped) {
  std::fprintf(stderr, "%s\n", stopped.what());
  return 1;
}
