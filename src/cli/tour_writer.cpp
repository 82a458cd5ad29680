// SPDX-License-Identifier: Apache-2.0
#include "cli/simulate.hpp"
#include "cli/tour_files.hpp"
#include "core/angles.hpp"
#include "files/read_file.hpp"
#include "imageio/decode.hpp"
#include "scenario/simulated_robot.hpp"
#include "scenario/usual_cameras.hpp"
#include "scenario/world_folder.hpp"
#include "sim/laser.hpp"
#include "sim/tour_people.hpp"

namespace homeward::cli {

namespace {

constexpr int kQuality = 92;

}  // namespace

struct TourWriter::Parts {
  TourFiles files;
  sim::LitWorld world;
  std::unique_ptr<sim::Renderer> renderer;
  std::uint64_t seed = 1;
  int count = 0;
  TimeUs t_us = kTourBegins_us;
  Pose2 last{};
};

TourWriter::TourWriter(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
TourWriter::TourWriter(TourWriter&&) noexcept = default;
TourWriter& TourWriter::operator=(TourWriter&&) noexcept = default;
TourWriter::~TourWriter() = default;

Result<TourWriter> TourWriter::open(const StageOptions& options) {
  const auto config = camera_named(options.camera);
  if (!config) return pass_on(config);
  auto camera = camera::Camera::create(*config);
  if (!camera) return pass_on(camera);
  const auto light = scenario::light_named(options.light);
  if (!light) return pass_on(light);
  auto world = scenario::load_world(options.world);
  if (!world) return pass_on(world);
  auto files = TourFiles::open(options.out, *config);
  if (!files) return pass_on(files);
  auto parts =
      std::make_unique<Parts>(Parts{std::move(*files), sim::LitWorld(std::move(*world)), nullptr, options.seed});
  scenario::prepare_light(parts->world, *light);
  parts->renderer = std::make_unique<sim::Renderer>(parts->world, *light, std::move(*camera));
  return TourWriter(std::move(parts));
}

const sim::World& TourWriter::world() const { return parts_->world.world(); }
const std::string& TourWriter::last_name() const { return parts_->files.last_name(); }

Status TourWriter::add(const Pose2& pose, const std::string& room, const Pose2* odometry,
                       const sim::TourMoment* moment) {
  Parts& p = *parts_;
  if (p.count > 0) {
    const double seconds = moment != nullptr ? moment->seconds : sim::tour_seconds(p.last, pose);
    p.t_us += static_cast<std::int64_t>(1e6 * seconds);
  }
  const std::vector<sim::Person> people = moment != nullptr ? moment->people : std::vector<sim::Person>{};
  const std::uint64_t noise_seed = p.seed * 1'000'003 + static_cast<std::uint64_t>(p.count);
  SimulatedPicture picture;
  picture.jpeg = imageio::encode_jpeg(p.renderer->render(pose, people, noise_seed), kQuality);
  picture.truth = pose;
  picture.room = room;
  if (odometry != nullptr) picture.odometry = *odometry;
  picture.t_us = p.t_us;
  // What the simulated chair drives by: a tour that sees less would call free what is under a table.
  const sim::LaserConfig laser = scenario::safety_scanner();
  picture.sweep.angle_step_rad = 2.0 * kPi / laser.rays;
  picture.sweep.range_max_m = laser.range_max_m;
  picture.sweep.ranges_m = sim::scan(p.world.rays(), pose, people, laser, noise_seed);
  if (Status added = p.files.add(picture); !added) return added;
  p.last = pose;
  ++p.count;
  return {};
}

Status TourWriter::finish(const std::vector<std::pair<std::string, std::string>>& marks) {
  return parts_->files.finish(marks);
}

Result<camera::CameraConfig> camera_named(const std::string& name_or_file) {
  if (const auto usual = scenario::usual_camera(name_or_file)) return *usual;
  return files::read_camera(name_or_file);
}

}  // namespace homeward::cli
