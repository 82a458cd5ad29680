// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <nlohmann/json.hpp>

#include "cli/simulate.hpp"
#include "files/read_file.hpp"
#include "files/write_file.hpp"
#include "imageio/decode.hpp"
#include "scenario/simulated_robot.hpp"
#include "scenario/usual_cameras.hpp"
#include "scenario/world_folder.hpp"
#include "sim/laser.hpp"
#include "wire/camera_json.hpp"
#include "wire/scans_json.hpp"

namespace homeward::cli {

namespace fs = std::filesystem;

namespace {

constexpr int kQuality = 92;
constexpr std::int64_t kFirst_us = 1'700'000'000'000'000;  // tours begin at a fixed time: same seed, same files
constexpr double kSpeed_mps = 0.5;                         // of whoever leads the tour

std::string formatted(const char* format, double a, double b, double c) {
  char text[120];
  std::snprintf(text, sizeof text, format, a, b, c);
  return text;
}

}  // namespace

struct TourWriter::Parts {
  fs::path folder;
  camera::CameraConfig camera;
  sim::LitWorld world;
  std::unique_ptr<sim::Renderer> renderer;
  std::uint64_t seed = 1;
  int count = 0;
  std::int64_t t_us = kFirst_us;
  Pose2 last{};
  std::string last_name{};
  std::string poses = "filename,x_m,y_m,theta_rad,room\n";
  std::string odometry = "t_us,x_m,y_m,theta_rad\n";
  std::string times = "filename,t_us\n";
  std::string scans{};
  RangeSweep scanner{};  // how its sweeps are to be read
};

TourWriter::TourWriter(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
TourWriter::TourWriter(TourWriter&&) noexcept = default;
TourWriter& TourWriter::operator=(TourWriter&&) noexcept = default;
TourWriter::~TourWriter() = default;

Result<TourWriter> TourWriter::open(const StageOptions& options) {
  const fs::path folder(options.out);
  std::error_code error;
  if (fs::exists(folder, error) && !fs::is_empty(folder, error)) {
    return fail(ErrorCode::kConflict, "The folder holds something already; name a new or empty one.", options.out);
  }
  const auto config = camera_named(options.camera);
  if (!config) return pass_on(config);
  auto camera = camera::Camera::create(*config);
  if (!camera) return pass_on(camera);
  const auto light = scenario::light_named(options.light);
  if (!light) return pass_on(light);
  auto world = scenario::load_world(options.world);
  if (!world) return pass_on(world);
  if (const Status made = files::make_folder(folder); !made) return pass_on(made);
  auto parts = std::make_unique<Parts>(Parts{folder, *config, sim::LitWorld(std::move(*world)), nullptr, options.seed});
  scenario::prepare_light(parts->world, *light);
  parts->renderer = std::make_unique<sim::Renderer>(parts->world, *light, std::move(*camera));
  return TourWriter(std::move(parts));
}

const sim::World& TourWriter::world() const { return parts_->world.world(); }
const std::string& TourWriter::last_name() const { return parts_->last_name; }

Status TourWriter::add(const Pose2& pose, const std::string& room, const Pose2* odometry) {
  Parts& p = *parts_;
  char name[32];
  std::snprintf(name, sizeof name, "%05d.jpg", p.count);
  p.last_name = name;
  if (p.count > 0) {
    constexpr double kTurn_radps = 0.8;
    const double seconds = std::max(std::hypot(pose.x_m - p.last.x_m, pose.y_m - p.last.y_m) / kSpeed_mps,
                                    std::abs(wrap_angle(pose.theta_rad - p.last.theta_rad)) / kTurn_radps);
    p.t_us += static_cast<std::int64_t>(1e6 * std::max(0.1, seconds));
  }
  const std::uint64_t noise_seed = p.seed * 1'000'003 + static_cast<std::uint64_t>(p.count);
  const Image picture = p.renderer->render(pose, {}, noise_seed);
  const std::vector<std::uint8_t> jpeg = imageio::encode_jpeg(picture, kQuality);
  if (const Status written =
          files::write_file(p.folder / name, {reinterpret_cast<const char*>(jpeg.data()), jpeg.size()});
      !written) {
    return written;
  }
  p.poses += p.last_name + formatted(",%.4f,%.4f,%.5f,", pose.x_m, pose.y_m, pose.theta_rad) + room + "\n";
  p.times += p.last_name + "," + std::to_string(p.t_us) + "\n";
  if (odometry != nullptr) {
    p.odometry +=
        std::to_string(p.t_us) + formatted(",%.4f,%.4f,%.5f\n", odometry->x_m, odometry->y_m, odometry->theta_rad);
  }
  // What the simulated chair drives by: a tour that sees less would call free what is under a table.
  const sim::LaserConfig laser = scenario::safety_scanner();
  p.scanner.angle_step_rad = 2.0 * kPi / laser.rays;
  p.scanner.range_max_m = laser.range_max_m;
  const std::vector<float> ranges = sim::scan(p.world.rays(), pose, {}, laser, noise_seed);
  if (p.scans.empty()) {
    p.scans = "filename";
    for (std::size_t i = 0; i < ranges.size(); ++i) p.scans += ",r" + std::to_string(i);
    p.scans += "\n";
  }
  p.scans += p.last_name;
  for (const float range_m : ranges) {
    char text[24];
    std::snprintf(text, sizeof text, ",%.3f", std::min(static_cast<double>(range_m), laser.range_max_m));
    p.scans += text;
  }
  p.scans += "\n";
  p.last = pose;
  ++p.count;
  return {};
}

Status TourWriter::finish(const std::vector<std::pair<std::string, std::string>>& marks) {
  const Parts& p = *parts_;
  std::vector<std::pair<std::string, std::string>> files = {
      {"poses.csv", p.poses},
      {"times.csv", p.times},
      {"scans.csv", p.scans},
      {"scans.json", wire::scans_to_json(p.scanner).dump(2) + "\n"},
      {"camera.json", wire::camera_to_json(p.camera).dump(2) + "\n"}};
  if (p.odometry.find('\n') + 1 < p.odometry.size()) files.emplace_back("odometry.csv", p.odometry);
  if (!marks.empty()) {
    nlohmann::json tour = {{"format", "homeward-tour"}, {"version", 1}, {"marks", nlohmann::json::array()}};
    for (const auto& [image, label] : marks) tour["marks"].push_back({{"image", image}, {"label", label}});
    files.emplace_back("tour.json", tour.dump(2) + "\n");
  }
  for (const auto& [name, text] : files) {
    if (const Status written = files::write_file(p.folder / name, text); !written) return written;
  }
  return {};
}

Result<camera::CameraConfig> camera_named(const std::string& name_or_file) {
  if (const auto usual = scenario::usual_camera(name_or_file)) return *usual;
  return files::read_camera(name_or_file);
}

}  // namespace homeward::cli
