// SPDX-License-Identifier: Apache-2.0
#include "scenario/taught_world.hpp"

#include <filesystem>

#include "files/read_file.hpp"
#include "imageio/decode.hpp"
#include "mapping/shortcut_edges.hpp"
#include "pipeline/build_map.hpp"
#include "scenario/simulated_robot.hpp"
#include "scenario/usual_cameras.hpp"
#include "scenario/world_folder.hpp"
#include "sim/laser.hpp"
#include "sim/motion.hpp"
#include "sim/tour_path.hpp"

namespace homeward::scenario {
namespace {

/// A tour kept in memory as JPEGs, as a camera would have delivered it.
class RenderedTour final : public TourSource {
 public:
  void add(std::vector<std::uint8_t> jpeg, const Pose2& odometry, RangeSweep sweep) {
    const std::string name = std::to_string(100000 + jpegs_.size()).substr(1) + ".jpg";
    images_.push_back({ImageId("tour/" + name), std::nullopt, odometry, std::move(sweep)});
    jpegs_.push_back(std::move(jpeg));
  }
  [[nodiscard]] const ImageId& last() const { return images_.back().id; }
  void mark_last(const std::string& label) { marks_.push_back({images_.back().id.str().substr(5), label}); }
  [[nodiscard]] const std::vector<TourImage>& images() const override { return images_; }
  [[nodiscard]] const std::vector<TourMark>& marks() const override { return marks_; }
  [[nodiscard]] Result<Image> read(std::size_t index) const override {
    return imageio::decode(jpegs_[index], images_[index].id.str());
  }

 private:
  std::vector<std::vector<std::uint8_t>> jpegs_;
  std::vector<TourImage> images_;
  std::vector<TourMark> marks_;
};

/// What the range sensor of the simulated chair sees at a pose.
RangeSweep sweep_at(sim::LitWorld& world, const Pose2& pose, std::uint64_t seed) {
  static const sim::LaserConfig kLaser = safety_scanner();
  RangeSweep sweep;
  sweep.ranges_m = sim::scan(world.rays(), pose, {}, kLaser, seed);
  sweep.angle_step_rad = 2.0 * kPi / kLaser.rays;
  sweep.range_max_m = kLaser.range_max_m;
  return sweep;
}

}  // namespace

Result<sim::World> world_of(const wire::ScenarioFile& scenario, const std::string& folder) {
  // Generated worlds have a name with a colon; files lie beside the scenario.
  const bool generated = scenario.world.find(':') != std::string::npos;
  return load_world(generated ? scenario.world : (std::filesystem::path(folder) / scenario.world).string());
}

Result<TaughtWorld> teach(const wire::ScenarioFile& scenario, const std::string& folder, sim::World world) {
  TaughtWorld taught;
  taught.camera = usual_camera(scenario.camera_model).value_or(camera::CameraConfig{});
  if (scenario.camera) taught.camera = *scenario.camera;
  if (!scenario.camera_file.empty()) {
    const auto read = files::read_camera(std::filesystem::path(folder) / scenario.camera_file);
    if (!read) return pass_on(read);
    taught.camera = *read;
  }
  auto camera = camera::Camera::create(taught.camera);
  if (!camera) return pass_on(camera);
  taught.world = std::make_unique<sim::LitWorld>(std::move(world));
  const auto light = light_named(scenario.tour_light);
  if (!light) return pass_on(light);
  const auto stops = sim::plan_tour(taught.world->world(), scenario.tour_rooms, scenario.tour_step_m);
  if (!stops) return pass_on(stops);
  prepare_light(*taught.world, *light);
  const sim::Renderer renderer(*taught.world, *light, *camera);
  constexpr int kQuality = 92;
  const auto seed = static_cast<std::uint64_t>(scenario.seed);
  sim::WheelOdometry wheels(seed);
  RenderedTour tour;
  for (std::size_t i = 0; i < stops->size(); ++i) {
    const sim::TourStop& stop = (*stops)[i];
    if (i > 0) wheels.follow((*stops)[i - 1].pose, stop.pose);
    const std::uint64_t noise_seed = seed * 1'000'003 + i;
    tour.add(imageio::encode_jpeg(renderer.render(stop.pose, {}, noise_seed), kQuality), wheels.reading(),
             sweep_at(*taught.world, stop.pose, noise_seed));
    taught.picture_poses.emplace(tour.last(), stop.pose);
    if (!stop.arrived) continue;
    tour.mark_last(*stop.arrived);
    taught.destination_poses.emplace(*stop.arrived, stop.pose);
  }
  pipeline::BuildOptions options;
  options.name = scenario.world;
  options.seed = seed;
  auto map = pipeline::build_map({&tour}, taught.camera, options);
  if (!map) return pass_on(map);
  if (scenario.tour_shortcuts) {
    for (map::Shortcut& shortcut : map->shortcuts) {
      shortcut.state = map::ShortcutState::kAccepted;
      shortcut.by = "scenario";
    }
    mapping::settle_shortcuts(*map);
  }
  taught.map = std::make_shared<const map::TopologicalMap>(std::move(*map));
  taught.layout = map::metric_layout(*taught.map);
  return taught;
}

}  // namespace homeward::scenario
